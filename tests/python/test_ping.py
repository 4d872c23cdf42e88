# SPDX-License-Identifier: BSD-3-Clause
"""Pings from Python are those of the tool, arrays are views, runs are folders of the tool."""
from __future__ import annotations

import hashlib
import json

import h5py
import insonify as iy
import numpy as np
import pytest

at = {"position": (0, 0, -3), "pitch": 10}


def digests(folder):
    return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in folder.iterdir() if p.name != "manifest.json"}


def manifest_of(folder):
    manifest = json.loads((folder / "manifest.json").read_text())
    for varies in ("seconds", "peak_memory_mib"):
        del manifest[varies]
    return manifest


@pytest.fixture(scope="module")
def runs(folder, tool, request):
    """The same ping, with all that can be kept, by the tool and from Python."""
    tool("ping", "harbour.ply", "--sonar", "p900-45", "--pose=0,0,-3,5,10,-2.5", "--range", "1:12", "--seed", "7",
         "--noise", "--keep", "contributors,mask,insonification,paths", "--layers", "--accuracy-db", "0.2",
         "--set", "water.temperature_c=8", "--set", "surface.height_m=0", "--set", "sonar.beams=32",
         "--looks-range", "2", "--velocity=1,0.5,0", "--time", "1.5", "-o", "tool", folder=folder)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        scene = iy.load_scene("harbour.ply")
        head = iy.sonar("p900-45", beams=32, min_range=1, max_range=12)
        sim = iy.PingSimulator(head, iy.Environment(temperature_c=8, surface_height=0), accuracy_db=0.2, noise=True,
                               layers=True, looks_range=2)
        ping = sim.ping(scene, (0, 0, -3), yaw=5, pitch=10, roll=-2.5, seed=7, time=1.5, velocity=(1, 0.5, 0),
                        keep=["contributors", "mask", "insonification", "paths"])
        ping.save("python")
    return ping, folder / "tool", folder / "python"


def test_arrays_have_the_bytes_of_the_cube(runs):
    ping, by_tool, _ = runs
    with h5py.File(by_tool / "cube.h5") as cube:
        assert ping.pressure.dtype == np.complex64
        assert cube["pressure"][0].tobytes() == ping.pressure.tobytes()
        for name, array in {"range": ping.range, "azimuth": ping.azimuth, "elevation": ping.elevation}.items():
            assert cube[name][:].tobytes() == array.tobytes(), name
        assert cube["intensity"][0].tobytes() == ping.intensity.tobytes()
        assert cube["unknown"][0].tobytes() == ping.unknown.tobytes()
        assert set(cube["layers"]) == set(ping.layers) and len(ping.layers) == 2
        assert cube["layers/noise"][0].tobytes() == ping.layers["noise"].tobytes()
        assert np.array_equal(cube["pose"][0], ping.world_from_head)
    with h5py.File(by_tool / "contributors.h5") as file:
        assert file["material_image"][:].tobytes() == ping.material_image.tobytes()
        assert file["instance_image"][:].tobytes() == ping.instance_image.tobytes()
    assert ping.number == 1500 and ping.time == 1.5 and ping.seed == 7


def test_a_saved_run_is_that_of_the_tool(runs):
    _, by_tool, by_python = runs
    assert digests(by_tool) == digests(by_python)
    assert len(digests(by_tool)) == 9
    assert manifest_of(by_tool) == manifest_of(by_python)


def test_soundings_are_the_returns(runs):
    ping, by_tool, _ = runs
    found = ping.soundings
    assert found.dtype.names == ("position", "level_db", "range", "azimuth", "elevation", "ping", "beam", "bin",
                                 "true_elevation", "true_surfel", "true_material")
    text = (by_tool / "returns.ply").read_bytes()
    header, rows = text.split(b"end_header\n")
    assert len(found) > 10 and f"element vertex {len(found)}\n".encode() in header
    first = np.frombuffer(rows[:24], "<f8")
    assert np.array_equal(first, found["position"][0])
    assert np.all(np.abs(found["range"] - ping.range[found["bin"]]) < 0.1)


def test_views_are_the_buffer_of_the_ping(simulator, scene):
    ping = simulator.ping(scene, **at)
    one, other = ping.pressure, ping.pressure
    assert one.__array_interface__["data"][0] == other.__array_interface__["data"][0]
    assert one.base is ping and not one.flags.owndata and not one.flags.writeable and one.flags.c_contiguous
    level = ping.level_db()
    heard = level > -200
    rms = np.abs(one[heard].astype(complex)) / np.sqrt(2)
    assert heard.any() and np.allclose(level[heard], 20 * np.log10(rms / 1e-6), atol=1e-3)
    assert ping.level_db(floor_db=60).min() == 60
    del ping, other
    assert np.isfinite(one).all()  # the array holds the ping


def test_a_seed_and_a_number_change_what_they_should(simulator, scene):
    first = simulator.ping(scene, **at, seed=7)
    assert np.array_equal(first.pressure, simulator.ping(scene, **at, seed=7).pressure)
    assert not np.array_equal(first.pressure, simulator.ping(scene, **at, seed=8).pressure)
    huge = simulator.ping(scene, **at, seed=2**63 + 1)
    assert huge.seed == 2**63 + 1


def test_arrays_make_the_same_ping_as_a_file(head, tmp_path, tool):
    """A plane in arrays, and as a file of the same surfels."""
    x, y = np.meshgrid(np.arange(0, 8, 0.1), np.arange(-4, 4, 0.1))
    points = np.stack([x.ravel(), y.ravel(), 0.1 * np.sin(x.ravel())], axis=1)
    normals = np.stack([-0.1 * np.cos(x.ravel()), 0 * x.ravel(), 1 + 0 * x.ravel()], axis=1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    areas = np.full(len(points), 0.01)
    of_arrays = iy.Scene(points, normals=normals, areas=areas)
    rows = np.hstack([points, normals, areas[:, None]]).astype("<f4")
    names = ["x", "y", "z", "nx", "ny", "nz", "area"]
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(rows)}\n"
    header += "".join(f"property float {name}\n" for name in names) + "end_header\n"
    (tmp_path / "plane.ply").write_bytes(header.encode() + rows.tobytes())
    of_file = iy.load_scene(tmp_path / "plane.ply", scan_noise=0)
    assert len(of_arrays) == len(of_file) == len(points)
    assert np.array_equal(of_arrays.origin, of_file.origin)
    sim = iy.PingSimulator(head)
    one, other = (sim.ping(s, (-2, 0, 3), pitch=30).level_db() for s in (of_arrays, of_file))
    assert one.max() > 60 and np.abs(one - other)[one > one.max() - 40].mean() < 0.3


def test_arrays_without_normals_and_areas_are_completed(head):
    draw = np.random.default_rng(1)
    points = draw.uniform((0, -4, 0), (8, 4, 0.01), size=(4000, 3))
    bare = iy.Scene(points, viewpoint=(0, 0, 5))
    assert 0.95 * 4000 < len(bare) <= 4000
    ping = iy.PingSimulator(head).ping(bare, (-2, 0, 3), pitch=30)
    assert ping.level_db().max() > 60


def test_materials_and_instances_of_arrays(head, tmp_path):
    x, y = np.meshgrid(np.arange(0, 8, 0.1), np.arange(-4, 4, 0.1))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    up, areas = np.tile((0, 0, 1), (len(points), 1)), np.full(len(points), 0.01)
    label = (points[:, 1] > 0).astype(np.uint8)
    instance = np.where(points[:, 1] > 0, 5, 3)
    scene = iy.Scene(points, normals=up, areas=areas, material=label, instance=instance)
    assert scene.material_names == ["label 0", "label 1"]
    ping = iy.PingSimulator(head).ping(scene, (-2, 0, 3), pitch=30, keep="contributors")
    port = ping.azimuth > 0.05
    assert set(np.unique(ping.material_image[port])) <= {1, 65534, 65535}
    assert (ping.material_image[port] == 1).any() and (ping.material_image[ping.azimuth < -0.05] == 0).any()
    assert ping.material_image.shape == ping.instance_image.shape == ping.pressure.shape
    assert set(np.unique(ping.instance_image)) == {0, 3, 5}  # as given
    assert ping.class_names == scene.material_names and ping.part_names == [] and scene.given_instances == {}
    turned = iy.PingSimulator(head).ping(scene, (-2, 3, 3), yaw=25, pitch=30, keep="contributors")
    assert set(np.unique(turned.instance_image)) <= {0, 3, 5}
    instance[instance == 5] = 70000
    large = iy.Scene(points, normals=up, areas=areas, material=label, instance=instance)
    assert large.given_instances == {1: 70000}
    ping = iy.PingSimulator(head).ping(large, (-2, 0, 3), pitch=30, keep="contributors")
    assert set(np.unique(ping.instance_image)) == {0, 1, 3}
    sand = iy.Scene(points, normals=up, areas=areas, material="sand")
    assert "sand" in sand.material_names
    ping.save(tmp_path / "run")
    assert (tmp_path / "run" / "cube.h5").exists()


def test_meshes_are_sampled_for_each_ping(head, tmp_path, tool):
    (tmp_path / "floor.obj").write_text("v 0 -5 0\nv 10 -5 0\nv 10 5 0\nv 0 5 0\nf 1 2 3\nf 1 3 4\n")
    tool("ping", "floor.obj", "--sonar", "p900-45", "--pose=-1,0,3,0,30,0", "--range", "1:12", "--set",
         "sonar.beams=32", "-o", "tool", folder=tmp_path)
    ping = iy.PingSimulator(head).ping(iy.load_scene(tmp_path / "floor.obj"), (-1, 0, 3), pitch=30)
    ping.save(tmp_path / "python", picture=False)
    assert not (tmp_path / "python" / "fan.png").exists()
    assert (tmp_path / "tool" / "cube.h5").read_bytes() == (tmp_path / "python" / "cube.h5").read_bytes()


def test_a_mounted_head_looks_as_its_file_says(scene, tmp_path, folder, tool):
    tool("ping", "harbour.ply", "--sonar", "em2040", "--pose=20,0,-1,0,0,0", "--range", "1:12", "-o", tmp_path / "tool",
         folder=folder)
    ping = iy.PingSimulator(iy.sonar("em2040", min_range=1, max_range=12)).ping(scene, (20, 0, -1))
    assert ping.world_from_head[2, 0] < -0.9  # down
    ping.save(tmp_path / "python")
    assert digests(tmp_path / "tool")["cube.h5"] == digests(tmp_path / "python")["cube.h5"]


def test_a_mounting_is_a_key_of_a_sonar(scene, tmp_path, folder):
    down = iy.sonar("p900-45", beams=32, min_range=1, max_range=12, mounting_deg=(0, 90, 0))
    assert "mounting_deg = [0.0, 90.0, 0.0]" in down.toml and "mounting_deg" not in iy.sonar("p900-45").toml
    assert iy.PingSimulator(down).ping(scene, (20, 0, -1)).world_from_head[2, 0] < -0.99
    (tmp_path / "down.toml").write_text(down.toml)
    again = iy.PingSimulator(iy.sonar(tmp_path / "down.toml")).ping(scene, (20, 0, -1))
    assert np.array_equal(again.pressure, iy.PingSimulator(down).ping(scene, (20, 0, -1)).pressure)


def test_levels_of_looks_are_of_the_intensity(head, scene):
    ping = iy.PingSimulator(head, looks_range=4).ping(scene, (0, 0, -3), pitch=10)
    loud = ping.intensity > 1e-6
    expected = 10 * np.log10(ping.intensity[loud])
    difference = ping.level_db()[loud] - expected
    assert np.ptp(difference) < 1e-3
    plain = 20 * np.log10(np.abs(ping.pressure[loud]))
    assert np.std(ping.level_db()[loud] - plain) > 1


def test_display_cells_are_an_image_without_samples(head, scene):
    pose = ((0, 0, -3), 0, 10)
    cells = iy.PingSimulator(head, display=50, noise=True).ping(scene, pose[0], pitch=pose[2])
    samples = iy.PingSimulator(head, display=50, noise=True, with_="phases").ping(scene, pose[0], pitch=pose[2])
    assert cells.display_cells and samples.display_cells and not iy.PingSimulator(head).ping(scene, pose[0]).display_cells
    assert cells.pressure.shape == samples.pressure.shape == (cells.azimuth.size, 50)
    assert np.all(cells.pressure.imag == 0)
    power = [np.sum(np.abs(p.pressure) ** 2) for p in (cells, samples)]
    assert abs(10 * np.log10(power[0] / power[1])) < 0.5


def test_labels_are_of_display_cells(head):
    x, y = np.meshgrid(np.arange(0, 8, 0.1), np.arange(-4, 4, 0.1))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    scene = iy.Scene(points, normals=np.tile((0, 0, 1), (len(points), 1)), areas=np.full(len(points), 0.01),
                     material=(points[:, 1] > 0).astype(np.uint8))
    above = dict(position=(-2, 0, 3), pitch=30)
    simulator = iy.PingSimulator(head, display=40)
    labelled = simulator.ping(scene, **above, keep="labels")
    shape = (labelled.azimuth.size, 40)
    assert labelled.display_cells and labelled.material_image.shape == labelled.instance_image.shape == shape
    assert np.array_equal(labelled.pressure, simulator.ping(scene, **above).pressure)
    seen = labelled.material_image < 65534
    assert seen.sum() > 200 and (labelled.label_share[seen] >= 0.5).all() and labelled.label_share.max() <= 1
    assert labelled.label_elevation[seen].min() < -0.1
    beside = labelled.second_image != 65535
    assert beside.any() and (labelled.second_share[beside] + labelled.label_share[beside] <= 1.04).all()
    assert iy.PingSimulator(head).ping(scene, **above, keep="labels").material_image.shape == (shape[0], 600)
    of_samples = iy.PingSimulator(head).ping(scene, **above, keep="contributors")
    assert of_samples.second_image is None and of_samples.label_share.shape == of_samples.pressure.shape
    with pytest.raises(iy.ArgumentError, match="keep=\"labels\""):
        simulator.ping(scene, **above).label_share


def test_notes_are_those_of_the_tool(head, scene, folder, tool, tmp_path):
    tool("ping", "harbour.ply", "--sonar", "p900-45", "--pose=0,0,-3,0,-89,0", "--range", "1:4", "--set",
         "sonar.beams=32", "-o", tmp_path / "away", folder=folder)
    by_tool = json.loads((tmp_path / "away" / "manifest.json").read_text())["notes"]
    away = iy.sonar("p900-45", beams=32, min_range=1, max_range=4)
    notes = iy.PingSimulator(away).ping(scene, (0, 0, -3), pitch=-89).notes
    assert notes and all(note in by_tool for note in notes)
    assert [note for note in by_tool if note not in notes + scene.notes] == []


def test_pictures(simulator, scene, tmp_path):
    ping = simulator.ping(scene, **at)
    ping.save(tmp_path / "run")
    iy.draw_fan(ping, tmp_path / "fan.png")
    assert (tmp_path / "fan.png").read_bytes() == (tmp_path / "run" / "fan.png").read_bytes()
    iy.draw_fan(ping, str(tmp_path / "small.png"), width=400, height=300, title="a fan", dark=True, min_db=40, max_db=90)
    assert 0 < (tmp_path / "small.png").stat().st_size < (tmp_path / "fan.png").stat().st_size


def test_the_plan_names_its_stages(simulator, scene):
    stages = {stage["name"]: stage for stage in simulator.plan(scene, (0, 0, -3), pitch=10)}
    assert "multipath" in stages and not stages["multipath"]["included"] and stages["multipath"]["why"]
