# SPDX-License-Identifier: BSD-3-Clause
"""A sweep of poses along a quay: mean level against place, as numbers and, where matplotlib is there, as a chart.

    PYTHONPATH=build/release/python python3 apps/06_sweep.py sweep.png
"""
from __future__ import annotations

import sys
from importlib import import_module

import insonify as iy
import numpy as np


def mean_level_db(ping: iy.Ping) -> float:
    """Of the mean intensity of a ping [dB re 1 uPa rms]."""
    return float(10 * np.log10(np.mean(np.abs(ping.pressure) ** 2) / 2) + 120)


def main(picture: str | None) -> None:
    scene = iy.make_scene("harbour", points=50000)
    head = iy.sonar("p900-45", beams=64, min_range=1, max_range=15)
    simulator = iy.PingSimulator(head, iy.Environment(temperature_c=8), accuracy_db=0.5)

    # Places along the quay, 3 m deep, looking 15 degrees down.
    x = np.linspace(0, 20, 24)
    poses = np.zeros((len(x), 6))
    poses[:, 0], poses[:, 2], poses[:, 4] = x, -3, 15
    mean_db = np.array([mean_level_db(ping) for ping in simulator.pings(scene, poses)])
    for place, level in zip(x[::6], mean_db[::6]):
        print(f"x = {place:4.1f} m: {level:.1f} dB re 1 uPa")

    if picture is None:
        return
    try:
        pyplot = import_module("matplotlib.pyplot")
    except ImportError:
        print("no chart: there is no matplotlib (apt install python3-matplotlib)")
        return
    figure, axes = pyplot.subplots(figsize=(7, 4))
    axes.plot(x, mean_db)
    axes.set(xlabel="x [m]", ylabel="mean level [dB re 1 µPa]", title=f"{head.name} along the quay")
    axes.grid(alpha=0.3)
    figure.savefig(picture, dpi=100)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else None)
