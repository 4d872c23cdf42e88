# SPDX-License-Identifier: BSD-3-Clause
"""An independent referee of the labels of data sets: it projects meshes of known pose into images, by its own code.

    python3 tests/python/label_projector.py TOOL FOLDER [--images 300] [--bed CLOUD]

makes a survey over a bed strewn with bodies, makes a data set of it, and counts what is wrong in the labels.
"""
from __future__ import annotations

import argparse
import json
import re
import struct
import subprocess
import zlib
from collections import Counter
from pathlib import Path

import numpy as np

BODIES = {"drum": "drum", "tyre": "tyre", "ball": "sphere", "mine": "cone-mine", "wedge": "wedge-mine"}
CONVEX = ("ball", "mine", "wedge", "post")  # what faces the head is what the head sees of them alone

SCENE = """schema = 1
[[part]]
file = "bed.ply"
[[part]]
name = "post"
file = "wedge.ply"
position_m = {post}
rest = "none"
yaw_deg = 30
pitch_deg = 10
scale = 0.8
[[scatter]]
files = ["drum.ply", "tyre.ply", "ball.ply", "mine.ply", "wedge.ply"]
count = [2, 4]
area_m = {area}
yaw_deg = 180
tilt_deg = 10
scale = [0.7, 1.2]
"""

MISSION = """schema = 1
[survey]
scene = "scene.toml"
seed = 11
[trajectory]
waypoints_m = [{first}, {last}]
speed_m_s = {speed}
[[head]]
name = "fls"
sonar = "p900-45"
set = ["sonar.beams=128"]
range = "2:11"
pitch_deg = -20
rate_hz = 1
[randomise]
scene = "ping"
[ping]
keep = ["{keep}"]
"""


# Where the head is, in place of the trajectory: at random beside the bed and over it, looking along it and down.
AT_RANDOM = """[randomise.pose]
pings = {images}
box_m = [{low}, {high}]
yaw_deg = [-20, 20]
pitch_deg = [10, 30]
roll_deg = [-5, 5]
clearance_m = 0.6
[ping]
"""


class Surface:
    """Places of a surface with normals, areas and scattering coefficients; of a mesh points a step apart."""

    def __init__(self, path: Path, step: float = 0.02) -> None:
        raw = path.read_bytes()
        head, data = raw.split(b"end_header\n", 1)
        lines = head.decode().splitlines()
        mu = {int(w[3]): float(w[4]) for w in map(str.split, lines) if w[:3] == ["comment", "insonify", "material"]}
        self.names = {w[5] for w in map(str.split, lines) if w[:3] == ["comment", "insonify", "material"]}
        kinds = {"double": "<f8", "float": "<f4", "int": "<i4", "uchar": "u1"}
        count = {w[1]: int(w[2]) for w in map(str.split, lines) if w[0] == "element"}
        vertex = np.dtype([(w[2], kinds[w[1]]) for w in map(str.split, lines) if w[0] == "property" and len(w) == 3])
        points = np.frombuffer(data, vertex, count["vertex"])
        place = np.stack([points[k] for k in "xyz"], 1).astype(float)
        coefficient = np.array([mu[k] for k in range(len(mu))])[points["material"]]
        if "area" in vertex.names:
            self.place, self.area, self.mu = place, points["area"].astype(float), coefficient
            self.normal = np.stack([points[k] for k in ("nx", "ny", "nz")], 1).astype(float)
            return
        faces = np.frombuffer(data, [("n", "u1"), ("corner", "<i4", 3)], count["face"], vertex.itemsize * len(points))
        normal = np.stack([points[k] for k in ("nx", "ny", "nz")], 1).astype(float)
        corner = faces["corner"]
        self._sample(place[corner], normal[corner], coefficient[corner[:, 0]], step)

    def _sample(self, corner: np.ndarray, turned: np.ndarray, coefficient: np.ndarray, step: float) -> None:
        cross = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        double = np.linalg.norm(cross, axis=1)
        longest = np.linalg.norm(corner - np.roll(corner, 1, axis=1), axis=2).max(1)
        parts = np.clip(np.ceil(longest / step), 1, 200).astype(int)
        place, normal, area, mu = [], [], [], []
        # Middles of small triangles stand for the surface; their corners, which have no area, bound it.
        for n in np.unique(parts):
            some = np.flatnonzero((parts == n) & (double > 0))
            weights = [((i + k / 3) / n, (j + k / 3) / n) for i in range(n) for j in range(n - i) for k in (1, 2)
                       if k == 1 or i + j + 1 < n]
            middles = len(weights)
            weights += [(i / n, j / n) for i in range(n + 1) for j in range(n + 1 - i)]
            a, b = np.array(weights).T
            of = corner[some, None]
            place.append((of[:, :, 0] + a[:, None] * (of[:, :, 1] - of[:, :, 0])
                          + b[:, None] * (of[:, :, 2] - of[:, :, 0])).reshape(-1, 3))
            # A face of a round body faces the head as the body does: its corners have the body's normals.
            bent = np.einsum("wc,fcx->fwx", np.stack([1 - a - b, a, b], 1), turned[some]).reshape(-1, 3)
            normal.append(bent / np.linalg.norm(bent, axis=1)[:, None])
            area.append(np.outer(double[some] / 2 / n**2, np.arange(len(weights)) < middles).ravel())
            mu.append(np.repeat(coefficient[some], len(weights)))
        self.place, self.normal = np.concatenate(place), np.concatenate(normal)
        self.area, self.mu = np.concatenate(area), np.concatenate(mu)


class Seen:
    """A surface that is ahead, in head axes: range, azimuth of its beam, elevation, cosine of incidence."""

    def __init__(self, of: Surface, head_from_own: np.ndarray, scale: float = 1) -> None:
        place = scale * of.place @ head_from_own[:3, :3].T + head_from_own[:3, 3]
        normal = of.normal @ head_from_own[:3, :3].T
        self.range = np.linalg.norm(place, axis=1)
        # The azimuth of the beam is an angle of cones, which a line array hears about its axis.
        self.azimuth = np.arcsin(place[:, 1] / self.range)
        self.elevation = np.arcsin(place[:, 2] / self.range)
        self.cosine = -(normal * place).sum(1) / self.range
        self.energy = np.where(self.cosine > 0, of.mu * self.cosine**2 * of.area * scale**2 / self.range**4, 0)

    def cell(self, step: float) -> tuple[np.ndarray, np.ndarray]:
        return np.floor(self.azimuth / step).astype(int), np.floor(self.elevation / step).astype(int)


class Form:
    """Pixels of one form of an image: where ranges and azimuths are, and how far a sample reaches."""

    def __init__(self, name: str, meta: dict, mapping: dict, shape: tuple[int, int]) -> None:
        self.name, self.meta, self.mapping, self.shape = name, meta, mapping, shape
        self.beam_width = np.radians(meta["beam_width_deg"])
        self.azimuth = np.radians(meta["azimuths_deg"])
        self.from_port = np.argsort(-self.azimuth, kind="stable")
        self.cell = mapping["metres_per_pixel"] if name == "fan" else meta["bin_size_m"]

    def pixel(self, ranges: np.ndarray, azimuth: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Rows and columns, with fractions."""
        if self.name == "fan":
            metres = self.mapping["metres_per_pixel"]
            return (self.mapping["head_row"] - ranges * np.cos(azimuth) / metres,
                    self.mapping["head_column"] - ranges * np.sin(azimuth) / metres)
        ascending = -self.azimuth[self.from_port]
        columns = np.interp(-azimuth, ascending, np.arange(len(ascending)) + 0.5)
        return self.shape[0] - (ranges - self.meta["min_range_m"]) / self.meta["bin_size_m"], columns

    def reach(self, seen: Seen, which: np.ndarray) -> tuple[int, int]:
        """A cell plus the width of a beam, in rows and columns, at some places."""
        if self.name == "fan":
            ranges, azimuth = seen.range[which], np.abs(seen.azimuth[which])
            cell, beam = self.meta["bin_size_m"], self.beam_width * ranges.max()
            across, along = np.cos(azimuth).max(), np.sin(azimuth).max()
            metres = self.mapping["metres_per_pixel"]
            return (int(np.ceil(1 + (cell * across + beam * along) / metres)),
                    int(np.ceil(1 + (cell * along + beam * across) / metres)))
        spacing = np.ptp(self.azimuth) / (len(self.azimuth) - 1)
        return 2, int(np.ceil(1 + self.beam_width / spacing))

    def inside(self, seen: Seen, margin: float = 0) -> np.ndarray:
        half = np.abs(self.azimuth).max() - margin
        return ((np.abs(seen.azimuth) < half) & (seen.range > self.meta["min_range_m"] + margin)
                & (seen.range < self.meta["max_range_m"] - margin))

    def pixels_inside(self) -> np.ndarray:
        """Where the middle of a pixel is within ranges and beams."""
        if self.name == "polar":
            return np.ones(self.shape, bool)
        metres, (rows, columns) = self.mapping["metres_per_pixel"], self.shape
        ahead = (self.mapping["head_row"] - np.arange(rows)[:, None] - 0.5) * metres
        aside = (self.mapping["head_column"] - np.arange(columns)[None] - 0.5) * metres
        away = np.hypot(ahead, aside)
        return ((np.abs(np.arctan2(aside, ahead)) <= np.abs(self.azimuth).max()) & (away >= self.meta["min_range_m"])
                & (away <= self.meta["max_range_m"]))

    def marks(self, seen: Seen, which: np.ndarray) -> np.ndarray:
        row, column = (np.floor(x[which]).astype(int) for x in self.pixel(seen.range, seen.azimuth))
        marks = np.zeros(self.shape, bool)
        marks[np.clip(row, 0, self.shape[0] - 1), np.clip(column, 0, self.shape[1] - 1)] = True
        return marks


def summed(values: np.ndarray, rows: int, columns: int) -> np.ndarray:
    """Sums over all pixels within so many rows and columns."""
    for axis, reach in ((0, rows), (1, columns)):
        pad = [(0, 0), (0, 0)]
        pad[axis] = (reach + 1, reach)
        sums = np.cumsum(np.pad(values, pad), axis)
        n = values.shape[axis]
        values = np.take(sums, np.arange(2 * reach + 1, n + 2 * reach + 1), axis) - np.take(sums, np.arange(n), axis)
    return values


def widened(marks: np.ndarray, rows: int, columns: int) -> np.ndarray:
    """The marks and all pixels within so many rows and columns of one."""
    return summed(marks.astype(int), rows, columns) > 0


def read_png(path: Path) -> np.ndarray:
    """Grey values of 8 or 16 bits."""
    raw, at, packed = path.read_bytes(), 8, b""
    while at < len(raw):
        size, kind = struct.unpack(">I4s", raw[at:at + 8])
        body = raw[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", body[:10])
            assert colour == 0 and bits in (8, 16)
        packed += body if kind == b"IDAT" else b""
        at += size + 12
    step, unpacked = bits // 8, zlib.decompress(packed)
    length = width * step
    image = np.zeros((height + 1, (width + 1) * step), np.uint8)
    above = bytearray(length + step)
    for r in range(height):
        kind, line = unpacked[r * (length + 1)], unpacked[r * (length + 1) + 1:(r + 1) * (length + 1)]
        now = bytearray(step) + line
        if kind == 1:
            for c in range(step, len(now)):
                now[c] = (now[c] + now[c - step]) & 255
        elif kind == 2:
            now[step:] = (np.frombuffer(line, np.uint8) + np.frombuffer(bytes(above[step:]), np.uint8)).tobytes()
        elif kind == 3:
            for c in range(step, len(now)):
                now[c] = (now[c] + (now[c - step] + above[c]) // 2) & 255
        elif kind == 4:
            for c in range(step, len(now)):
                left, up, corner = now[c - step], above[c], above[c - step]
                a, b, d = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
                now[c] = (now[c] + (left if a <= b and a <= d else up if b <= d else corner)) & 255
        image[r + 1] = np.frombuffer(bytes(now), np.uint8)
        above = now
    return image[1:, step:].copy().view(f">u{step}").reshape(height, width).astype(int)


def mask_of(annotation: dict) -> np.ndarray:
    """The pixels of an annotation, from its run lengths down the columns."""
    rows, columns = annotation["segmentation"]["size"]
    runs = annotation["segmentation"]["counts"]
    return np.repeat(np.arange(len(runs)) % 2 == 1, runs).reshape(columns, rows).T


def hidden(seen: Seen, by: list[Seen], step: float = np.radians(0.6)) -> np.ndarray:
    """Where something of the other surfaces may stand in front, or within 10 cm behind: a point of a bed 2 cm apart, 2.5 m
    away, hides as far as 0.9 degrees."""
    nearest: dict[tuple[int, int], float] = {}
    low = np.array([a.min() - 3 for a in seen.cell(step)])
    high = np.array([a.max() + 4 for a in seen.cell(step)])
    front = np.full(high - low, np.inf)
    for other in by:
        a, e = other.cell(step)
        near = (a > low[0]) & (a < high[0] - 1) & (e > low[1]) & (e < high[1] - 1)
        np.minimum.at(front, (a[near] - low[0], e[near] - low[1]), other.range[near])
    wide = np.full_like(front, np.inf)
    for da in (-1, 0, 1):
        for de in (-1, 0, 1):
            wide = np.minimum(wide, np.roll(front, (da, de), (0, 1)))
    a, e = seen.cell(step)
    return wide[a - low[0], e - low[1]] < seen.range + 0.1


class Referee:
    """Counts what is wrong with the labels of a data set."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.set = folder, folder / "set"
        self.bed = Surface(folder / "bed.ply")
        self.body = {name: Surface(folder / f"{name}.ply") for name in BODIES}
        self.wrong: Counter[str] = Counter()
        self.counted: Counter[str] = Counter()
        self.first: dict[str, str] = {}
        self.number_of: dict[str, int] = {}
        self.worst_px = {"fan": -99.0, "polar": -99.0}

    def complain(self, what: str, where: str) -> None:
        self.wrong[what] += 1
        self.first.setdefault(what, where)

    @staticmethod
    def class_of(part: str) -> str:
        return "post" if part == "post" else re.sub(r"-\d+$", "", part)

    def surface_of(self, part: str) -> Surface:
        return self.body["wedge" if part == "post" else self.class_of(part)]

    def run(self) -> "Referee":
        coco = {form: self.read_coco(form) for form in ("polar", "fan")}
        mapping = json.loads((self.set / "fan_mapping.json").read_text())[0]
        for line in (self.set / "meta.jsonl").read_text().splitlines():
            meta = json.loads(line)
            self.counted["images"] += 1
            head_from_world = np.linalg.inv(np.array(meta["world_from_head"]))
            bed = Seen(self.bed, head_from_world)
            parts = {p["part"]: Seen(self.surface_of(p["part"]), head_from_world @ np.array(p["world_from_part"]),
                                     p["scale"])
                     for p in meta["parts"] if p["world_from_part"] is not None}
            for p in meta["parts"]:
                if self.number_of.setdefault(p["part"], p["number"]) != p["number"]:
                    self.complain("changed id", f"{meta['name']} {p['part']}")
            for name in ("polar", "fan"):
                masks = read_png(self.set / name / "masks" / (meta["name"] + ".png"))
                numbers = read_png(self.set / name / "instances" / (meta["name"] + ".png"))
                form = Form(name, meta, mapping, masks.shape)
                self.judge(form, parts, bed, coco[name], masks, numbers)
        return self

    def read_coco(self, form: str) -> dict:
        all_of = json.loads((self.set / form / "annotations" / "instances_train.json").read_text())
        names = {c["id"]: c["name"] for c in all_of["categories"]}
        if "shadow" in names.values():
            self.complain("shadow has a class of boxes", form)
        of_image: dict[str, list[dict]] = {Path(i["file_name"]).stem: [] for i in all_of["images"]}
        stem = {i["id"]: Path(i["file_name"]).stem for i in all_of["images"]}
        for a in all_of["annotations"]:
            of_image[stem[a["image_id"]]].append({**a, "class": names[a["category_id"]]})
        return of_image

    def judge(self, form: Form, parts: dict[str, Seen], bed: Seen, coco: dict, masks: np.ndarray,
              numbers: np.ndarray) -> None:
        image = form.meta["name"]
        classes = {part["number"]: part["class"] for part in form.meta["parts"]}
        of_number = {part["number"]: part["part"] for part in form.meta["parts"]}
        facing = {part: (seen.cosine > 0) & form.inside(seen) for part, seen in parts.items()}
        # Every pixel of an object lies within a cell and a beam of the object.
        for number in np.unique(numbers[numbers > 0]):
            part, where = of_number.get(number), numbers == number
            if part is None or part not in parts:
                self.complain("object that is not there", f"{form.name} {image} {number}")
                continue
            self.counted[f"objects in {form.name} masks"] += 1
            seen = parts[part]
            around = (seen.cosine > 0)
            near = widened(form.marks(seen, around), *form.reach(seen, around))
            if (where & ~near).any():
                self.complain("pixel beside its object", f"{form.name} {image} {part}: {(where & ~near).sum()} of {where.sum()}")
            if classes[number] != self.class_of(part):
                self.complain("wrong class of a part", f"{form.name} {image} {part}")
        boxed = {}
        for a in coco[image]:
            self.counted[f"boxes in {form.name} images"] += 1
            boxed[a.get("part")] = a
            self.judge_box(form, a, parts, masks, numbers)
        self.judge_missing(form, parts, bed, facing, boxed, numbers)
        self.judge_contrast(form, boxed, numbers, of_number)

    def judge_contrast(self, form: Form, boxed: dict, numbers: np.ndarray, of_number: dict) -> None:
        """An object far above its ring has a box, one far below it has none. Black pixels count as black, which brings
        both nearer to nothing."""
        name, least_pixels = form.meta["name"], 20
        image = read_png(self.set / form.name / "images" / (name + ".png"))
        window, steps = form.meta["mapping"], 255 if form.name == "fan" else 65535
        intensity = 10 ** ((window["min_db"] + image * (window["max_db"] - window["min_db"]) / steps) / 10)
        shown = form.pixels_inside()
        for number in np.unique(numbers[numbers > 0]):
            own = numbers == number
            if own.sum() < least_pixels:
                continue
            rows, columns = np.flatnonzero(own.any(1)), np.flatnonzero(own.any(0))
            ring = np.zeros_like(own)
            along, across = max(2, np.ptp(rows) + 1), max(2, np.ptp(columns) + 1)
            ring[max(0, rows[0] - along):rows[-1] + 1 + along, max(0, columns[0] - across):columns[-1] + 1 + across] = True
            ring &= shown & (numbers == 0)
            if not ring.any():
                continue
            contrast = 10 * np.log10(intensity[own].mean() / intensity[ring].mean())
            where = f"{form.name} {name} {of_number.get(number)}: {contrast:.1f} dB"
            self.counted[f"contrasts in {form.name} images"] += 1
            if contrast > 6:
                self.counted[f"loud objects in {form.name} images"] += 1
                if of_number.get(number) not in boxed:
                    self.complain("loud object without a box", where)
            if contrast < -6:
                self.counted[f"dark objects in {form.name} images"] += 1
                if of_number.get(number) in boxed:
                    self.complain("box of a dark object", where)

    def judge_box(self, form: Form, a: dict, parts: dict[str, Seen], masks: np.ndarray, numbers: np.ndarray) -> None:
        where = f"{form.name} {form.meta['name']} {a.get('part')}"
        if a["class"] == "shadow" or a["found_by"] != "part" or a["part"] not in parts:
            return self.complain("box of no object", where)
        part, seen = a["part"], parts[a["part"]]
        if a["class"] != self.class_of(part):
            self.complain("wrong class of a box", where)
        if a["instance"] != self.number_of[part]:
            self.complain("changed id", where)
        mask = mask_of(a)
        if not (numbers[mask] == a["instance"]).all() or mask.sum() != a["area"]:
            self.complain("mask of other pixels", where)
        if not (masks[mask] == a["category_id"]).all():
            self.complain("pixels of other classes", where)
        rows, columns = np.flatnonzero(mask.any(1)), np.flatnonzero(mask.any(0))
        if a["bbox"] != [columns[0], rows[0], np.ptp(columns) + 1, np.ptp(rows) + 1]:
            self.complain("box beside its mask", where)
        facing = seen.cosine > 0
        row, column = (x[facing] for x in form.pixel(seen.range, seen.azimuth))
        beyond = max(row.min() - rows[0] - 1, rows[-1] - row.max(), column.min() - columns[0] - 1, columns[-1] - column.max())
        self.worst_px[form.name] = max(self.worst_px[form.name], float(beyond))
        # The box of the whole, where nothing but the fan itself bounds it.
        if self.class_of(part) in CONVEX and form.inside(seen, np.radians(1))[facing].all():
            self.counted[f"whole boxes in {form.name} images"] += 1
            left, top, width, height = a["bbox_whole"]
            off = np.abs([left + 0.5 - column.min(), left + width - 0.5 - column.max(), top + 0.5 - row.min(),
                          top + height - 0.5 - row.max()])
            # Half a pixel and what is between two points here; and the far side of a round body lies within a triangle.
            if (off[:2] > 1.2).any() or (off[2:] > 2.5).any():
                self.complain("whole box off", f"{where}: {np.round(off, 1)} of {width} x {height}")

    def judge_missing(self, form: Form, parts: dict[str, Seen], bed: Seen, facing: dict, boxed: dict,
                      numbers: np.ndarray) -> None:
        """What surely is the loudest in its pixel must be in the mask, and in the box."""
        half = np.radians(form.meta["elevation_width_deg"]) / 2
        loud = {}
        for part, seen in parts.items():
            sure = facing[part] & (np.abs(seen.elevation) < half)
            if sure.any():
                others = [other for name, other in parts.items() if name != part]
                sure &= ~hidden(seen, [bed, *others])
            if self.class_of(part) not in CONVEX:
                sure[:] = False  # it may hide itself
            loud[part] = self.energies(form, seen, sure)
        every = {part: self.energies(form, seen, facing[part]) for part, seen in parts.items()}
        of_bed = self.energies(form, bed, form.inside(bed))
        for part, energy in loud.items():
            rest = of_bed + sum((e for name, e in every.items() if name != part), np.zeros(form.shape))
            rows, columns = form.reach(parts[part], parts[part].cosine > 0)
            # Spread over a beam and over what is between two points of the bed.
            between = int(np.ceil(0.05 / form.cell))
            sure = (energy > 0) & (summed(energy, between, columns // 2) > 4 * summed(rest, between, columns // 2))
            sure &= energy > 0.02 * energy.max()
            if sure.sum() < 40:
                continue
            self.counted[f"sure objects in {form.name} images"] += 1
            where = f"{form.name} {form.meta['name']} {part}"
            share = (numbers == self.number_of[part])[sure].mean()
            if share < 0.95:
                self.complain("missing pixels", f"{where}: {share:.2f} of {sure.sum()}")
            unboxed = {u["instance"] for u in form.meta["unboxed"][form.name]}
            if part in boxed:
                left, top, width, height = boxed[part]["bbox"]
                r, c = np.nonzero(sure)
                short = max(left - c.min() - columns, c.max() - (left + width - 1) - columns, top - r.min() - rows,
                            r.max() - (top + height - 1) - rows)
                if short > 0:
                    self.complain("box too small", f"{where}: by {short} pixels")
            elif self.number_of[part] not in unboxed:
                self.complain("missing box", where)

    @staticmethod
    def energies(form: Form, seen: Seen, which: np.ndarray) -> np.ndarray:
        row, column = (np.floor(x[which]).astype(int) for x in form.pixel(seen.range, seen.azimuth))
        sums = np.zeros(form.shape)
        there = (row >= 0) & (row < form.shape[0]) & (column >= 0) & (column < form.shape[1])
        np.add.at(sums, (row[there], column[there]), seen.energy[which][there])
        return sums


def at_random(mission: str, images: int, low: np.ndarray, high: np.ndarray) -> str:
    """The mission with random poses, of which none has an order, in place of its trajectory."""
    mission = re.sub(r"\[trajectory\].*?(?=\[\[head\]\])", "", mission, flags=re.S)
    mission = re.sub(r"(pitch_deg|rate_hz) = .*\n", "", mission)
    box = {"low": [float(low[0]) - 2, float(0.6 * low[1] + 0.4 * high[1]), float(high[2]) + 0.3],
           "high": [float(0.85 * low[0] + 0.15 * high[0]), float(0.4 * low[1] + 0.6 * high[1]), float(high[2]) + 2]}
    return mission.replace("[ping]\n", AT_RANDOM.format(images=images, **box))


def make_set(tool: str, folder: Path, images: int, bed: str = "", keep: str = "labels", random: bool = False) -> None:
    """A survey of a head that passes a bed, with bodies drawn anew for each ping, and the data set of it.

    keep: labels of display cells, or contributors, for labels of samples; random: poses of the head are, too"""
    def run(*words: str) -> None:
        subprocess.run([tool, *words, "-q"], cwd=folder, check=True)
    if bed:
        run("prepare", bed, "-o", "bed.ply")
    else:
        run("make-scene", "reef", "--points", "60000", "-o", "bed.ply")
    for name, kind in BODIES.items():
        run("make-object", kind, "-o", f"{name}.ply")
    place = Surface(folder / "bed.ply").place
    low, high = place.min(0), place.max(0)
    middle, top = (low + high) / 2, high[2]
    reach = 0.5 * (high - low)[:2]
    area = [[float(middle[0] + x * reach[0]), float(middle[1] + y * reach[1])]
            for x, y in ((-0.7, -0.5), (0.8, -0.5), (0.8, 0.5), (-0.7, 0.5))]
    post = [float(middle[0]), float(middle[1] + 0.2 * reach[1]), float(top + 0.2)]
    first = [float(low[0] - 2), float(middle[1] - 0.3 * reach[1]), float(top + 1)]
    last = [float(low[0] - 1), float(middle[1] + 0.3 * reach[1]), float(top + 1.5)]
    length = float(np.linalg.norm(np.subtract(last, first)))
    # A head that looks along x, whatever the course.
    course = float(np.degrees(np.arctan2(last[1] - first[1], last[0] - first[0])))
    mission = MISSION.format(first=first, last=last, speed=length / (images - 0.5),
                             keep=keep)
    if random:
        mission = at_random(mission, images, low, high)
    else:
        mission = mission.replace("pitch_deg = -20\n", f"pitch_deg = -20\nheading_deg = {course:.6f}\n")
    (folder / "scene.toml").write_text(SCENE.format(post=post, area=area))
    (folder / "mission.toml").write_text(mission)
    run("survey", "mission.toml", "-o", "survey")
    names = ",".join(sorted(Surface(folder / "bed.ply").names))
    run("dataset", "survey", "-o", "set", "--stuff", names, "--split", "100:0:0")


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("tool")
    arguments.add_argument("folder", type=Path)
    arguments.add_argument("--images", type=int, default=300)
    arguments.add_argument("--bed", default="")
    arguments.add_argument("--random", action="store_true", help="random poses in place of a trajectory")
    arguments.add_argument("--judge-only", action="store_true", help="of a data set that is there already")
    o = arguments.parse_args()
    o.folder.mkdir(parents=True, exist_ok=True)
    if not o.judge_only:
        make_set(str(Path(o.tool).absolute()), o.folder, o.images, o.bed, random=o.random)
    found = Referee(o.folder).run()
    print(json.dumps({"counted": found.counted, "wrong": found.wrong, "first": found.first,
                      "pixels beyond the outline": found.worst_px}, indent=2))


if __name__ == "__main__":
    main()
