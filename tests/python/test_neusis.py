# SPDX-License-Identifier: BSD-3-Clause
"""Exports for neural reconstruction, read as the loader of neusis reads them, against a small ball at a known place."""
from __future__ import annotations

import json
import pickle
from pathlib import Path

import insonify as iy
import numpy as np
import pytest

RADIUS, BALL = 0.01, np.array([6.0, 1.5, -2.0])

scene = f"""schema = 1
[[part]]
name = "ball"
file = "ball.ply"
position_m = {BALL.tolist()}
rest = "none"
"""

# From places beside the ball, at rest, so that it is seen in inner and outer beams, above and below the axis.
mission = """schema = 1
[survey]
scene = "scene.toml"
seed = 4
[[head]]
name = "fls"
sonar = "p900-45"
set = ["sonar.beams=129", "sonar.elevation_width_deg=28"]
range = "2:6"
[randomise.pose]
pings = 6
box_m = [[5.5, 4.5, -2.2], [6.5, 6, -1.4]]
yaw_deg = [-106, -74]
pitch_deg = [-5, 10]
roll_deg = [-10, 10]
clearance_m = 0
[ping]
display = 300
"""


def read(folder: Path) -> dict:
    """What the loader of neusis makes of a data set: its fields, apertures in radians."""
    sensors = json.loads((folder / "Config.json").read_text())["agents"][0]["sensors"]
    (sonar,) = [sensor["configuration"] for sensor in sensors if sensor["sensor_type"] == "ImagingSonar"]
    images, poses = [], []
    for path in sorted((folder / "Data").iterdir()):
        state = pickle.loads(path.read_bytes())
        image = state["ImagingSonar"]
        image[image < 0.2] = 0
        image[image.shape[0] - 200:, :] = 0
        images.append(image)
        poses.append(state["PoseSensor"])
    return {"images": images, "poses": poses, "hfov": np.radians(sonar["Azimuth"]), "vfov": np.radians(sonar["Elevation"]),
            "min_range": sonar["RangeMin"], "max_range": sonar["RangeMax"]}


def loudest(image: np.ndarray) -> tuple[float, float]:
    """The middle row, with the far edge of the last one, and the middle column of what is within 3 dB of white."""
    rows, columns = np.nonzero(image >= 0.7 * image.max())
    return float((rows.min() + rows.max() + 1) / 2), float((columns.min() + columns.max()) / 2)


@pytest.fixture(scope="module")
def folder(tmp_path_factory, tool) -> Path:
    path = tmp_path_factory.mktemp("neusis")
    tool("make-object", "sphere", "--set", f"diameter_m={2 * RADIUS}", "-o", "ball.ply", folder=path)
    (path / "scene.toml").write_text(scene)
    (path / "mission.toml").write_text(mission)
    tool("survey", "mission.toml", "-o", "survey", folder=path)
    tool("export", "survey", "--to", "neusis", "-o", "neusis", folder=path)
    return path


def test_the_ball_is_where_rows_and_columns_of_the_loader_have_it(folder):
    data = read(folder / "neusis")
    assert len(data["images"]) == 6
    columns_of_peaks = []
    for image, pose in zip(data["images"], data["poses"]):
        assert image.dtype == np.float32 and image.shape == (500, 128) and pose.dtype == np.float64
        row, column = loudest(image)
        columns_of_peaks.append(column)
        # As the method samples an image: range from the near edge of a row, azimuth of a column, any elevation.
        away = row * (data["max_range"] - data["min_range"]) / 500 + data["min_range"]
        azimuth = -data["hfov"] / 2 + column * data["hfov"] / 128
        x, y, z = pose[:3, :3].T @ (BALL - pose[:3, 3])
        cell = (6 - 2) / 300
        assert abs(np.sqrt(x * x + y * y + z * z) - RADIUS - away) < 2 * cell
        # A line array hears a cone: less than a tenth of a degree from the plane at these elevations.
        assert abs(azimuth - np.arctan2(y, x)) < np.radians(0.5)  # half the width of a beam
        elevation = np.arctan2(z, np.hypot(x, y))
        assert abs(elevation) < data["vfov"] / 2
        place = pose @ np.array([(away + RADIUS) * np.cos(azimuth) * np.cos(elevation),
                                 (away + RADIUS) * np.sin(azimuth) * np.cos(elevation),
                                 (away + RADIUS) * np.sin(elevation), 1])
        assert np.linalg.norm(place[:3] - BALL) < 2 * cell + np.radians(0.5) * away
        assert 0.2 < image.max() <= 1
    assert np.ptp(columns_of_peaks) > 32  # the ball is seen in beams a quarter of the fan apart


def test_amplitudes_are_those_of_the_pings(folder):
    """A column has the beam of its azimuth, a row the cell of its range."""
    state = pickle.loads((folder / "neusis" / "Data" / "000002.pkl").read_bytes())
    manifest = json.loads((folder / "neusis" / "manifest.json").read_text())
    head = iy.sonar("p900-45", beams=129, elevation_width_deg=28, min_range=2, max_range=6)
    image = state["ImagingSonar"]
    simulator = iy.PingSimulator(head, display=300)
    pose = state["PoseSensor"]
    yaw, pitch = np.degrees(np.arctan2(pose[1, 0], pose[0, 0])), np.degrees(np.arcsin(-pose[2, 0]))
    roll = np.degrees(np.arctan2(pose[2, 1], pose[2, 2]))
    ping = simulator.ping(iy.load_scene(folder / "scene.toml", seed=4), pose[:3, 3], yaw, pitch, roll, ping=2, time=2, seed=4)
    assert np.allclose(ping.world_from_head, pose, atol=1e-9)
    level = ping.level_db()[np.argsort(ping.azimuth)][:-1].T + 40 * np.log10(ping.range)[:, None]
    loud = (image[:300] > 0.05) & (image[:300] < 1)
    assert loud.sum() > 20
    difference = 20 * np.log10(image[:300][loud]) + manifest["white_db"] - level[loud]
    # What is left is absorption, alike in all beams and small at these ranges.
    assert np.ptp(difference) < 0.6 and 0 < difference.mean() < 3


def test_the_scene_lies_beside_it(folder, tool):
    truth = iy.load_scene(folder / "neusis" / "truth.ply")
    assert len(truth) > 100
    tool("ping", "neusis/truth.ply", "--sonar", "p900-45", "--pose=3,1.5,-2,0,0,0", "--range", "2:4", "--no-picture",
         "-o", "seen", folder=folder)
    tool("export", "seen", "--to", "neusis", "-o", "alone", folder=folder)
    data = read(folder / "alone")
    row, column = loudest(data["images"][0])
    away = 2 + row * (data["max_range"] - 2) / data["images"][0].shape[0]
    assert abs(away - (3 - RADIUS)) < 0.0254 and abs(column - data["images"][0].shape[1] / 2) <= 2


def test_fans_that_the_layout_cannot_hold_are_refused(folder, tool):
    from subprocess import CalledProcessError
    tool("ping", "scene.toml", "--sonar", "echoscope", "--pose=3,1.5,-2,0,0,0", "--range", "2:4", "--no-picture",
         "--display", "30", "-o", "rows", folder=folder)
    with pytest.raises(CalledProcessError):
        tool("export", "rows", "--to", "neusis", "-o", "none", folder=folder)
    assert not (folder / "none").exists()
