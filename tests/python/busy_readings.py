# SPDX-License-Identifier: BSD-3-Clause
"""Reads scene files of every format while eight other threads are busy; each must give what it gave before there were threads.

    busy_readings.py SEEDS READS     folders of tests/fuzz/make_seeds.sh; READS of each format
"""
from __future__ import annotations

import sys
import threading
from pathlib import Path

import insonify as iy
import numpy as np

FORMATS = ["pcd", "ply", "obj", "stl", "vtk", "vtp", "gltf", "glb", "xyz", "pts", "ptx", "dae", "fbx", "off", "x3d", "csv",
           "asc", "las", "tiff", "tiles"]


def facts(path: Path) -> tuple:
    scene = iy.load_scene(path)
    return len(scene), scene.origin.tobytes(), scene.material_names, scene.notes


def files_of(folder: Path) -> dict[Path, tuple]:
    """Those that are scenes by themselves."""
    files = {}
    for path in sorted(folder.iterdir()):
        try:
            files[path] = facts(path)
        except iy.Error:
            pass
    assert files, folder
    return files


def main(seeds: Path, reads: int) -> int:
    files = {name: files_of(seeds / name) for name in FORMATS}
    done = threading.Event()
    wrong: list[Path] = []

    def work(number: int) -> None:
        numbers = np.random.default_rng(number).normal(size=(60, 60))
        while not done.is_set():
            np.linalg.svd(numbers)

    def read(name: str) -> None:
        paths = list(files[name])
        for i in range(reads):
            path = paths[i % len(paths)]
            if facts(path) != files[name][path]:
                wrong.append(path)

    busy = [threading.Thread(target=work, args=(number,)) for number in range(8)]
    readers = [threading.Thread(target=read, args=(name,)) for name in FORMATS]
    for thread in busy + readers:
        thread.start()
    for thread in readers:
        thread.join()
    done.set()
    print(f"{reads * len(FORMATS)} files read, {len(wrong)} wrong")
    return 0 if not wrong else 1


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), int(sys.argv[2])))
