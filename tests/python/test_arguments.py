# SPDX-License-Identifier: BSD-3-Clause
"""Bad input: an error that names the argument."""
from __future__ import annotations

import insonify as iy
import numpy as np
import pytest

points = np.array([[5, 0, 0], [5, 1, 0], [5, 0, 1]], float)
up, areas = np.tile((-1.0, 0, 0), (3, 1)), np.ones(3)
ragged = [[1, 2, 3], [4, 5]]


def scene_of(points=points, normals=up, areas=areas, **more):
    return iy.Scene(points, normals=normals, areas=areas, **more)


@pytest.mark.parametrize("arguments,names", [
    ({"points": points[:, :2]}, r"points is an array of float64 of shape \(3, 2\), must be finite numbers of shape \(n, 3\)"),
    ({"points": points[0]}, r"points .* shape \(3,\), must"),
    ({"points": np.zeros((0, 3))}, "points has no row"),
    ({"points": points.astype(str)}, "points is an array of <U"),
    ({"points": points.astype(complex)}, "points is an array of complex128"),
    ({"points": points > 0}, "points is an array of bool"),
    ({"points": np.where(points == 5, np.nan, points)}, "points: row 0 has nan"),
    ({"points": np.where(points == 1, np.inf, points)}, "points: row 1 has inf"),
    ({"points": "reef.ply"}, "points is an array of <U8"),
    ({"points": ragged}, "points is a"),
    ({"points": None}, "points is an array of object"),
    ({"normals": up[:2]}, r"normals is an array of float64 of shape \(2, 3\), must be finite numbers of shape \(3, 3\)"),
    ({"normals": 0 * up}, "normals: row 0 is zero"),
    ({"areas": -areas}, "areas.0. = -1, must be >= 0"),
    ({"areas": areas[:, None]}, r"areas .* must be finite numbers of shape \(3,\)"),
    ({"material": [0, 1, 0.5]}, "material.2. = 0.5, must be a whole number"),
    ({"material": [0, -1, 0]}, "material.1. = -1"),
    ({"material": [0, 70000, 0]}, "material.1. = 70000"),
    ({"material": "sandd"}, "'sandd' is unknown; did you mean 'sand'"),
    ({"instance": [1, 2]}, r"instance .* shape \(3,\)"),
    ({"viewpoint": (0, 0)}, "viewpoint"),
    ({"viewpont": (0, 0, 1)}, "unknown keyword 'viewpont'; did you mean 'viewpoint'"),
])
def test_scenes(arguments, names):
    with pytest.raises(iy.ArgumentError, match=names) as caught:
        scene_of(**arguments)
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, iy.Error)


@pytest.mark.parametrize("name,keys,names", [
    ("oculus-m750", {}, "oculus-m750d"),
    ("p900-45", {"beems": 3}, "sonar: unknown keyword 'beems'; did you mean 'beams'"),
    ("p900-45", {"beams": 2.5}, "beams = 2.5, must be a whole number"),
    ("p900-45", {"beams": "many"}, "beams = \"many\", must be"),
    ("p900-45", {"beams": {}}, "beams is a dict"),
    ("p900-45", {"beams": object()}, "beams is a object"),
    ("p900-45", {"min_range": np.nan}, "min_range_m = nan"),
    ("p900-45", {"min_range": 30, "max_range": 20}, "max_range_m"),
    ("p900-45", {"shading": "round"}, "shading = \"round\", must be one of taylor"),
    ("no-such-file.toml", {}, "no-such-file.toml"),
])
def test_sonars(name, keys, names):
    with pytest.raises(iy.Error, match=names):
        iy.sonar(name, **keys)


def test_keywords_of_sonars_and_environments():
    sonar = iy.sonar("p900-45", azimuths_deg=np.arange(-3, 4), min_range_m=np.float32(2), max_range=np.int64(9),
                     pulse="linear_fm", pulse_length=1e-3, bin_size=None)
    for line in ("azimuths_deg = [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0]", "min_range_m = 2.0", "max_range_m = 9.0",
                 'pulse = "linear_fm"', "pulse_length_s = 0.001"):
        assert line in sonar.toml.splitlines()
    for pulse in ("tone_burst", "hyperbolic_fm"):
        length = {"pulse_length": 1e-3} if pulse == "hyperbolic_fm" else {}
        assert f'pulse = "{pulse}"' in iy.sonar("p900-45", pulse=pulse, **length).toml.splitlines()
    sea = iy.Environment(temperature_c=8, surface_height=1, bottom_height_m=-20, surface_scattering_db=-40,
                         volume_scattering_db=-80, wind_speed=7, speed_m_s=7, profile_depth=[0, 50],
                         profile_sound_speed=[1500, 1490])
    for line in ("temperature_c = 8.0", "height_m = 1.0", "height_m = -20.0", "speed_m_s = 7.0",
                 "depth_m = [0.0, 50.0]", "sound_speed = [1500.0, 1490.0]"):
        assert line in sea.toml.splitlines()


@pytest.mark.parametrize("keys,names", [
    ({"temperature": 8}, "Environment: unknown keyword 'temperature'; did you mean 'temperature_c'"),
    ({"temperature_c": "cold"}, "temperature_c = \"cold\", must be a number"),
    ({"temperature_c": 1e9}, "temperature"),
    ({"height_m": 0}, "unknown keyword 'height_m'"),
    ({"path": "no-such.toml"}, "no-such.toml"),
])
def test_environments(keys, names):
    with pytest.raises(iy.Error, match=names):
        iy.Environment(**keys)


@pytest.mark.parametrize("keys,names", [
    ({"acuracy_db": 1}, "PingSimulator: unknown keyword 'acuracy_db'; did you mean 'accuracy_db'"),
    ({"accuracy_db": 0}, "^accuracy_db = 0, must be"),
    ({"detail_width": 9}, "^detail_width = 9, must be within 0 and 4"),
    ({"noise": 3}, "noise = 3, must be true or false"),
    ({"method": "best"}, "method = \"best\", must be one of"),
    ({"keep": "everything"}, "keep = .*must be"),
    ({"seed": -1}, "seed = -1"),
    ({"contributors": 300}, "contributors = 300"),
    ({"with_": "magic"}, "'magic' cannot be forced"),
    ({"with_": ["refraction"]}, "refraction cannot be forced in"),
    ({"multipath": True}, "surface"),
    ({"pose": "0,0,0,0,0,0"}, "unknown keyword 'pose'"),
])
def test_simulators(head, keys, names):
    with pytest.raises(iy.ArgumentError, match=names):
        iy.PingSimulator(head, **keys)


@pytest.mark.parametrize("keys,names", [
    ({"position": (0, 0)}, r"position is an array of int64 of shape \(2,\), must be finite numbers of shape \(3,\)"),
    ({"position": (0, 0, np.nan)}, "position: row 2 has nan"),
    ({"position": None}, "position"),
    ({"yaw": np.inf}, "yaw, pitch, roll: row 0 has inf"),
    ({"roll": np.nan}, "yaw, pitch, roll: row 2 has nan"),
    ({"time": np.nan}, "time = nan"),
    ({"ping": -2}, "ping = -2"),
    ({"number": 1}, "unknown keyword 'number'"),
    ({"seed": 1.5}, "seed = 1.5"),
    ({"velocity": 3}, "velocity"),
    ({"turn_rate": (0, 0, "x")}, "turn_rate"),
    ({"keep": "all"}, "keep"),
])
def test_pings(simulator, keys, names):
    with pytest.raises(iy.ArgumentError, match=names):
        simulator.ping(scene_of(), **{"position": (0, 0, 0), **keys})


@pytest.mark.parametrize("poses,names", [
    (np.zeros((3, 5)), r"poses .* must be finite numbers of shape \(n, 6\)"),
    (np.full((3, 6), np.nan), "poses: row 0 has nan"),
    (ragged, "poses is a"),
])
def test_batches(simulator, poses, names):
    with pytest.raises(iy.ArgumentError, match=names):
        simulator.pings(scene_of(), poses)
    with pytest.raises(iy.ArgumentError, match="threads = -1"):
        simulator.pings(scene_of(), np.zeros((1, 6)), threads=-1)


@pytest.mark.parametrize("call", [
    lambda head, sim: iy.PingSimulator("p900-45"), lambda head, sim: sim.ping("scene", (0, 0, 0)),
    lambda head, sim: iy.draw_fan(sim, "fan.png"), lambda head, sim: iy.sonar(3), lambda head, sim: sim.ping(),
    lambda head, sim: sim.ping(scene_of(), (0, 0, 0), pitch="down"), lambda head, sim: sim.ping(scene_of(), (0, 0, 0), None)])
def test_other_objects_are_type_errors(head, simulator, call):
    with pytest.raises(TypeError):
        call(head, simulator)


def test_files(simulator, tmp_path):
    ping = simulator.ping(scene_of(), (0, 0, 0))
    with pytest.raises(iy.Error, match="missing.ply"):
        iy.load_scene(tmp_path / "missing.ply")
    (tmp_path / "bad.ply").write_bytes(b"ply\nformat binary_little_endian 1.0\nelement vertex 9\n")
    with pytest.raises(iy.Error, match="bad.ply"):
        iy.load_scene(tmp_path / "bad.ply")
    with pytest.raises(iy.ArgumentError, match="did you mean 'unit'"):
        iy.load_scene(tmp_path / "bad.ply", units="mm")
    with pytest.raises(iy.Error, match="fan.jpg|png"):
        iy.draw_fan(ping, tmp_path / "no" / "fan.png")
    with pytest.raises(iy.ArgumentError, match="colour_map = .pink."):
        iy.draw_fan(ping, tmp_path / "fan.png", colour_map="pink")
    ping.save(tmp_path / "run", picture=False)
    with pytest.raises(iy.Error, match="run"):
        ping.save(tmp_path / "run", picture=False)
    ping.save(tmp_path / "run", force=True, picture=False)
    with pytest.raises(AttributeError):
        ping.pressure = 3
    with pytest.raises(ValueError):
        ping.pressure[0, 0] = 1


def test_the_meaning_of_a_file_takes_numbers(tmp_path):
    points = np.random.default_rng(7).uniform(0, 90, (300, 3)) * (1, 1, 0)
    np.savetxt(tmp_path / "bed.xyz", points)
    metres = iy.load_scene(tmp_path / "bed.xyz", viewpoint=(0, 0, 9)).points
    for unit in (0.1, "0.1"):
        np.testing.assert_allclose(iy.load_scene(tmp_path / "bed.xyz", unit=unit, viewpoint=(0, 0, 9)).points,
                                   0.1 * metres, atol=1e-6)
    for key, values in {"unit": (0, -1, [1, 2], "mile"), "band": (0, 1.5, [1, 2]), "nodata": ("x",),
                        "classes": (300, [2, 9.5], "x"), "z": (1, "left"), "up": ("x",)}.items():
        for value in values:
            with pytest.raises(iy.ArgumentError, match=key):
                iy.load_scene(tmp_path / "bed.xyz", **{key: value})
