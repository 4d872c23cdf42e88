# SPDX-License-Identifier: BSD-3-Clause
"""Missions over tiles and scenes of parts: the pings of `insonify survey`, with progress."""
from __future__ import annotations

import os
import pickle
import re
import signal
import threading
import time
from pathlib import Path

import h5py
import insonify as iy
import numpy as np
import pytest

text = """schema = 1
[survey]
scene = "SCENE"
seed = 7
[trajectory]
waypoints_m = [[0, 0, -3], [2, 0, -3]]
speed_m_s = 1
[[head]]
name = "fls"
sonar = "p900-45"
range = "1:6"
set = ["sonar.beams=16"]
pitch_deg = 20
rate_hz = 2
[[head]]
name = "side"
sonar = "p900-45"
range = "1:5"
set = ["sonar.beams=8"]
heading_deg = 60
pitch_deg = 20
rate_hz = 1
[randomise]
source_level_db = 0.5
[ping]
noise = true
accuracy_db = 0.2
"""
parts = """schema = 1
[[part]]
file = "mission.ply"
[[part]]
name = "buoy"
file = "ball.ply"
position_m = [3, 0, -4]
velocity_mps = [0.5, 0, 0]
[[scatter]]
files = ["ball.ply"]
names = ["stone"]
count = [1, 3]
area_m = [[2, -2], [5, -2], [5, 2], [2, 2]]
"""


@pytest.fixture(scope="module")
def missions(tmp_path_factory, tool) -> Path:
    """A folder with missions over a cloud, tiles and a scene of parts."""
    path = tmp_path_factory.mktemp("missions")
    tool("make-scene", "harbour", "--points", "20000", "-o", "mission.ply", folder=path)
    tool("prepare", "mission.ply", "-o", "mission.tiles", folder=path)
    tool("make-object", "sphere", "--set", "diameter_m=0.6", "-o", "ball.ply", folder=path)
    (path / "parts.toml").write_text(parts)
    for over, scene in (("ply", "mission.ply"), ("tiles", "mission.tiles"), ("parts", "parts.toml")):
        (path / f"over_{over}.toml").write_text(text.replace("SCENE", scene))
    return path


@pytest.mark.parametrize("over", ["ply", "tiles", "parts"])
def test_pings_are_those_of_survey(missions, tool, over):
    tool("survey", f"over_{over}.toml", "-o", f"run_{over}", folder=missions)
    tool("merge", f"run_{over}", folder=missions)
    mission = iy.load_mission(missions / f"over_{over}.toml")
    assert len(mission) == len(mission.times) == len(mission.poses) == len(mission.heads)
    for threads in (1, 3):
        made = list(mission.pings(threads=threads))
        assert [ping.head for ping in made] == mission.heads and [ping.time for ping in made] == list(mission.times)
        assert np.array_equal([ping.world_from_head for ping in made], mission.poses)
        for head in ("fls", "side"):
            of_head = [ping for ping in made if ping.head == head]
            assert [ping.number for ping in of_head] == list(range(len(of_head)))
            with h5py.File(missions / f"run_{over}" / head / "cube.h5") as cube:
                assert len(cube["pressure"]) == len(of_head) >= 2
                for stored, ping in zip(cube["pressure"], of_head):
                    assert stored.tobytes() == ping.pressure.tobytes() and ping.pressure.any()
    some = list(mission.pings(first=2, count=3))
    assert [ping.pressure.tobytes() for ping in some] == [ping.pressure.tobytes() for ping in made[2:5]]


def test_progress_counts_in_the_thread_that_iterates(missions):
    mission, counted = iy.load_mission(missions / "over_tiles.toml"), []
    pings = mission.pings(progress=lambda done, total: counted.append((done, total, threading.get_ident())))
    assert next(pings).number == 0 and counted == [(1, len(mission), threading.get_ident())]
    assert len(list(pings)) == len(mission) - 1
    assert counted == [(i + 1, len(mission), threading.get_ident()) for i in range(len(mission))]


def threads_of_this_process():
    return len(os.listdir("/proc/self/task"))


def test_an_exception_of_progress_ends_the_work(missions):
    mission = iy.load_mission(missions / "over_tiles.toml")
    list(mission.pings(count=1))  # threads of libraries are there from now on
    before = threads_of_this_process()

    def stop(done, total):
        if done == 2:
            raise RuntimeError("enough")

    pings = mission.pings(threads=3, progress=stop)
    assert threads_of_this_process() > before
    next(pings)
    with pytest.raises(RuntimeError, match="enough") as kept:
        next(pings)
    assert kept.traceback and threads_of_this_process() == before  # though the traceback lives
    assert list(pings) == []
    dropped = mission.pings(threads=3)
    next(dropped)
    del dropped
    assert threads_of_this_process() == before


def test_ctrl_c_ends_the_work(missions):
    mission = iy.load_mission(missions / "over_tiles.toml")
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        for _ in mission.pings(threads=2, progress=lambda done, total: os.kill(os.getpid(), signal.SIGINT)):
            time.sleep(0.01)
    assert time.monotonic() - began < 10


def test_a_ping_of_a_mission_pickles_and_draws(missions, tmp_path):
    ping = next(iy.load_mission(missions / "over_tiles.toml").pings())
    same = pickle.loads(pickle.dumps(ping))
    for name in ("head", "number", "time", "seed", "notes", "sound_speed"):
        assert getattr(same, name) == getattr(ping, name), name
    assert same.seed == 7 and same.head == "fls" and np.array_equal(same.world_from_head, ping.world_from_head)
    assert same.pressure.tobytes() == ping.pressure.tobytes() and np.array_equal(same.azimuth, ping.azimuth)
    for number, one in enumerate((ping, same)):
        iy.draw_fan(one, tmp_path / f"{number}.png")
    assert (tmp_path / "0.png").read_bytes() == (tmp_path / "1.png").read_bytes()
    with pytest.raises(iy.ArgumentError, match="save: .*insonify survey"):
        ping.save(tmp_path / "run")


@pytest.mark.parametrize("keys, said", [({"first": -1}, "first = -1"), ({"first": 99}, "first = 99"), ({"count": 99}, "count = 99"),
                                        ({"threads": -1}, "threads = -1"), ({"progress": 3}, "progress = 3")])
def test_arguments_are_checked(missions, keys, said):
    with pytest.raises(iy.ArgumentError, match=f"pings: {said}"):
        iy.load_mission(missions / "over_ply.toml").pings(**keys)


def test_errors_name_file_and_key(missions):
    (missions / "wrong.toml").write_text(text.replace("SCENE", "mission.ply").replace("rate_hz = 2", "rate_hz = 0"))
    with pytest.raises(iy.Error, match=r"wrong\.toml:\d+: .*rate_hz"):
        iy.load_mission(missions / "wrong.toml")
    (missions / "lost.toml").write_text(text.replace("SCENE", "lost.tiles"))
    with pytest.raises(iy.Error, match=r"lost\.tiles"):
        iy.load_mission(missions / "lost.toml")


def test_the_example_of_the_docs_runs(missions, monkeypatch, capsys):
    page = (Path(__file__).parents[2] / "docs/python.md").read_text().split("## Missions\n")[1]
    (missions / "mission.toml").write_text(text.replace("SCENE", "mission.tiles"))
    monkeypatch.chdir(missions)
    exec(re.search(r"```python\n(.*?)```", page, re.DOTALL)[1], {"iy": iy})
    lines = capsys.readouterr().out.splitlines()
    total = len(lines) // 2
    assert lines[::2] == [f"{i + 1} of {total} pings" for i in range(total)]
    assert lines[1].startswith("fls 0 0.0 [") and lines[-1].startswith("side ")
