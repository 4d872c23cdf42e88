# SPDX-License-Identifier: BSD-3-Clause
"""A synthetic aperture: 100 pings of a short array along a line over a reef, back-projected into one focused image.

    PYTHONPATH=build/release/python python3 apps/08_synthetic_aperture.py [PICTURE.png]

The picture has the pings as they are on the left, and focused on the right: along the line upwards, range to the right.
"""
from __future__ import annotations

import sys

import insonify as iy
import numpy as np
from grey_png import save_grey
from numpy.typing import NDArray

FREQUENCY, RESOLUTION, BEAM_DEG = 200e3, 0.04, 2.77  # [Hz], c / 2B [m], width of the real beam
PINGS, STEP = 100, 0.025                             # along y [m]; an eighth of the array
POINTS = np.array([(7.2, -0.5, -2.6), (8.4, 0.4, -2.5), (10.0, -0.1, -2.6)])  # small targets over the reef [m]
HEAD_X, HEAD_Z, TILT_DEG = 4.0, -2.3, 12.0
REFLECTOR = 200.0  # pressure of a corner reflector over that of a patch of a square centimetre

Pressures = NDArray[np.complex128]
Numbers = NDArray[np.float64]


class Line:
    """Pings of a head that looks along x from places along y."""

    def __init__(self) -> None:
        head = iy.sonar("p900-45", centre_frequency_hz=FREQUENCY, range_resolution_m=RESOLUTION, bin_size_m=0.01,
                        beams=1, field_of_view_deg=0, beam_width_deg=BEAM_DEG, shading="hamming",
                        elevation_width_deg=50, min_range=2, max_range=8)
        self.simulator = iy.PingSimulator(head, iy.Environment(temperature_c=8), accuracy_db=0.5, seed=2)
        self.y = (np.arange(PINGS) - (PINGS - 1) / 2) * STEP
        self.poses = np.zeros((PINGS, 6))
        self.poses[:, 0], self.poses[:, 1], self.poses[:, 2], self.poses[:, 4] = HEAD_X, self.y, HEAD_Z, TILT_DEG

    def pressures(self, scene: iy.Scene) -> Pressures:
        """The pressure of each ping in each range bin; range and sound speed are those of the last ping."""
        pings = list(self.simulator.pings(scene, self.poses))
        self.range, self.sound_speed = pings[-1].range, pings[-1].sound_speed
        return np.concatenate([ping.pressure for ping in pings]).astype(complex)

    @property
    def length(self) -> float:
        """The length of the array [m], whose Hamming window gives the real beam its width."""
        return float(1.303 * self.sound_speed / FREQUENCY / (2 * np.sin(np.radians(BEAM_DEG) / 2)))


def finer(pressure: Pressures, times: int) -> Pressures:
    """The same pressures at `times` as many ranges, by zeros behind their spectrum."""
    bins = pressure.shape[1]
    spectrum, wide = np.fft.fft(pressure, axis=1), np.zeros((len(pressure), bins * times), complex)
    half = (bins + 1) // 2
    wide[:, :half], wide[:, half - bins:] = spectrum[:, :half], spectrum[:, half:]
    return np.fft.ifft(wide, axis=1) * times


def focused(line: Line, pressure: Pressures, along: Numbers, ranges: Numbers) -> Pressures:
    """The image of places along the line and across it: the sum of what each ping heard from there, in phase."""
    times = 8
    fine, step = finer(pressure, times), (line.range[1] - line.range[0]) / times
    # A ping counts where its beam looks: elsewhere pings this far apart hear ghosts, of what they do hear, in phase.
    first_null = 2 * line.sound_speed / FREQUENCY / line.length
    image = np.zeros((len(along), len(ranges)), complex)
    for k, y in enumerate(line.y):
        heard: Pressures = fine[k]
        away = np.hypot(ranges, (along - y)[:, None])
        place = (away - line.range[0]) / step
        below = np.clip(place.astype(int), 0, len(heard) - 2)
        share = np.clip(place - below, 0, 1)
        echo = (1 - share) * heard[below] + share * heard[below + 1]
        in_beam = np.abs(along - y)[:, None] < first_null * away
        image += in_beam * echo * np.exp(-4j * np.pi * FREQUENCY / line.sound_speed * away)
    return image


def width(places: Numbers, intensity: Numbers) -> float:
    """The width about the peak within which the intensity is at least half of it."""
    half, peak = intensity.max() / 2, int(intensity.argmax())
    low = peak - int(np.argmax(intensity[peak::-1] < half))
    high = peak + int(np.argmax(intensity[peak:] < half))
    first = np.interp(half, intensity[low:low + 2], places[low:low + 2])
    last = np.interp(-half, -intensity[high - 1:high + 1], places[high - 1:high + 1])
    return float(last - first)


def main(picture: str | None) -> None:
    line = Line()
    points = iy.Scene(POINTS, normals=np.tile((-1.0, 0, 0), (len(POINTS), 1)), areas=np.full(len(POINTS), 1e-4))
    alone = line.pressures(points)
    # Echoes add up, and small points cast no shadow. In the picture they are as loud as corner reflectors.
    both = REFLECTOR * alone + line.pressures(iy.make_scene("reef", points=60000))

    # The focused image of a point along the line is the shading of the array, at half its length: a Hamming window has
    # half its intensity within 0.191 of its length. Across, it is the envelope of the pulse.
    print(f"array {line.length:.3f} m, line {PINGS * STEP:.2f} m; theory: {1000 * 0.191 * line.length:.1f} mm along, "
          f"{1000 * 0.4413 * RESOLUTION:.1f} mm across")
    for x, y, z in POINTS:
        away = float(np.hypot(x - HEAD_X, z - HEAD_Z))
        near, beyond = y + np.arange(-0.1, 0.1, 0.001), away + np.arange(-0.06, 0.06, 0.0005)
        along = np.abs(focused(line, alone, near, np.array([away]))[:, 0]) ** 2
        across = np.abs(focused(line, alone, np.array([y]), beyond)[0]) ** 2
        print(f"point at {y:5.2f} m, {away:.3f} m off: focused {1000 * (near[along.argmax()] - y):.1f} mm and "
              f"{1000 * (beyond[across.argmax()] - away):.1f} mm from there, {1000 * width(near, along):.1f} mm along, "
              f"{1000 * width(beyond, across):.1f} mm across; real beam {1000 * away * np.radians(BEAM_DEG):.0f} mm")
    if picture is None:
        return
    ranges, along_line = np.arange(2.5, 7.5, 0.01, dtype=np.float64), np.arange(-1.2, 1.2, 0.01, dtype=np.float64)
    nearest = np.abs(along_line[:, None] - line.y).argmin(1)
    bins = np.abs(ranges[:, None] - line.range).argmin(1)
    shown = []
    for image in (both[nearest][:, bins], focused(line, both, along_line, ranges)):
        intensity = np.abs(image) ** 2 + 1e-24
        looks = sum(np.roll(intensity, (i, j), (0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1)) / 9
        level = 10 * np.log10(looks) + 30 * np.log10(ranges)
        top = np.percentile(level, 99.9)
        shown.append(255 * np.clip((level[::-1] - top + 35) / 35, 0, 1))
    save_grey(picture, np.kron(np.concatenate(shown, axis=1), np.ones((2, 2))))


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else None)
