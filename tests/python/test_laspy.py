# SPDX-License-Identifier: BSD-3-Clause
"""LAS and LAZ by laspy, an independent writer and reader: its points and fields are those of tool and module, bit for bit."""
from __future__ import annotations

import json
import os
import re
import subprocess
from pathlib import Path

import insonify as iy
import numpy as np
import pytest

laspy = pytest.importorskip("laspy", reason="python3-laspy is not installed (Debian 12 has none): apps/install_packages.sh --tests")

points = 400
formats = [("1.2", f) for f in range(4)] + [("1.3", 4), ("1.3", 5)] + [("1.4", f) for f in range(6, 11)]
plain_fields = ("intensity", "classification", "gps_time", "red", "green", "blue")
numpy_types = {"char": "i1", "uchar": "u1", "short": "<i2", "ushort": "<u2", "int": "<u4", "float": "<f4", "double": "<f8"}


def insonify(*arguments) -> str:
    return subprocess.run([os.environ["INSONIFY_TOOL"], *map(str, arguments)], check=True, capture_output=True, text=True).stdout


@pytest.fixture(scope="session")
def needs_laz():
    """Skips what needs LAZ, where insonify or laspy do without LASzip."""
    if not re.search("LASzip [0-9]", insonify("--version", "--verbose")):
        pytest.skip("insonify was built without LASzip: Debian 12 has none")
    if not laspy.LazBackend.detect_available():
        pytest.skip("laspy has no backend: python3-laszip is not installed")


def write_las(path, version, point_format) -> None:
    """Writes a rough plate whose fields have values all over their types."""
    draw = np.random.default_rng(point_format)
    header = laspy.LasHeader(version=version, point_format=point_format)
    header.scales, header.offsets = (0.001, 0.002, 0.0005), (500000.5, 5400000, -20.25)
    header.add_extra_dims([laspy.ExtraBytesParams("range_m", "u2", scales=np.array([0.01]), offsets=np.array([-3.0])),
                           laspy.ExtraBytesParams("quality", "f4")])
    las, i = laspy.LasData(header), np.arange(points)
    las.x, las.y = 500123.25 + 0.1 * (i % 20), 5403061.5 + 0.1 * (i // 20)
    las.z = -7.125 + 0.05 * draw.random(points)
    las.range_m, las.quality = 650 * draw.random(points), draw.normal(size=points)
    las.synthetic, las.key_point, las.withheld = i % 2, i % 3 == 0, i % 7 == 0
    las.classification = draw.choice([0, 1, 2, 3, 31] + ([40, 255] if point_format >= 6 else []), points)
    for name in {"intensity", "user_data", "point_source_id", "red", "green", "blue", "nir"} & set(las.point_format.dimension_names):
        las[name] = draw.integers(0, np.iinfo(las[name].dtype).max, points, endpoint=True)
    if "gps_time" in las.point_format.dimension_names:
        las.gps_time = 3e8 * draw.random(points)
    las.write(path)


def read_ply(path):
    """Returns rows and origin of a binary PLY."""
    header, rows = path.read_bytes().split(b"end_header\n", 1)
    header = header.decode()
    origin = [float(number) for number in re.search("^comment .*origin (.*)$", header, re.MULTILINE)[1].split()]
    columns = re.findall("^property (?!list)(.*) (.*)$", header, re.MULTILINE)
    count = int(re.search("element vertex ([0-9]+)", header)[1])
    return np.frombuffer(rows, [(name, numpy_types[kind]) for kind, name in columns], count), np.array(origin)


def prepare(path, out) -> None:
    insonify("prepare", path, "-o", out, "--classes", "all", "--scan-noise", "0", "-q")


def expect_points_of(las, path, out) -> None:
    """Compares what laspy read with what the tool, which writes `out`, and the module read."""
    kept = np.flatnonzero(np.asarray(las.withheld) == 0)
    described = json.loads(insonify("info", path, "--json", "--classes", "all"))
    assert described["points"] == len(las.points), described
    prepare(path, out)
    rows, origin = read_ply(out)
    assert np.array_equal(rows["id"], kept)
    # Scenes hold float32 from their origin.
    laspy_xyz = np.stack([las.x, las.y, las.z], 1)[kept]
    xyz = origin + (laspy_xyz - origin).astype(np.float32).astype(np.float64)
    assert np.stack([rows[axis] for axis in "xyz"], 1).tobytes() == xyz.tobytes()
    names = [name for name in plain_fields if name in las.point_format.dimension_names]
    for name in names + [name for name in las.point_format.extra_dimension_names]:
        theirs = np.asarray(las[name])[kept]
        assert rows[name].tobytes() == theirs.astype(rows[name].dtype).tobytes(), name
        assert np.array_equal(rows[name], theirs), name
    scene = iy.load_scene(path, classes="all", scan_noise=0)
    assert scene.points.tobytes() == xyz.tobytes()
    assert [scene.material_names[m] for m in scene.materials] == [f"label {c}" for c in np.asarray(las.classification)[kept]]


@pytest.mark.parametrize("version, point_format", formats)
def test_las_holds_the_points_and_fields_that_laspy_reads(version, point_format, tmp_path):
    write_las(tmp_path / "scan.las", version, point_format)
    expect_points_of(laspy.read(tmp_path / "scan.las"), tmp_path / "scan.las", tmp_path / "las.ply")


@pytest.mark.parametrize("version, point_format", formats)
def test_laz_holds_the_points_and_fields_that_laspy_reads(version, point_format, tmp_path, needs_laz):
    for kind in ("las", "laz"):
        write_las(tmp_path / f"scan.{kind}", version, point_format)
    packed = laspy.read(tmp_path / "scan.laz")
    assert packed.header.are_points_compressed
    expect_points_of(packed, tmp_path / "scan.laz", tmp_path / "laz.ply")
    prepare(tmp_path / "scan.las", tmp_path / "las.ply")
    assert (tmp_path / "laz.ply").read_bytes() == (tmp_path / "las.ply").read_bytes()


def test_copc_holds_the_points_and_fields_that_laspy_reads(tmp_path, needs_laz):
    path = Path(__file__).parents[1] / "data/laz/octree.copc.laz"
    expect_points_of(laspy.read(path), path, tmp_path / "copc.ply")
