# SPDX-License-Identifier: BSD-3-Clause
"""Calls of all kinds from several threads at once, each compared with what one thread gets.

    mixed_calls.py FOLDER CALLS [THREADS]     CALLS of each thread; ends with code 0 and prints how many were made
"""
from __future__ import annotations

import hashlib
import shutil
import sys
import threading
from pathlib import Path

import insonify as iy
import numpy as np


def digest(*parts: bytes) -> str:
    return hashlib.sha256(b"".join(parts)).hexdigest()


class Calls:
    """Each call takes a folder of its own and a number, and returns a digest that depends on the number alone."""

    def __init__(self, folder: Path):
        self.head = iy.sonar("p900-45", beams=8, min_range=1, max_range=9)
        self.simulator = iy.PingSimulator(self.head)
        self.made = iy.make_scene("poles", points=2000)
        self.file = folder / "poles.ply"
        self.tiles = folder / "poles.tiles"

    def ping_of(self, number: int, **keys) -> iy.Ping:
        return self.simulator.ping(self.made, (0.1 * number, 0, 0), ping=number, **keys)

    def batch(self, _: Path, number: int) -> str:
        poses = np.zeros((3, 6))
        poses[:, 0] = 0.1 * number
        return digest(*(ping.level_db().tobytes() for ping in self.simulator.pings(self.made, poses, threads=2)))

    def contributors(self, _: Path, number: int) -> str:
        ping = self.ping_of(number, keep="contributors")
        return digest(ping.material_image.tobytes(), ping.instance_image.tobytes())

    def picture(self, folder: Path, number: int) -> str:
        iy.draw_fan(self.ping_of(number), folder / "fan.png", width=400, height=300)
        return digest((folder / "fan.png").read_bytes())

    def save(self, folder: Path, number: int) -> str:
        self.ping_of(number, keep=["contributors", "paths"]).save(folder / "run", force=True, picture=number == 0)
        files = sorted(path for path in (folder / "run").iterdir() if path.name not in ("manifest.json", "run.toml"))
        return digest(*(path.read_bytes() for path in files))

    def load(self, _: Path, number: int) -> str:
        scene = iy.load_scene(self.tiles if number % 2 else self.file)
        return digest(self.simulator.ping(scene, (0, 0, 0)).pressure.tobytes())

    def new_head(self, _: Path, number: int) -> str:
        head = iy.sonar("p900-45", beams=4 + number, min_range=1, max_range=9)
        return digest(iy.PingSimulator(head).ping(self.made, (0, 0, 0)).pressure.tobytes())

    def all(self):
        return (self.batch, self.contributors, self.picture, self.save, self.load, self.new_head)


def main(folder: Path, count: int, threads: int) -> int:
    calls, numbers = Calls(folder).all(), 4
    alone = folder / "alone"
    alone.mkdir()
    expected = {(c, n): call(alone, n) for c, call in enumerate(calls) for n in range(numbers)}
    wrong: list[str] = []

    def work(thread: int):
        own = folder / f"thread-{thread}"
        own.mkdir()
        for i in range(count):
            which, number = (i + thread) % len(calls), (i // len(calls) + thread) % numbers
            try:
                if calls[which](own, number) != expected[which, number]:
                    wrong.append(f"{calls[which].__name__}({number}) differs")
            except Exception as error:  # every failure of any thread is shown
                wrong.append(f"{calls[which].__name__}({number}): {error}")
        shutil.rmtree(own)

    workers = [threading.Thread(target=work, args=(thread,)) for thread in range(threads)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    print(f"{threads * count} calls, {len(wrong)} wrong", *wrong[:10], sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 8))
