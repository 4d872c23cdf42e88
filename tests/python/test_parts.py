# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of parts: each ping finds them at its own time and draw, as the tool does."""
from __future__ import annotations

import hashlib
import json

import h5py
import insonify as iy
import numpy as np
import pytest

text = """schema = 1
[[part]]
file = "harbour.ply"
[[part]]
name = "buoy"
file = "ball.ply"
position_m = [5, -1, -2.5]
velocity_mps = [1, 0.5, 0]
[[scatter]]
files = ["ball.ply"]
names = ["stone"]
count = [1, 3]
area_m = [[4, -4], [10, -4], [10, 4], [4, 4]]
"""


@pytest.fixture(scope="module")
def parts(folder, tool):
    """The file of a scene in which a buoy moves and stones are drawn."""
    tool("make-object", "sphere", "--set", "diameter_m=0.6", "-o", "ball.ply", folder=folder)
    (folder / "parts.toml").write_text(text)
    return folder / "parts.toml"


def test_a_ping_is_that_of_the_tool_at_its_time_and_draw(parts, folder, tool, monkeypatch):
    tool("ping", "parts.toml", "--sonar", "p900-45", "--pose=0,0,-3,0,10,0", "--range", "1:12", "--seed", "7", "--keep",
         "contributors", "--set", "sonar.beams=32", "--time", "2", "--draw", "3", "-o", "parts_tool", folder=folder)
    monkeypatch.chdir(folder)
    sim = iy.PingSimulator(iy.sonar("p900-45", beams=32, min_range=1, max_range=12))
    scene = iy.load_scene("parts.toml", seed=7)
    ping = sim.ping(scene, (0, 0, -3), pitch=10, seed=7, keep="contributors", time=2, draw=3)
    ping.save("parts_python")
    with h5py.File("parts_tool/cube.h5") as cube:
        assert cube["pressure"][0].tobytes() == ping.pressure.tobytes()
    by_tool, by_python = ({p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in (folder / run).iterdir()
                           if p.name != "manifest.json"} for run in ("parts_tool", "parts_python"))
    assert by_tool == by_python
    said = [json.loads((folder / run / "manifest.json").read_text()) for run in ("parts_tool", "parts_python")]
    assert said[0]["scene"] == said[1]["scene"]
    buoy = next(part for part in said[1]["scene"]["parts"] if part["name"] == "buoy")
    assert buoy["position_m"] == [7, 0, -2.5]
    other = sim.ping(scene, (0, 0, -3), pitch=10, seed=8)
    with pytest.raises(iy.ArgumentError, match=r"seed = 8.*load_scene\(path, seed=8\)"):
        other.save("other_seed")


def test_pings_along_a_way_have_the_times_and_draws_of_each(parts, simulator):
    scene = iy.load_scene(parts)
    poses = np.array([(0.2 * i, 0, -3, 0, 10, 0) for i in range(3)])
    time, draw = np.array([0, 1.5, 3]), [0, 0, 4]
    made = list(simulator.pings(scene, poses, time=time, draw=draw))
    assert [ping.time for ping in made] == list(time)
    for i, ping in enumerate(made):
        single = simulator.ping(scene, poses[i, :3], pitch=10, time=time[i], draw=draw[i], ping=i)
        assert np.array_equal(ping.pressure, single.pressure)
    still = list(simulator.pings(scene, poses, draw=draw))
    assert np.array_equal(made[0].pressure, still[0].pressure)
    assert not np.array_equal(made[1].pressure, still[1].pressure)
    first = simulator.ping(scene, poses[2, :3], pitch=10, time=3, ping=2)
    assert not np.array_equal(made[2].pressure, first.pressure)


classes = """schema = 1
[[part]]
file = "harbour.ply"
[[scatter]]
files = ["ball.ply", "ball.ply", "ball.ply"]
names = ["tyre", "mine", "cinder_block"]
count = [1, 1]
area_m = [[4, -2], [8, -2], [8, 2], [4, 2]]
"""


def test_class_and_object_numbers_are_the_same_in_all_draws(parts, folder, simulator):
    """Each draw has one of three bodies; its number means the same class in all of them."""
    (folder / "classes.toml").write_text(classes)
    scene = iy.load_scene(folder / "classes.toml")
    labels = ["tyre", "mine", "cinder_block"]
    assert [name for name in scene.material_names if name in labels] == labels  # the order of the file
    shown = {}
    poses = np.tile((0, 0, -2, 0, 10, 0), (8, 1))
    for ping in simulator.pings(scene, poses, draw=np.arange(8), keep="contributors"):
        assert ping.class_names == scene.material_names
        assert ping.part_names == ["harbour", "cinder_block-1", "mine-1", "tyre-1"]
        for number, name in enumerate(ping.part_names):
            if name == "harbour":
                continue
            mask = ping.instance_image == number + 1
            if mask.any():
                shown[name] = {ping.class_names[k] for k in np.unique(ping.material_image[mask])}
        assert not (ping.instance_image == 1).any()  # a part without a label is no object
    for part in ping.parts:
        assert ping.part_names[part["number"] - 1] == part["part"]
        if part["visible_share"] > 0:
            assert part["scale"] == 1 and part["class"] == part["part"][:-2]
            assert np.allclose(part["size_m"], 0.6, atol=0.02)  # of a polyhedron
            assert part["world_from_part"].shape == (4, 4) and 0.5 < part["range_m"][0] < part["range_m"][1] < 12
    assert {part["part"] for part in ping.parts if np.isnan(part["scale"])} >= {"harbour"}
    assert len(shown) >= 2
    assert all(found == {name[:-2]} for name, found in shown.items())


@pytest.mark.parametrize("keys, said", [({"time": [0, 1]}, r"pings: time .*shape \(3,\)"), ({"draw": [0, 1, -2]}, r"pings: draw\[2\]"),
                                        ({"draw": -1}, "draw")])
def test_times_and_draws_are_checked(parts, simulator, keys, said):
    with pytest.raises(iy.ArgumentError, match=said):
        simulator.pings(iy.load_scene(parts), np.zeros((3, 6)), **keys)
