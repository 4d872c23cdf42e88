# SPDX-License-Identifier: BSD-3-Clause
"""What a ping and a scene hold, as arrays; velocities of poses; heads of several rows."""
from __future__ import annotations

import h5py
import insonify as iy
import numpy as np
import pytest


def test_contributors_and_elements_are_those_of_the_files(scene, tmp_path):
    head = iy.sonar("p900-45", beams=16, min_range=1, max_range=6)
    ping = iy.PingSimulator(head, keep=["contributors", "elements"], contributors=3).ping(scene, (0, 0, -3), pitch=10)
    ping.save(tmp_path / "run", picture=False)
    with h5py.File(tmp_path / "run" / "contributors.h5") as file:
        stored = {name: array for name, array in ping.contributors.items() if name in file}
        assert set(ping.contributors) - set(stored) == {"total"}
        for name, array in stored.items():
            assert file[name][:].tobytes() == array.tobytes(), name
        assert ping.contributors["total"].shape == ping.pressure.shape and ping.contributors["share"].shape == (*ping.pressure.shape, 3)
    with h5py.File(tmp_path / "run" / "elements.h5") as file:
        stored, series = file["pressure"][:], ping.elements
        assert stored.shape == series["pressure"].shape and np.abs(series["pressure"]).max() > 0
        assert np.array_equal(series["pressure"].astype(np.complex64), stored)
        assert (series["start"], series["step"]) == (file.attrs["start"], file.attrs["step"])
    with h5py.File(tmp_path / "run" / "cube.h5") as file:
        assert ping.absorption_db_per_m == pytest.approx(float(file.attrs["absorption_db_per_m"]), rel=1e-12)
    plain = iy.PingSimulator(head).ping(scene, (0, 0, -3), pitch=10)
    assert plain.contributors is None and plain.elements is None and plain.part_poses == {}


def test_points_of_a_scene_are_those_given():
    draw = np.random.default_rng(3)
    points = draw.uniform((1000, 0, -5), (1020, 10, -4), (500, 3))
    normals, areas = draw.normal(size=(500, 3)), draw.uniform(0.01, 0.02, 500)
    names = draw.choice(["sand", "rock", "steel"], 500)
    scene = iy.Scene(points, normals=normals, areas=areas, material=names)
    assert scene.points.shape == (500, 3) and np.allclose(scene.points, points, atol=2e-6)
    assert np.allclose(scene.normals, normals / np.linalg.norm(normals, axis=1, keepdims=True), atol=1e-6)
    assert np.array_equal(scene.areas, areas.astype(np.float32)) and scene.parts == []
    assert [scene.material_names[number] for number in scene.materials] == list(names)
    assert [material for material in iy.Scene(points, normals=normals, areas=areas, material=list(names)).materials] == list(
        scene.materials)
    for material, said in ((["sand"] * 7, "material has 7 names, must have 500"), (["sandd"] * 500, "did you mean 'sand'"),
                           (np.array(["sand"] * 499 + [3], object), r"material\[499\] is a int")):
        with pytest.raises(iy.ArgumentError, match=said):
            iy.Scene(points, normals=normals, areas=areas, material=material)


def test_pings_have_the_velocities_of_their_poses(simulator, scene):
    poses = np.array([(0.2 * i, 0, -3, 0, 10, 0) for i in range(3)])
    velocity, turn_rate = np.array([(2, 0, 0), (0, 0, 0), (0, 1.5, 0)]), np.array([(0, 0, 0), (0, 0, 10), (0, 0, 20)])
    made = list(simulator.pings(scene, poses, velocity=velocity, turn_rate=turn_rate))
    for i, ping in enumerate(made):
        single = simulator.ping(scene, poses[i, :3], pitch=10, ping=i, velocity=velocity[i], turn_rate=turn_rate[i])
        assert np.array_equal(ping.pressure, single.pressure)
    still = list(simulator.pings(scene, poses, velocity=(2, 0, 0)))
    assert np.array_equal(still[0].pressure, made[0].pressure) and not np.array_equal(still[1].pressure, made[1].pressure)
    views = [view.image for view in simulator.views(scene, poses, width=64, height=64, velocity=velocity)]
    assert len(views) == 3
    with pytest.raises(iy.ArgumentError, match=r"pings: velocity .* shape \(3, 3\)"):
        simulator.pings(scene, poses, velocity=velocity[:2])


def test_a_head_of_several_rows_has_the_parts_of_its_middle_row():
    x, y = np.meshgrid(np.arange(0, 14, 0.08), np.arange(-6, 6, 0.08))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    scene = iy.Scene(points, normals=np.tile((0, 0, 1), (len(points), 1)), areas=np.full(len(points), 0.0064))
    corners = 0.6 * np.array([(0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1)])
    plate = scene.add((corners, [(0, 2, 1), (0, 3, 2)]), name="plate", class_="mine", material="steel",
                      pose=(7, -0.3, 0, 0, 0, 0))
    head = iy.sonar("p900-45", beams=48, elevations_deg=(-18, -12, -6), min_range=2, max_range=11)
    sim = iy.PingSimulator(head)
    ping = sim.ping(scene, (0, 0, 2), keep="labels")
    rows = np.unique(ping.elevation)
    assert len(rows) == 3 and ping.instance_image.shape[0] == 3 * 48
    for geometry in ("fan", "polar"):
        (view,) = sim.views(scene, [(0, 0, 2, 0, 0, 0)], height=200, geometry=geometry)
        (found,) = [seen for seen in view.objects if seen["id"] == plate]
        assert (found["name"], found["class"]) == ("plate", "mine") and np.allclose(found["pose"][:3, 3], (7, -0.3, 0))
        assert (view.instances == plate).sum() == found["pixels"] > 20
        middle = ping.elevation == rows[1]
        if geometry == "polar":
            assert view.instances.shape == (200, middle.sum())


def test_errors_speak_of_keywords(simulator, scene, tmp_path):
    ping = simulator.ping(scene, (0, 0, -3), pitch=10)
    ping.save(tmp_path / "run", picture=False)
    with pytest.raises(iy.Error, match="give force=True to replace it") as caught:
        ping.save(tmp_path / "run", picture=False)
    assert "--" not in str(caught.value)
    for call, said in ((lambda: iy.Scene(np.eye(3), material="sandd"), "^material = 'sandd' is unknown"),
                       (lambda: simulator.ping(scene, (0, 0, -3), velocity="fast"), "^ping: velocity = "),
                       (lambda: iy.PingSimulator(iy.sonar("p900-45"), all_bins_above="loud"), "all_bins_above")):
        with pytest.raises(iy.ArgumentError, match=said) as caught:
            call()
        assert "--" not in str(caught.value)
