# SPDX-License-Identifier: BSD-3-Clause
"""Scenes whose parts are added, moved and removed between pings."""
from __future__ import annotations

import h5py
import insonify as iy
import numpy as np
import pytest

head_at = {"position": (0, 0, 2), "pitch": 12}
poses = np.array([(0, 0, 2, 0, 12, 0), (0.4, 0.2, 2, 3, 12, 0)])
radius = 0.4


def bed_arrays():
    x, y = np.meshgrid(np.arange(0, 14, 0.08), np.arange(-6, 6, 0.08))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    return points, {"normals": np.tile((0, 0, 1), (len(points), 1)), "areas": np.full(len(points), 0.0064)}


def bed(**more) -> iy.Scene:
    points, arrays = bed_arrays()
    return iy.Scene(points, **arrays, **{"material": "sand", **more})


@pytest.fixture(scope="module")
def ball(tmp_path_factory, tool):
    """The file of a ball as a mesh."""
    folder = tmp_path_factory.mktemp("ball")
    tool("make-object", "sphere", "--set", f"diameter_m={2 * radius}", "-o", "ball.ply", folder=folder)
    return folder / "ball.ply"


@pytest.fixture(scope="module")
def sim() -> iy.PingSimulator:
    return iy.PingSimulator(iy.sonar("p900-45", beams=96, min_range=2, max_range=12))


def is_at(ping: iy.Ping, number: int, place) -> bool:
    """Whether the pixels of an object lie where a head hears a ball there."""
    beams, cells = np.nonzero(ping.instance_image == number)
    x, y, z = np.linalg.inv(ping.world_from_head)[:3] @ (*place, 1)
    away = np.sqrt(x * x + y * y + z * z)
    off = np.abs(ping.azimuth[beams].mean() - np.arctan2(y, x)) * away
    return len(beams) > 3 and bool(off < radius) and abs(ping.range[cells].min() - (away - radius)) < 0.2


def test_ids_and_classes_are_right_after_each_edit(sim, ball):
    scene = bed()
    north = scene.add(ball, name="north", class_="mine", material="steel", pose=(6, 1, 0.3, 0, 0, 0))
    south = scene.add(ball, name="south", class_="buoy", material="steel", pose=(8, -2, 0.3, 0, 0, 0))
    numbers = {name: scene.material_names.index(name) for name in ("sand", "mine", "buoy")}

    def seen(**places):
        ping = sim.ping(scene, **head_at, keep="labels")
        assert set(np.unique(ping.instance_image)) & {north, south} == {globals_of[name] for name in places}
        for name, place in places.items():
            assert is_at(ping, globals_of[name], place)
            pixels = ping.material_image[ping.instance_image == globals_of[name]]
            assert set(np.unique(pixels)) == {numbers["mine" if name == "north" else "buoy"]}
            assert np.allclose(ping.part_poses[name][:3, 3], place)
        assert ping.part_names[north - 1] == "north" and ping.part_names[south - 1] == "south"

    globals_of = {"north": north, "south": south}
    assert (north, south) == (2, 3)
    seen(north=(6, 1, 0.3), south=(8, -2, 0.3))
    scene.move(north, (7, 1.5, 0.3, 30, 0, 0))
    seen(north=(7, 1.5, 0.3), south=(8, -2, 0.3))
    scene.remove(north)
    seen(south=(8, -2, 0.3))
    assert {name: scene.material_names.index(name) for name in numbers} == numbers
    assert scene.add(ball, name="third", material="steel", pose=(5, 0, 0.3, 0, 0, 0)) == 4
    place = np.eye(4)
    place[:3, 3] = 6, -1, 0.3
    scene.move(south, place)
    seen(south=(6, -1, 0.3))
    assert [part["id"] for part in scene.parts] == [1, 3, 4]
    assert [part["class"] for part in scene.parts] == ["", "buoy", "third"]


def test_views_show_what_the_scene_holds_when_they_begin(sim, ball):
    scene = bed()
    one = scene.add(ball, name="one", class_="mine", material="steel", pose=(6, 1, 0.3, 0, 0, 0))
    views = sim.views(scene, poses, width=200, height=240, stuff=["sand"])
    first = next(views)
    scene.move(one, (9, -2, 0.3, 0, 0, 0))
    second = next(views)  # asked for before the move
    for view in (first, second):
        (found,) = view.objects
        assert (found["id"], found["class"], found["name"]) == (one, "mine", "one")
        assert np.allclose(found["pose"][:3, 3], (6, 1, 0.3)) and np.allclose(found["size_m"], 0.8, atol=0.02)
        assert set(np.unique(view.instances)) == {0, one}
    (moved,) = next(sim.views(scene, poses[:1], width=200, height=240, stuff=["sand"])).objects
    assert moved["id"] == one and np.allclose(moved["pose"][:3, 3], (9, -2, 0.3))
    assert np.allclose(first.ping.part_poses["one"][:3, 3], (6, 1, 0.3))


def test_a_scene_is_again_what_it_was_when_a_part_is_removed(sim, ball):
    scene = bed()
    before = sim.ping(scene, **head_at).pressure
    part = scene.add(ball, material="steel", pose=(6, 1, 0.3, 0, 0, 0))
    assert len(scene) > len(bed()) and not np.array_equal(sim.ping(scene, **head_at).pressure, before)
    scene.remove(part)
    after = sim.ping(scene, **head_at).pressure
    assert len(scene) == len(bed()) and np.abs(after - before).max() < 1e-5 * np.abs(before).max()


def test_given_objects_of_the_ground_stay(sim, ball):
    points, _ = bed_arrays()
    scene = bed(instance=np.where(points[:, 1] > 2, 5, 0))
    number = scene.add(ball, class_="mine", material="steel", pose=(6, -1, 0.3, 0, 0, 0))
    assert number == 7
    ping = sim.ping(scene, **head_at, keep="labels")
    assert {5, 7} <= set(np.unique(ping.instance_image)) and is_at(ping, 7, (6, -1, 0.3))
    assert (ping.azimuth[np.nonzero(ping.instance_image == 5)[0]] > 0).all()
    (found,) = [part for part in ping.parts if part["class"] == "mine"]
    assert found["number"] == 7


def test_pings_of_edited_scenes_are_saved_and_say_the_same(sim, ball, tmp_path):
    scene = bed()
    part = scene.add(ball, name="one", class_="mine", material="steel", pose=(6, 1, 0.3, 0, 0, 0))
    ping, away = sim.ping(scene, **head_at, keep="contributors"), sim.ping(scene, (0, 0, 200))
    scene.remove(part)
    ping.save(tmp_path / "run", picture=False)
    with h5py.File(tmp_path / "run" / "contributors.h5") as file:
        assert np.array_equal(file["instance_image"][:], ping.instance_image) and (ping.instance_image == part).any()
    with h5py.File(tmp_path / "run" / "cube.h5") as file:
        assert file["pressure"][0].tobytes() == ping.pressure.tobytes()
    assert any("silent" in note for note in away.notes) and not any("silent" in note for note in ping.notes)


def test_bodies_may_be_files_scenes_points_and_meshes(sim, ball):
    corners = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], float)
    triangles = [(0, 1, 2), (0, 2, 3)]
    points = np.random.default_rng(1).uniform((0, 0, 0), (1, 1, 0.001), (500, 3))
    scene = bed()
    for body, keys in ((str(ball), {}), (iy.load_scene(ball), {}), ((corners, triangles), {"material": "steel"}),
                       (points, {"material": "steel", "viewpoint": (0, 0, 5)})):
        scene.add(body, pose=(6, 1, 0.2, 0, 0, 0), **keys)
    assert [part["name"] for part in scene.parts] == ["scene", "part 2", "part 3", "part 4", "part 5"]
    surfels = [part["surfels"] for part in scene.parts]
    assert surfels[1] == surfels[2] and 450 < surfels[4] <= 500
    plate = scene.points[np.sum(surfels[:3]):np.sum(surfels[:4])]
    assert np.allclose(plate.min(axis=0), (6, 1, 0.2), atol=0.03) and np.allclose(plate.max(axis=0), (7, 2, 0.2), atol=0.03)
    assert scene.areas[np.sum(surfels[:3]):np.sum(surfels[:4])].sum() == pytest.approx(1, rel=1e-3)
    finer = scene.add((corners, triangles), spacing=0.01, pose=(3, 1, 0.2, 0, 0, 0))
    assert next(part for part in scene.parts if part["id"] == finer)["surfels"] > 1 / (1.4 * 0.01**2)


def test_scenes_of_parts_are_edited(sim, ball, tool):
    folder = ball.parent
    tool("make-scene", "plane", "--size", "16,12", "--points", "20000", "-o", "seabed.ply", folder=folder)
    (folder / "field.toml").write_text('schema = 1\n[[part]]\nfile = "seabed.ply"\n[[part]]\nname = "north"\nfile = "ball.ply"\n'
                                       'position_m = [6, 1, 0.3]\nrest = "none"\n')
    scene = iy.load_scene(folder / "field.toml")
    before = sim.ping(scene, **head_at, keep="labels")
    north = before.part_names.index("north") + 1
    assert is_at(before, north, (6, 1, 0.3))
    scene.move(north, (8, -2, 0.3, 0, 0, 0))
    after = sim.ping(scene, **head_at, keep="labels")
    assert after.part_names == before.part_names and after.class_names == before.class_names
    assert is_at(after, north, (8, -2, 0.3)) and is_at(before, north, (6, 1, 0.3))
    (folder / "moving.toml").write_text((folder / "field.toml").read_text() + "velocity_mps = [1, 0, 0]\n")
    with pytest.raises(iy.ArgumentError, match="moving.toml: parts of it move"):
        iy.load_scene(folder / "moving.toml").add(ball)


def test_edits_say_what_is_wrong(ball):
    scene = bed()
    part = scene.add(ball, name="mine")
    for edit, said in ((lambda: scene.remove(7), "no part has the id 7; ids are 1 to 2"), (lambda: scene.remove(-3), "-3"),
                       (lambda: scene.remove(1), "'scene', stands as captured"),
                       (lambda: scene.add(ball, name="mine"), "two parts are called 'mine'"),
                       (lambda: scene.move(part, (1, 2, 3)), r"pose .* shape \(6,\)"),
                       (lambda: scene.move(part, 2 * np.eye(4)), "last row"),
                       (lambda: scene.move(part, np.diag((2, 2, 2, 1))), "a rotation and a translation"),
                       (lambda: scene.move(part, (0,) * 6, velocity=(1, 2)), "velocity"),
                       (lambda: scene.add(bed(), material="sand"), "material: the body is a Scene"),
                       (lambda: scene.add(ball, unt="m"), "unknown keyword 'unt'; did you mean 'unit'"),
                       (lambda: scene.add((np.zeros((3, 3)), [(0, 1, 3)])), r"triangles\[2\] = 3")):
        with pytest.raises(iy.ArgumentError, match=said):
            edit()
    assert [entry["id"] for entry in scene.parts] == [1, 2]
