# SPDX-License-Identifier: BSD-3-Clause
"""A shape from images: space carving by views from all around a body, with its error against the true mesh.

    PYTHONPATH=build/release/python python3 apps/07_reconstruction.py [PICTURE.png]
    PYTHONPATH=build/release/python python3 apps/07_reconstruction.py PICTURE.png EXPORT

The first line makes the views itself. The second one reads images, poses and true mesh of `insonify export --to neusis`.
The picture has the true body on the left, from above and from the side, and what was carved on the right.
"""
from __future__ import annotations

import json
import pickle
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import insonify as iy
import numpy as np
from grey_png import save_grey
from numpy.typing import NDArray

Numbers = NDArray[np.float64]
VOXEL = 0.025      # [m]
FAINTEST_DB = 30   # below the brightest sample, as loud as what is taken for an echo


@dataclass
class Shot:
    """An image of range x azimuth with the pose of its head; ranges [m] and azimuths [rad] are those of its samples."""

    echo: NDArray[np.bool_]  # nearest range first
    azimuth: Numbers         # ascending
    least_range: float
    cell: float
    aperture: float          # in elevation [rad]
    pose: Numbers            # world_from_head


@dataclass
class Mesh:
    points: Numbers
    faces: NDArray[np.int64]

    def sampled(self, count: int) -> Numbers:
        """Points at random on the surface, as dense everywhere."""
        corner = self.points[self.faces]
        area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
        draw = np.random.default_rng(1)
        face = corner[draw.choice(len(area), count, p=area / area.sum())]
        u = draw.random((count, 2))
        u = np.where(u.sum(1, keepdims=True) > 1, 1 - u, u)
        on: Numbers = face[:, 0] + u[:, :1] * (face[:, 1] - face[:, 0]) + u[:, 1:] * (face[:, 2] - face[:, 0])
        return on

    def save(self, path: Path) -> None:
        corners = np.zeros(len(self.faces), [("count", "u1"), ("corner", "<i4", 3)])
        corners["count"], corners["corner"] = 3, self.faces
        head = "ply\nformat binary_little_endian 1.0\n" + f"element vertex {len(self.points)}\n"
        head += "".join(f"property double {axis}\n" for axis in "xyz")
        head += f"element face {len(corners)}\nproperty list uchar int vertex_indices\nend_header\n"
        path.write_bytes(head.encode() + self.points.astype("<f8").tobytes() + corners.tobytes())

    @staticmethod
    def load(path: Path) -> Mesh:
        """A binary PLY of triangles, as this file and insonify write it."""
        head, data = path.read_bytes().split(b"end_header\n", 1)
        kinds = {"double": "<f8", "float": "<f4", "int": "<i4", "uint": "<u4", "uchar": "u1"}
        lines = [line.split() for line in head.decode().splitlines()]
        count = {words[1]: int(words[2]) for words in lines if words[0] == "element"}
        vertex = np.dtype([(words[2], kinds[words[1]]) for words in lines if words[0] == "property" and len(words) == 3])
        points = np.frombuffer(data, vertex, count["vertex"])
        faces = np.frombuffer(data, [("count", "u1"), ("corner", "<i4", 3)], count["face"], vertex.itemsize * len(points))
        return Mesh(np.stack([points[axis] for axis in "xyz"], 1).astype(float), faces["corner"].astype(np.int64))


def ellipsoid(middle: tuple[float, float, float], radii: tuple[float, float, float], rings: int = 40) -> Mesh:
    down, around = np.linspace(0, np.pi, rings + 1), np.arange(2 * rings) * np.pi / rings
    unit = np.stack([np.outer(np.sin(down), np.cos(around)), np.outer(np.sin(down), np.sin(around)),
                     np.outer(np.cos(down), np.ones(2 * rings))], -1).reshape(-1, 3)
    i, j = (grid.ravel() for grid in np.meshgrid(np.arange(rings), np.arange(2 * rings), indexing="ij"))
    a, b = i * 2 * rings + j, i * 2 * rings + (j + 1) % (2 * rings)
    faces = np.concatenate([np.stack([a, a + 2 * rings, b], 1)[i > 0],
                            np.stack([b, a + 2 * rings, b + 2 * rings], 1)[i < rings - 1]])
    return Mesh(unit * radii + np.array(middle), faces)


def body() -> Mesh:
    """A hull with a tower and a fin."""
    parts = [ellipsoid((0, 0, 0), (1, 0.28, 0.28)), ellipsoid((0.1, 0, 0.35), (0.25, 0.12, 0.25)),
             ellipsoid((-0.85, 0, 0), (0.12, 0.5, 0.08))]
    before = np.cumsum([0] + [len(part.points) for part in parts])
    return Mesh(np.concatenate([part.points for part in parts]),
                np.concatenate([part.faces + first for part, first in zip(parts, before)]))


def poses_around(count: int, away: float) -> Numbers:
    """Heads on a sphere about the origin, evenly spread, that look at it, every other one on its side."""
    k = np.arange(count)
    z, turn = 1 - 2 * (k + 0.5) / count, 2.399963 * k
    place = away * np.stack([np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z], 1)
    yaw, pitch = np.arctan2(-place[:, 1], -place[:, 0]), np.arcsin(z)
    return np.column_stack([place, np.degrees(yaw), np.degrees(pitch), np.where(k % 2, 90, 0)])


def made_views() -> tuple[list[Shot], Mesh]:
    """Images of the body, as a device shows them in 8 bits."""
    mesh = body()
    with tempfile.TemporaryDirectory() as folder:
        mesh.save(Path(folder) / "body.ply")
        scene = iy.load_scene(Path(folder) / "body.ply")
    least, most, cells, aperture = 2.0, 6.0, 200, 20.0
    head = iy.sonar("p900-45", beams=96, min_range=least, max_range=most, elevation_width_deg=aperture)
    simulator = iy.PingSimulator(head, iy.Environment(temperature_c=8), accuracy_db=0.5, noise=True)
    views = list(simulator.views(scene, poses_around(120, 4.0), height=cells, geometry="polar", labels=False,
                                 window=(130, 190)))
    faintest = max(int(view.image.max()) for view in views) - FAINTEST_DB * 255 / 60
    return [Shot(view.image[::-1, ::-1] >= faintest, np.sort(view.ping.azimuth), least, (most - least) / cells,
                 np.radians(aperture), view.ping.world_from_head) for view in views], mesh


def exported_views(folder: Path) -> tuple[list[Shot], Mesh]:
    """The images of an export, whose amplitudes are 1 at most."""
    sensor: dict[str, Any] = json.loads((folder / "Config.json").read_text())["agents"][0]["sensors"][0]["configuration"]
    shots = []
    for path in sorted((folder / "Data").glob("*.pkl")):
        with path.open("rb") as file:
            state = pickle.load(file)
        image, wide = state["ImagingSonar"], np.radians(sensor["Azimuth"])
        rows, columns = image.shape
        shots.append(Shot(image > 10 ** (-FAINTEST_DB / 20), -wide / 2 + np.arange(columns) * wide / columns,
                          sensor["RangeMin"], (sensor["RangeMax"] - sensor["RangeMin"]) / rows,
                          np.radians(sensor["Elevation"]), state["PoseSensor"]))
    return shots, Mesh.load(folder / "truth.ply")


def carved(shots: list[Shot], voxels: Numbers) -> NDArray[np.bool_]:
    """What is left of the voxels (n, 3). Within its aperture, a beam has nothing before its first echo."""
    left = np.ones(len(voxels), bool)
    for shot in shots:
        place = (voxels - shot.pose[:3, 3]) @ shot.pose[:3, :3]
        away = np.linalg.norm(place, axis=1)
        azimuth, elevation = np.arcsin(place[:, 1] / away), np.arcsin(place[:, 2] / away)
        beam = np.rint(np.interp(azimuth, shot.azimuth, np.arange(len(shot.azimuth)))).astype(int)
        heard = (np.abs(elevation) < shot.aperture / 2) & (azimuth > shot.azimuth[0]) & (azimuth < shot.azimuth[-1])
        first = np.where(shot.echo.any(0), shot.echo.argmax(0), len(shot.echo))
        left &= ~(heard & (away < shot.least_range + shot.cell * first[beam]))
    return left


def distances(of: Numbers, to: Numbers) -> Numbers:
    """From each point the distance to the nearest of the others [m]."""
    return np.concatenate([np.sqrt(((part[:, None] - to[None]) ** 2).sum(-1).min(1))
                           for part in np.array_split(of, len(of) // 500 + 1)])


def main(picture: str | None, export: str | None) -> None:
    shots, mesh = exported_views(Path(export)) if export else made_views()
    low, high = mesh.points.min(0) - 0.2, mesh.points.max(0) + 0.2
    axes = [np.arange(a, b, VOXEL) for a, b in zip(low, high)]
    shape = tuple(len(axis) for axis in axes)
    voxels = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    solid = np.pad(carved(shots, voxels).reshape(shape), 1)
    inner = solid.copy()
    for axis in range(3):
        inner &= np.roll(solid, 1, axis) & np.roll(solid, -1, axis)
    solid, skin = solid[1:-1, 1:-1, 1:-1], (solid & ~inner)[1:-1, 1:-1, 1:-1]
    surface, truth = voxels[skin.ravel()], mesh.sampled(4000)
    wrong, missing = distances(surface, truth), distances(truth, surface)
    print(f"{len(shots)} views, {solid.sum() * VOXEL ** 3:.3f} m3 left of {voxels.shape[0] * VOXEL ** 3:.1f} m3; surface "
          f"off by {1000 * wrong.mean():.0f} mm, true surface missed by {1000 * missing.mean():.0f} mm in the mean, "
          f"nine tenths by {1000 * np.quantile(missing, 0.9):.0f} mm")
    if picture is None:
        return
    true = np.zeros(shape, bool)
    true[tuple(np.clip(np.rint((mesh.sampled(100000) - low) / VOXEL).astype(int), 0, np.array(shape) - 1).T)] = True
    sides = []
    for marks in (true, skin):
        drawn = [np.flipud(marks.sum(axis).T) for axis in (2, 1)]
        sides.append(np.concatenate([255 * np.sqrt(np.minimum(image / 6, 1)) for image in drawn]))
    save_grey(picture, np.kron(np.concatenate(sides, axis=1), np.ones((4, 4))))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else None, sys.argv[2] if len(sys.argv) > 2 else None)
