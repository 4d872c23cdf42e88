# SPDX-License-Identifier: BSD-3-Clause
"""Many pings: in order, in little memory, from several threads, ended by Ctrl-C."""
from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import insonify as iy
import numpy as np
import pytest


def poses_of(count):
    poses = np.zeros((count, 6))
    poses[:, 0], poses[:, 2], poses[:, 4] = np.linspace(0, 5, count), -3, 10
    return poses


def memory_mib():
    text = Path("/proc/self/status").read_text()
    return int(text.split("VmRSS:")[1].split()[0]) / 1024


def test_a_batch_is_its_pings_in_order(head, scene):
    sim = iy.PingSimulator(head, noise=True)
    poses = poses_of(9)
    for threads in (0, 1, 3):
        batch = sim.pings(scene, poses, threads=threads, seed=3)
        assert len(batch) == 9
        for i, ping in enumerate(batch):
            alone = sim.ping(scene, poses[i, :3], *poses[i, 3:], ping=i, seed=3)
            assert ping.number == i and np.array_equal(ping.pressure, alone.pressure)
        assert list(batch) == []


def test_a_batch_keeps_what_is_asked_for(simulator, scene):
    for ping in simulator.pings(scene, poses_of(3), keep="contributors"):
        assert ping.material_image.shape == ping.pressure.shape
    with pytest.raises(iy.ArgumentError, match="keep"):
        next(simulator.pings(scene, poses_of(1))).material_image


def test_many_display_images_of_a_dense_scene_merge_surfels(tmp_path):
    head = iy.sonar("p900-45", beams=32, beam_width_deg=2, field_of_view_deg=90, min_range=1, max_range=25)
    harbour = iy.make_scene("harbour", points=600000)
    sim = iy.PingSimulator(head, display=50)
    poses = poses_of(20)
    last = list(sim.pings(harbour, poses, threads=2))[-1]
    last.save(tmp_path / "run", picture=False)
    assert 'with = ["detail"]' in (tmp_path / "run" / "run.toml").read_text()
    asked = iy.PingSimulator(head, display=50, with_="detail")
    assert np.array_equal(last.level_db(), asked.ping(harbour, poses[19, :3], *poses[19, 3:], ping=19).level_db())
    # Eight of them, and one alone, are of all surfels.
    alone = sim.ping(harbour, poses[7, :3], *poses[7, 3:], ping=7).level_db()
    assert np.array_equal(list(sim.pings(harbour, poses[:8]))[-1].level_db(), alone)


def test_an_empty_batch_and_one_that_is_left(simulator, scene):
    assert list(simulator.pings(scene, np.zeros((0, 6)))) == []
    batch = simulator.pings(scene, poses_of(500))
    next(batch)
    begin = time.monotonic()
    del batch
    assert time.monotonic() - begin < 1


def test_a_ping_that_fails_ends_the_batch_in_its_turn(head, scene):
    poses = poses_of(6)
    poses[3, 2] = 5  # above the surface
    batch = iy.PingSimulator(head, iy.Environment(surface_height=0)).pings(scene, poses)
    for _ in range(3):
        next(batch)
    with pytest.raises(iy.Error, match="surface"):
        next(batch)
    assert list(batch) == []


def test_memory_is_flat():
    scene, used = iy.make_scene("sphere", points=2000), []
    simulator = iy.PingSimulator(iy.sonar("p900-45", beams=16, min_range=3, max_range=7))
    for ping in simulator.pings(scene, np.zeros((400, 6))):
        ping.pressure, ping.level_db(), ping.soundings
        used.append(memory_mib())
    for _ in range(2000):
        ping.pressure, ping.level_db(), ping.range
    assert max(used[100:]) - used[99] < 30, used[::50]
    assert memory_mib() - used[-1] < 10


def test_four_threads_ping_at_once(simulator, scene):
    expected = [simulator.ping(scene, pose[:3], pitch=10, ping=i).pressure for i, pose in enumerate(poses_of(8))]
    found = {}

    def work(which):
        for i, pose in enumerate(poses_of(8)):
            found[which, i] = simulator.ping(scene, pose[:3], pitch=10, ping=i).pressure

    threads = [threading.Thread(target=work, args=(which,)) for which in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 32 and all(np.array_equal(pressure, expected[i]) for (_, i), pressure in found.items())


def test_python_runs_while_a_ping_is_made(simulator, scene):
    """Without the GIL another thread counts."""
    counted, done = 0, threading.Event()

    def work():
        for ping in simulator.pings(scene, poses_of(20), threads=1):
            pass
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.wait(0.001):
        counted += 1
    thread.join()
    assert counted > 20


endless = """
import sys, time
import insonify as iy, numpy as np
scene = iy.make_scene("harbour", points=1000000)
sim = iy.PingSimulator(iy.sonar("oculus-m750d", min_range=0.5, max_range=40), iy.Environment(surface_height=0), {options})
poses = np.tile((0, 0, -3, 0, 10, 0), (1000, 1))
print("ready", flush=True)
try:
    {what}
except KeyboardInterrupt:
    print("interrupted", flush=True)
    sys.exit(5)
"""


def processor_time(pid):
    """Seconds of all threads of a process and of its ended children, by proc(5)."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")


@pytest.mark.parametrize("what,options,after", [
    ("for ping in sim.pings(scene, poses, keep='contributors'): pass", "", 1.0),
    ("for ping in sim.pings(scene, poses, keep='contributors'): pass", "", 2.3),
    ("sim.ping(scene, (0, 0, -3), pitch=10)", "method='direct'", 1.5)])
def test_ctrl_c_ends_it_within_a_second(what, options, after):
    """Measured in processor time, two seconds of two threads, so that other work on the machine does not count."""
    program = subprocess.Popen([sys.executable, "-c", endless.format(what=what, options=options)],
                               stdout=subprocess.PIPE, text=True)
    assert program.stdout.readline() == "ready\n"
    time.sleep(after)
    begin = processor_time(program.pid)
    program.send_signal(signal.SIGINT)
    pressed = time.monotonic()
    assert program.stdout.readline() == "interrupted\n"
    _, status, usage = os.wait4(program.pid, 0)
    assert os.waitstatus_to_exitcode(status) == 5
    assert usage.ru_utime + usage.ru_stime - begin < 2
    assert time.monotonic() - pressed < 10
