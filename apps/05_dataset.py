# SPDX-License-Identifier: BSD-3-Clause
"""Labelled images to learn from, as a data set in the manner of PyTorch: len(), [index], and all in turn.

    PYTHONPATH=build/release/python python3 apps/05_dataset.py [SHEET.png]
"""
from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import insonify as iy
import numpy as np
from grey_png import save_grey
from numpy.typing import NDArray

Sample = tuple[NDArray[np.float32], dict[str, Any]]


class SonarImages:
    """Images [0, 1] of (height, width) with their targets, from random places over a scene.

    A target has masks (class of each pixel), boxes (left, top, right, bottom [pixels]) and labels (class of each box).
    """

    def __init__(self, scene: iy.Scene, length: int, seed: int = 1) -> None:
        head = iy.sonar("p900-45", beams=128, min_range=1, max_range=8)
        self.scene = scene
        self.simulator = iy.PingSimulator(head, iy.Environment(temperature_c=8), accuracy_db=0.5, noise=True)
        draw = np.random.default_rng(seed)
        low, high = (0.5, -2, -2.4, -30, 15, -3), (3, 2, -1.8, 30, 30, 3)  # x, y, z [m], yaw, pitch, roll [deg]
        self.poses = draw.uniform(low, high, size=(length, 6))
        # Black and white [dB re 1 uPa at 1 m] of all images, so that each is the same alone and in a batch.
        self.window = (130.0, 190.0)

    def __len__(self) -> int:
        return len(self.poses)

    def __getitem__(self, index: int) -> Sample:
        """One image. Its speckle and noise are those of its own seed, so that no two images share them."""
        place = range(len(self))[index]
        (view,) = self.simulator.views(self.scene, self.poses[place:place + 1], width=320, height=320, threads=1,
                                       window=self.window, stuff=["coral_sand", "reef_rock"], seed=place + 1)
        return self.sample_of(view)

    def __iter__(self) -> Iterator[Sample]:
        """All images. Pings release Python's lock, so that each core makes one at a time."""
        with ThreadPoolExecutor(os.cpu_count()) as workers:
            yield from workers.map(self.__getitem__, range(len(self)))

    @staticmethod
    def sample_of(view: iy.View) -> Sample:
        boxed = [seen for seen in view.objects if seen["boxed"]]
        corners = view.boxes.copy()
        corners[:, 2:] += corners[:, :2]
        labels = np.array([view.class_names.index(seen["class"]) for seen in boxed], np.int64)
        return view.image.astype(np.float32) / np.float32(255), {"masks": view.mask, "boxes": corners, "labels": labels}


def main(sheet: str | None) -> None:
    images = SonarImages(iy.make_scene("reef", points=40000), length=6)
    samples = list(images)
    for index, (image, target) in enumerate(samples):
        print(f"{index}: mean {image.mean():.2f}, {len(target['boxes'])} boxes, classes "
              f"{np.unique(target['masks']).tolist()}")
    again, _ = images[3]
    print("the same alone and in a batch:", np.array_equal(again, samples[3][0]))
    if sheet:
        for image, target in samples:
            for left, top, right, bottom in target["boxes"]:
                image[[top, bottom - 1], left:right] = image[top:bottom, [left, right - 1]] = 1
        rows = [np.concatenate([image for image, _ in samples[k:k + 3]], axis=1) for k in (0, 3)]
        save_grey(sheet, 255 * np.concatenate(rows))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else None)
