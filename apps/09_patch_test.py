# SPDX-License-Identifier: BSD-3-Clause
"""A patch test: what is wrong in the installation of a multibeam, from a GSF file of lines over a slope.

    python3 apps/09_patch_test.py make FOLDER     # bed.obj, way.csv and mission.toml of four lines
    python3 apps/09_patch_test.py solve patch.gsf # roll, pitch, heading and latency that were assumed too small

It reads GSF by itself (numpy alone) and uses nothing of insonify. docs/patch-test.md explains both.
"""
from __future__ import annotations

import json
import struct
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Ping = dict[Any, Any]  # head and attitude by name, beam arrays by the numbers of GSF

MISSION = """schema = 1
[survey]
scene = "bed.obj"
anchor = { latitude_deg = 54.1, longitude_deg = 7.9, heading_deg = 70 }
[water]
level_m = 0
[trajectory]
file = "way.csv"
max_gap_s = 2
[[head]]
name = "swath"
sonar = "em2040"
set = ["sonar.beams=48", "sonar.field_of_view_deg=100"]
range = "4:32"
rate_hz = 2.5
roll_deg = 0.8        # true
pitch_deg = -1.3
heading_deg = 1.5
latency_s = 0.25
[head.assumed]        # what acquisition assumes
roll_deg = 0
pitch_deg = 0
heading_deg = 0
latency_s = 0
[ping]
split = true
"""
LINES = [  # y [m], direction along x, speed [m/s]: a pair, the same line faster, and one beside it
    (0.0, 1, 2.0), (0.0, -1, 2.0), (0.0, 1, 5.0), (13.0, 1, 2.0)]
HALF_LENGTH = 8.0  # of a line [m]
RUN_IN = 1.0       # time before and after a line, when the ship is on its way already [s]


def make(folder: Path) -> None:
    """Writes the bed, a slope of 15 degrees along the lines, the way of the ship and the mission."""
    folder.mkdir(parents=True, exist_ok=True)
    rise = np.tan(np.radians(15))
    corners = [(x, y, -11 + rise * x) for x, y in ((-22, -34), (22, -34), (22, 46), (-22, 46))]
    lines = [f"v {x} {y} {z:.6f}\n" for x, y, z in corners] + ["f 1 2 3\n", "f 1 3 4\n"]
    (folder / "bed.obj").write_text("".join(lines))
    rows, legs, begin = ["time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n"], "", RUN_IN
    for number, (y, ahead, speed) in enumerate(LINES):
        duration = 2 * HALF_LENGTH / speed
        for t in np.arange(-RUN_IN, duration + RUN_IN + 0.05, 0.1):
            pitch, roll = 0.8 * np.sin(0.9 * (begin + t)), 1.5 * np.sin(0.7 * (begin + t))
            rows.append(f"{begin + t:.3f},{ahead * (speed * t - HALF_LENGTH):.6f},{y},-1,"
                        f"{0 if ahead > 0 else 180},{pitch:.6f},{roll:.6f}\n")
        legs += f'[[leg]]\nname = "line-{number + 1}"\nfrom_s = {begin}\nto_s = {begin + duration}\n'
        begin += duration + 30  # a turn, without pings
    (folder / "way.csv").write_text("".join(rows))
    (folder / "mission.toml").write_text(MISSION + legs)


def records(data: bytes) -> Iterator[tuple[int, bytes]]:
    """Yields type and contents of the records of a GSF file."""
    at = 0
    while at < len(data):
        size, kind = struct.unpack_from(">II", data, at)
        yield kind & 0x3FFFFF, data[at + 8:at + 8 + size]
        at += 8 + size


def array_of(raw: bytes, beams: int, number: int, scale: tuple[int, int]) -> Array:
    """Numbers of a beam array, which has big-endian whole numbers of 1, 2 or 4 bytes."""
    signed = number in (2, 3, 5)
    numbers = np.frombuffer(raw, f">{'i' if signed else 'u'}{len(raw) // beams}", beams)
    return np.asarray(numbers / scale[0] - scale[1])


def read_ping(data: bytes, scales: dict[int, tuple[int, int]]) -> Ping:
    """Head, attitude and beams of a ping; `scales` goes on from ping to ping."""
    s, ns, lon, lat, beams, _, _, _, _, _, heading, pitch, roll = struct.unpack_from(">IIiiHHHHhiHhh", data, 0)
    height, separation = struct.unpack_from(">ii", data, 42)
    ping: Ping = {"time": s + 1e-9 * ns, "longitude": np.radians(lon * 1e-7), "latitude": np.radians(lat * 1e-7),
                  "height": (height - separation) / 1000,
                  "attitude": np.radians([heading / 100, pitch / 100, roll / 100])}
    at = 56
    while at + 4 <= len(data):
        number, size = data[at], int.from_bytes(data[at + 1:at + 4], "big")
        raw = data[at + 4:at + 4 + size]
        if number == 100:
            for k in range(int.from_bytes(raw[:4], "big")):
                which, _, multiplier, offset = struct.unpack_from(">BBxxii", raw, 4 + 12 * k)
                scales[which] = (multiplier, offset)
        elif number == 16:
            ping["flags"] = np.frombuffer(raw, np.uint8, beams)
        elif number in scales:
            ping[number] = array_of(raw, beams, number, scales[number])
        at += 4 + size
    return ping


def read_gsf(path: Path) -> tuple[list[Ping], dict[str, str], float]:
    """Pings, processing parameters, and the sound speed of a profile that has one alone [m/s]."""
    pings: list[Ping] = []
    parameters: dict[str, str] = {}
    scales: dict[int, tuple[int, int]] = {}
    speed = 0.0
    for kind, data in records(path.read_bytes()):
        if kind == 2:
            pings.append(read_ping(data, scales))
        elif kind == 3:
            count = struct.unpack_from(">I", data, 24)[0]
            speeds = {struct.unpack_from(">II", data, 28 + 8 * k)[1] / 100 for k in range(count)}
            if len(speeds) != 1:
                sys.exit("the profile must have one sound speed: rays are straight here")
            speed = speeds.pop()
        elif kind == 4:
            at = 10
            for _ in range(struct.unpack_from(">H", data, 8)[0]):
                size = struct.unpack_from(">H", data, at)[0]
                key, _, value = data[at + 2:at + 2 + size].rstrip(b"\0").decode().partition("=")
                parameters[key] = value
                at += 2 + size
    return pings, parameters, speed


def turn(heading: Any, pitch: Any, roll: Any) -> Array:
    """Rz(heading) Ry(pitch) Rx(roll) in axes ahead, to starboard and down; of arrays one matrix each."""
    (ch, sh), (cp, sp), (cr, sr) = [(np.cos(a), np.sin(a)) for a in (heading, pitch, roll)]
    return np.moveaxis(np.array([[ch * cp, ch * sp * sr - sh * cr, ch * sp * cr + sh * sr],
                                 [sh * cp, sh * sp * sr + ch * cr, sh * sp * cr - ch * sr],
                                 [-sp, cp * sr, cp * cr]]), (0, 1), (-2, -1))


class Soundings:
    """Soundings of all lines as directions and ranges, to be placed anew by another installation."""

    def __init__(self, pings: list[Ping], parameters: dict[str, str], sound_speed: float) -> None:
        self.time = np.array([p["time"] for p in pings])
        latitude = np.array([p["latitude"] for p in pings])
        longitude = np.array([p["longitude"] for p in pings])
        a, e2, sine = 6378137.0, 0.00669437999014, np.sin(latitude[0])
        root = np.sqrt(1 - e2 * sine**2)  # radii of WGS 84 along and across the meridian: a (1 - e2) / root^3, a / root
        self.place = np.stack([(latitude - latitude[0]) * a * (1 - e2) / root**3,
                               (longitude - longitude[0]) * a / root * np.cos(latitude[0]),
                               -np.array([p["height"] for p in pings])], axis=1)  # north, east, down
        self.attitude = np.unwrap(np.array([p["attitude"] for p in pings]), axis=0)
        self.line = np.cumsum(np.diff(self.time, prepend=self.time[0]) > 5)
        ends = [(self.time[self.line == k].min(), self.time[self.line == k].max()) for k in self.line]
        inner = np.array([first + 0.5 < t < last - 0.5 for t, (first, last) in zip(self.time, ends)])
        number, vectors = [], []
        for k, p in enumerate(pings):
            kept = (p["flags"] == 0) & inner[k]
            angle, azimuth = np.radians(p[5][kept]), np.radians(p[18][kept])
            reach = sound_speed * p[4][kept] / 2
            level = np.stack([np.sin(angle) * np.sin(azimuth), np.sin(angle) * np.cos(azimuth), np.cos(angle)], 1)
            number.append(np.full(kept.sum(), k))
            vectors.append(reach[:, None] * level)
        self.ping = np.concatenate(number)
        level = np.concatenate(vectors)
        _, pitch, roll = self.attitude[self.ping].T
        in_ship = np.einsum("nji,nj->ni", turn(np.zeros_like(pitch), pitch, roll), level)
        believed = [np.radians(float(parameters[f"APPLIED_TRANSDUCER_{which}_OFFSET"].split(",")[0]))
                    for which in ("HEADING", "PITCH", "ROLL")]
        self.believed = np.array(believed[::-1] + [0.0])  # roll, pitch, heading [rad], latency [s]
        self.in_head = in_ship @ turn(*believed)

    def at(self, values: Array, late: float) -> Array:
        """Values of the ship at each ping plus `late` [s], line by line, by cubics through values and slopes."""
        found = np.empty_like(values)
        for k in np.unique(self.line):
            mine = self.line == k
            t, v, wanted = self.time[mine], values[mine], self.time[mine] + late
            slope = np.gradient(v, t, axis=0)
            i = np.clip(np.searchsorted(t, wanted) - 1, 0, len(t) - 2)
            step = (t[i + 1] - t[i])[:, None]
            u = (wanted - t[i])[:, None] / step
            found[mine] = ((1 + 2 * u) * (1 - u)**2 * v[i] + u * (1 - u)**2 * step * slope[i]
                           + u**2 * (3 - 2 * u) * v[i + 1] - u**2 * (1 - u) * step * slope[i + 1])
        return found

    def placed(self, offsets: Array) -> Array:
        """North, east and down [m] with offsets in roll, pitch, heading [rad] and latency [s] of what was assumed."""
        roll, pitch, heading, late = self.believed + offsets
        in_ship = self.in_head @ turn(heading, pitch, roll).T
        place, attitude = self.at(self.place, late)[self.ping], self.at(self.attitude, late)[self.ping]
        return np.asarray(place + np.einsum("nij,nj->ni", turn(*attitude.T), in_ship))


def bed_terms(at: Array) -> list[Array]:
    """Terms of a bed of second order, and their slopes north and east."""
    n, e = at[:, 0] / 10, at[:, 1] / 10
    o, z = np.ones_like(n), np.zeros_like(n)
    return [np.stack(rows, 1) for rows in ([o, n, e, n * n, n * e, e * e],
                                           [z, o / 10, z, n / 5, e / 10, z], [z, z, o / 10, z, n / 10, e / 5])]


def solve(soundings: Soundings) -> tuple[Array, Array, float]:
    """Offsets (roll, pitch, heading [rad], latency [s]), their deviations, and the rms of what the bed leaves [m]."""
    offsets, steps = np.zeros(4), np.array([1e-4, 1e-4, 1e-4, 1e-3])
    kept = np.ones(len(soundings.ping), bool)
    for _ in range(8):
        at = soundings.placed(offsets)
        moved = [(soundings.placed(offsets + step) - soundings.placed(offsets - step)) / (2 * size)
                 for step, size in zip(np.diag(steps), steps)]
        terms, north, east = bed_terms(at)
        bed = np.linalg.lstsq(terms[kept], at[kept, 2], rcond=None)[0]
        rest = at[:, 2] - terms @ bed
        rows = np.column_stack([m[:, 2] - (north @ bed) * m[:, 0] - (east @ bed) * m[:, 1] for m in moved] + [-terms])
        found = np.linalg.lstsq(rows[kept], -rest[kept], rcond=None)[0]
        offsets = offsets + found[:4]
        spread = np.sqrt(np.mean(rest[kept]**2))
        kept = np.abs(rest - np.median(rest)) < max(4 * spread, 1e-3)
    covariance = np.linalg.inv(rows[kept].T @ rows[kept]) * spread**2
    return offsets, np.sqrt(np.diag(covariance)[:4]), spread


def main(words: list[str]) -> None:
    if len(words) != 2 or words[0] not in ("make", "solve"):
        sys.exit(__doc__)
    if words[0] == "make":
        return make(Path(words[1]))
    offsets, deviations, spread = solve(Soundings(*read_gsf(Path(words[1]))))
    found = {}
    for name, scale, value, deviation in zip(("roll_deg", "pitch_deg", "heading_deg", "latency_s"),
                                             [180 / np.pi] * 3 + [1], offsets, deviations):
        found[name] = round(float(scale * value), 4)
        print(f"{name:12} {scale * value:8.4f} +- {scale * deviation:.4f} more than assumed", file=sys.stderr)
    print(f"rms above a smooth bed: {1000 * spread:.1f} mm", file=sys.stderr)
    print(json.dumps(found))


if __name__ == "__main__":
    main(sys.argv[1:])
