# SPDX-License-Identifier: BSD-3-Clause
"""Labelled pings to learn from, as a data set in the manner of PyTorch: len(), [index], and batches without end.

    PYTHONPATH=build/release/python python3 apps/05_dataset.py
"""
from __future__ import annotations

from collections.abc import Iterator

import insonify as iy
import numpy as np
from numpy.typing import NDArray

Sample = tuple[NDArray[np.float32], NDArray[np.uint16]]


class SonarPings:
    """Level [0, 1] and material of every pixel, (beams, bins) each, from random places over a scene."""

    def __init__(self, scene: iy.Scene, length: int, seed: int = 1) -> None:
        head = iy.sonar("p900-45", beams=64, min_range=1, max_range=10)
        self.scene = scene
        self.simulator = iy.PingSimulator(head, iy.Environment(temperature_c=8), accuracy_db=0.5, noise=True,
                                          keep="labels")
        draw = np.random.default_rng(seed)
        low, high = (4, -2, -3, -180, 5, -3), (8, 2, -1.5, 180, 30, 3)  # x, y, z [m], yaw, pitch, roll [deg]
        self.poses = draw.uniform(low, high, size=(length, 6))

    def __len__(self) -> int:
        return len(self.poses)

    def __getitem__(self, index: int) -> Sample:
        x, y, z, yaw, pitch, roll = self.poses[index]
        ping = self.simulator.ping(self.scene, (x, y, z), yaw, pitch, roll, ping=index)
        return self.sample_of(ping)

    def __iter__(self) -> Iterator[Sample]:
        """All samples, one ping on each core at a time: faster than one index after the other."""
        return map(self.sample_of, self.simulator.pings(self.scene, self.poses))

    @staticmethod
    def sample_of(ping: iy.Ping) -> Sample:
        level = ping.level_db(floor_db=60)
        return np.clip((level - 60) / 80, 0, 1).astype(np.float32), ping.material_image


def main() -> None:
    scene = iy.make_scene("reef", points=20000)
    pings = SonarPings(scene, length=6)
    names = dict(enumerate(scene.material_names))
    for index, (level, material) in enumerate(pings):
        beams, bins = level.shape
        found = [names[number] for number in np.unique(material) if number in names]
        print(f"{index}: {beams} beams x {bins} bins, mean level {level.mean():.2f}, {', '.join(found)}")
    again, _ = pings[3]
    print("the same alone and in a batch:", np.array_equal(again, list(pings)[3][0]))


if __name__ == "__main__":
    main()
