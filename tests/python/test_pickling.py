# SPDX-License-Identifier: BSD-3-Clause
"""Heads, environments, simulators and results pickle: workers that are spawned make the same pings and hand them back."""
from __future__ import annotations

import multiprocessing
import pickle

import insonify as iy
import numpy as np
import pytest

poses = np.array([(0, 0, -3, 0, 10, 0), (0.5, 0, -3, 2, 10, 0), (1, 0, -3, 4, 10, 0)])


def ping_in_worker(work):
    simulator, index = work
    scene = iy.make_scene("harbour", points=20000)
    return simulator.ping(scene, poses[index, :3], *poses[index, 3:], ping=index)


def view_in_worker(simulator):
    scene = iy.make_scene("harbour", points=20000)
    return next(simulator.views(scene, poses[:1], width=64, height=64))


@pytest.fixture(scope="module")
def sim() -> iy.PingSimulator:
    sea = iy.Environment(temperature_c=8, surface_height=0, profile_depth=[0, 50], profile_sound_speed=[1480, 1490])
    head = iy.sonar("p900-45", beams=32, min_range=1, max_range=12, mounting_deg=(3, 2, 1))
    return iy.PingSimulator(head, sea, noise=True, keep=["contributors", "mask"], layers=True, seed=5)


def arrays_of(ping):
    """All arrays of a ping, by name."""
    arrays = {name: getattr(ping, name) for name in ("pressure", "unknown", "range", "azimuth", "elevation", "soundings",
              "world_from_head", "material_image", "instance_image", "label_share")}
    return {**arrays, **ping.layers, **{f"contributors {name}": array for name, array in ping.contributors.items()}}


def assert_same(one, other):
    for name, array in arrays_of(one).items():
        assert array.tobytes() == arrays_of(other)[name].tobytes(), name
    for name in ("number", "time", "seed", "sound_speed", "absorption_db_per_m", "notes", "class_names", "part_names",
                 "display_cells"):
        assert getattr(one, name) == getattr(other, name), name
    assert np.array_equal(one.level_db(), other.level_db())


def test_workers_that_are_spawned_make_the_same_pings(sim):
    with multiprocessing.get_context("spawn").Pool(2) as workers:
        made = workers.map(ping_in_worker, [(sim, index) for index in range(3)])
        view = workers.apply(view_in_worker, (iy.PingSimulator(iy.sonar("p900-45", beams=32, max_range=12)),))
    scene = iy.make_scene("harbour", points=20000)
    for index, ping in enumerate(made):
        assert_same(sim.ping(scene, poses[index, :3], *poses[index, 3:], ping=index), ping)
    assert view.image.shape == view.mask.shape == (64, 64) and view.ping.display_cells
    assert view._repr_png_()[1:4] == b"PNG"


def test_what_is_unpickled_says_and_draws_the_same(sim, tmp_path):
    scene = iy.make_scene("harbour", points=20000)
    ping = sim.ping(scene, (0, 0, -3), pitch=-89, time=2.5)
    again = pickle.loads(pickle.dumps(ping))
    assert_same(ping, again)
    assert ping._repr_png_() == again._repr_png_() and again._repr_png_()[1:4] == b"PNG"
    assert any("silent" in note for note in again.notes) and again.notes == ping.notes
    with pytest.raises(iy.ArgumentError, match="save: the ping was unpickled"):
        again.save(tmp_path / "run")
    assert pickle.loads(pickle.dumps(again)).pressure.tobytes() == ping.pressure.tobytes()


def test_objects_and_parts_come_along(tmp_path):
    x, y = np.meshgrid(np.arange(0, 8, 0.1), np.arange(-4, 4, 0.1))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    up, areas = np.tile((0, 0, 1), (len(points), 1)), np.full(len(points), 0.01)
    sim = iy.PingSimulator(iy.sonar("p900-45", beams=32, min_range=1, max_range=12))
    scene = iy.Scene(points, normals=up, areas=areas, instance=np.where(points[:, 1] > 0, 5, 3))
    for parts in range(0, 3, 2):
        assert len(scene.parts) == parts
        ping = sim.ping(scene, (-2, 0, 3), pitch=30, keep="labels")
        again = pickle.loads(pickle.dumps(ping))
        assert {3, 5} <= set(np.unique(again.instance_image))
        assert np.array_equal(again.instance_image, ping.instance_image)
        assert np.array_equal(again.label_elevation, ping.label_elevation)
        assert str(again.parts) == str(ping.parts) and len(again.parts) == len(scene.parts)
        assert {name: pose.tolist() for name, pose in again.part_poses.items()} == {
            name: pose.tolist() for name, pose in ping.part_poses.items()}
        if not parts:
            scene.add((points + (4, 0, 1), [(0, 1, 100)]), name="plate")


def test_keys_of_heads_and_environments_come_along(tmp_path, monkeypatch):
    (tmp_path / "own.toml").write_text(iy.sonar("oculus-m750d", max_range=20).toml)
    (tmp_path / "sea.toml").write_text(iy.Environment(temperature_c=3, wind_speed=7).toml)
    head, sea = iy.sonar(tmp_path / "own.toml", beams=77), iy.Environment(tmp_path / "sea.toml")
    heads, seas = pickle.dumps(head), pickle.dumps(sea)
    for path in tmp_path.iterdir():
        path.unlink()
    assert pickle.loads(heads).toml == head.toml and pickle.loads(seas).toml == sea.toml
    with pytest.raises(iy.Error, match="end early"):
        iy.Sonar.__new__(iy.Sonar).__setstate__(head.__getstate__()[:200])
    with pytest.raises(TypeError, match="pickle"):
        pickle.dumps(iy.make_scene("plane", points=100))
