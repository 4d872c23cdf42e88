# SPDX-License-Identifier: BSD-3-Clause
"""Labels of data sets against an independent projector of meshes of known pose (label_projector.py)."""
from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parent))
from label_projector import Referee, make_set  # noqa: E402


@pytest.fixture(scope="module")
def strewn(tmp_path_factory) -> Path:
    """30 images of a reef strewn with bodies; label_projector.py makes any number of them."""
    folder = tmp_path_factory.mktemp("strewn")
    make_set(os.environ["INSONIFY_TOOL"], folder, 30, keep="contributors")
    return folder


def no_label_is_wrong(folder: Path, seen: float = 1) -> None:
    """seen: how many bodies are in view, over those of the head that passes the bed."""
    found = Referee(folder).run()
    assert found.wrong == {}, found.first
    assert found.counted["images"] == 30
    for form in ("polar", "fan"):  # it had enough to judge
        assert found.counted[f"boxes in {form} images"] > 40 * seen
        assert found.counted[f"sure objects in {form} images"] > 15 * seen
        assert found.counted[f"whole boxes in {form} images"] > 20 * seen
        assert found.counted[f"loud objects in {form} images"] > 20 * seen


def test_an_independent_projector_finds_no_wrong_label(strewn):
    no_label_is_wrong(strewn)


def test_nor_does_it_in_display_cells_from_random_poses(tmp_path):
    make_set(os.environ["INSONIFY_TOOL"], tmp_path, 30, keep="labels", random=True)
    no_label_is_wrong(tmp_path, seen=0.5)
    poses = np.array([json.loads(line)["world_from_head"]
                      for line in (tmp_path / "set" / "meta.jsonl").read_text().splitlines()])
    assert np.ptp(poses[:, :3, 3], axis=0).min() > 1  # anywhere in their box
    assert np.ptp(np.degrees(np.arctan2(poses[:, 1, 0], poses[:, 0, 0]))) > 30


def test_the_projector_finds_what_is_wrong(strewn):
    """Labels that are put wrong by hand are all found, each for its own reason."""
    path = strewn / "set" / "fan" / "annotations" / "instances_train.json"
    right = path.read_text()
    wrong = json.loads(right)
    post = next(a for a in wrong["annotations"] if a["part"] == "post")  # convex, and within the fan
    a, b, c, d = [a for a in wrong["annotations"] if a["part"] != "post"][:4]
    post["bbox_whole"][0] -= 9
    a["category_id"] = next(k["id"] for k in wrong["categories"] if k["id"] != a["category_id"])
    b["instance"] += 1
    c["bbox"][0] += 1
    runs = d["segmentation"]["counts"]
    runs[0], runs[-1] = runs[0] + 40, runs[-1] - 40
    try:
        path.write_text(json.dumps(wrong))
        found = Referee(strewn).run().wrong
    finally:
        path.write_text(right)
    assert found["whole box off"] == 1 and found["wrong class of a box"] == 1 and found["changed id"] == 1
    assert found["box beside its mask"] == 2 and found["mask of other pixels"] == 2  # of c and d, of b and d


ball_scene = """schema = 1
[[part]]
file = "bed.ply"
[[part]]
name = "ball"
file = "ball.ply"
position_m = [4, 0, 0]
rest = "none"
"""

ball_mission = """schema = 1
[survey]
scene = "scene.toml"
[trajectory]
waypoints_m = [[-10.7, -2, 1.5], [-11, 2, 1.5]]
speed_m_s = 0.349
[[head]]
name = "fls"
sonar = "oculus-m750d"
range = "13:17"
pitch_deg = -6
heading_deg = 94.29
rate_hz = 1
[ping]
keep = ["contributors"]
"""


def test_a_ball_of_6_cm_at_15_m_is_in_every_fan_image(tool, tmp_path):
    """A pixel is some 35 bins long: one sample of each showed the ball in some images alone."""
    tool("make-object", "sphere", "--set", "diameter_m=0.06", "-o", "ball.ply", folder=tmp_path)
    tool("make-scene", "plane", "--size", "8,8", "--points", "6000", "-o", "bed.ply", folder=tmp_path)
    (tmp_path / "scene.toml").write_text(ball_scene)
    (tmp_path / "mission.toml").write_text(ball_mission)
    tool("survey", "mission.toml", "-o", "survey", folder=tmp_path)
    tool("dataset", "survey", "-o", "set", "--split", "100:0:0", folder=tmp_path)
    for form in ("fan", "polar"):
        coco = json.loads((tmp_path / "set" / form / "annotations" / "instances_train.json").read_text())
        seen = {a["image_id"] for a in coco["annotations"] if a.get("part") == "ball"}
        assert len(coco["images"]) == 12 and len(seen) == 12
    whole = [json.loads(line)["objects"][0] for line in (tmp_path / "set" / "meta.jsonl").read_text().splitlines()]
    assert np.allclose([o["size_m"] for o in whole], 0.06, atol=0.003)


shared_mission = """schema = 1
[survey]
scene = "reef.ply"
seed = 3
[[head]]
name = "fls"
sonar = "p900-45"
set = ["sonar.beams=32"]
range = "2:8"
[randomise.pose]
pings = 6
box_m = [[-1, -2, -2.6], [5, 2, -1]]
yaw_deg = [-40, 40]
pitch_deg = [10, 30]
[ping]
keep = ["labels"]
"""


def test_random_poses_are_those_of_all_shards_and_threads(tool, tmp_path):
    tool("make-scene", "reef", "--points", "10000", "-o", "reef.ply", folder=tmp_path)
    (tmp_path / "mission.toml").write_text(shared_mission)
    tool("survey", "mission.toml", "-o", "whole", "-j", "1", folder=tmp_path)
    for shard in ("1/2", "0/2"):
        tool("survey", "mission.toml", "-o", "parts", "--shard", shard, "--pings-per-block", "2", "-j", "2", folder=tmp_path)
    poses, images = [], []
    for name in ("whole", "parts"):
        tool("dataset", name, "-o", f"{name}-set", "--split", "100:0:0", folder=tmp_path)
        lines = (tmp_path / f"{name}-set" / "meta.jsonl").read_text().splitlines()
        poses.append([json.loads(line)["world_from_head"] for line in lines])
        images.append([path.read_bytes() for path in sorted((tmp_path / f"{name}-set/polar/images").iterdir())])
    assert len(poses[0]) == 6 and poses[0] == poses[1] and images[0] == images[1]
    assert len({str(pose) for pose in poses[0]}) == 6
