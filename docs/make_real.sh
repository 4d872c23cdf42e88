#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Compares insonify with public records and writes docs/results/comparison-with-records.md and its pictures. Takes about two minutes.
#   docs/make_real.sh [build/release/bin]
set -euo pipefail
cd "$(dirname "$0")/.."
bin=$(realpath "${1:-build/release/bin}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
insonify() { "$bin/insonify" "$@" -q; }
compare() { (cd "$work" && insonify compare "$@"); }
cp data/records/sample.aris data/records/ship_3dsonar_frame5.pcd "$work"

# Two seeds, the expected level, and another gain of one scene.
insonify make-scene harbour -o "$work/harbour.ply" --points 150000 >/dev/null
ping=(ping "$work/harbour.ply" --sonar p900-45 --pose=0,0,-3,0,10,0 --range 2:15 --no-picture)
insonify "${ping[@]}" --seed 1 -o "$work/seed-1" >/dev/null
insonify "${ping[@]}" --seed 2 -o "$work/seed-2" >/dev/null
insonify "${ping[@]}" --method incoherent -o "$work/expected" >/dev/null
seeds=$(compare seed-1 seed-2)
expected=$(compare expected seed-1 | sed -n 1,7p)

# A lens sonar: a frame of the recording against an even bed heard by a head of its beams.
insonify make-scene plane -o "$work/bed.ply" --points 200000 --size 50,50 >/dev/null
insonify ping "$work/bed.ply" --sonar aris-1800-lf --set sonar.centre_frequency_hz=1200000 --set sonar.field_of_view_deg=13.8 \
  --set sonar.beam_width_deg=0.3 --set sonar.range_resolution_m=0.01 --pose=0,0,2,0,9,0 --range 3.3:23.4 --no-picture -o "$work/bed" >/dev/null
aris=$(compare bed sample.aris -o aris)

# A 3-D sonar: the geometry that it measured, pinged by a head like it, against the strength that it measured there. One place
# saw all of its points, so none hides another (--viewpoint).
insonify ping "$work/ship_3dsonar_frame5.pcd" --viewpoint=0,0,0 --sonar waterlinked-3d15 --pose=0,0,0,0,0,0 --range 0.3:15 --method incoherent \
  --no-picture -o "$work/ship" >/dev/null
points=$(compare ship ship_3dsonar_frame5.pcd --strength intensity --strength-unit linear -o ship-points)

cp "$work/aris/b.png" docs/images/real-aris.png
cp "$work/aris/a.png" docs/images/real-bed.png
cp "$work/aris/levels.png" docs/images/real-aris-levels.png
cp "$work/ship-points/points.png" docs/images/real-points.png
cp "$work/ship-points/points_without_trend.png" docs/images/real-points-trend.png

{
cat <<'TEXT'
# How real is it

Made by [docs/make_real.sh](../make_real.sh); do not edit. Measures are those of `insonify compare` (E120 to E124, [equations.md](../equations.md)).

Figures of likeness mean nothing without their floor: two pings of one scene that differ in nothing but their speckle have a PSNR of 17.6 dB in a window of 60 dB, and
so would a perfect simulator against reality. `compare` draws that floor for each pair and prints it beside the figures.

## Against itself: the floor

Two seeds of the built-in harbour, `p900-45`, 2 to 15 m:

```
TEXT
echo "$seeds"
cat <<'TEXT'
```

The harbour has edges, shadows and silence before the first echo, which raise SSIM: the drawn floor follows them, from one of the images alone; the analytic one is that of an even scene. Expected levels (`--method incoherent`) against
one seed:

```
TEXT
echo "$expected"
cat <<'TEXT'
```

## A lens sonar: ARIS 1200

Record: `sample.aris` of [SoundMetrics/aris-file-sdk](https://github.com/SoundMetrics/aris-file-sdk) (MIT, licence in `data/records`), of which the first two frames are kept:
48 beams x 2000 samples of 8 bits, 0 to 80 dB. Where it was taken is not published, so no scene can be built for it, and pixel by pixel nothing can be
expected: gain, speckle and widths alone can be compared, here with a level, even bed heard by a head of its beams (`aris-1800-lf` at 1.2 MHz over 13.8 degrees).

| the record | the bed |
|---|---|
| ![The record](../images/real-aris.png) | ![A simulated bed](../images/real-bed.png) |

```
TEXT
echo "$aris"
cat <<'TEXT'
```

![Levels](../images/real-aris-levels.png)

Where insonify is off, and what is not its fault:

- PSNR and SSIM after the gain are those of two unlike pictures: the scenes differ. They are printed to show how little such figures say.
- The record's local deviation is smaller than the 5.57 dB of one look: the sonar averages, or its logarithm compresses; a run is of one look unless `--looks-range` says otherwise.
- The level at long range: the record has noise and a time-varied gain that is not published; the run has neither.
- The beams of the record are as wide as their spacing in its statistics; those of the preset are assumed (`insonify sonars aris-1800-lf`).

## A 3-D sonar: Water Linked 3D-15

Record: frame 5 of `ship_short.sonar` of [waterlinked/wlsonar](https://github.com/waterlinked/wlsonar) (MIT, licence in `data/records`): 10 976 points with a strength each, so
geometry and return come together. The points are the scene, pinged from where the sonar was; the level at each point's beam and bin is the prediction:

```
TEXT
echo "$points"
cat <<'TEXT'
```

| as they are | without the trends over range |
|---|---|
| ![Levels](../images/real-points.png) | ![Without trends](../images/real-points-trend.png) |

Where insonify is off, and what is not its fault:

- The difference of the slopes over range, 30 dB per decade, is that of a time-varied gain of 30 log r, absorption included; the device's is not published. Trends are taken off
  before ranks are compared.
- The sonar saw every point, so the run may let none hide another: `--viewpoint=0,0,0`, which a ping takes by itself, since rows and columns of the cloud fan out from there. Before, a third of the points
  were behind the surfels of others, where the run heard side lobes 50 dB below; their share grows with range, which made a slope of -98 dB per decade. `compare` notes points that are predicted 20 dB below the trend.
- One frame is a cloud of one echo for each direction: what lies between is not there, normals are estimated from neighbours, and material is one for all. What a rank correlation lacks of the
  ceiling says so: geometry alone explains that much of the strength, not more.
- One frame alone: the ceiling of a repeated measurement (`--repeat`) is not known; that of one look of speckle is.

## What is missing

No public record was found that has a scanned scene, the sonar's calibration and its raw levels together. Until then levels in dB are checked against closed forms
([verification.md](../verification.md)), and this page checks statistics and ranks.
TEXT
} > docs/results/comparison-with-records.md
