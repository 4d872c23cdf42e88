#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Compares insonify with public records and writes docs/results/comparison-with-records.md and its pictures. Takes about ten minutes of two cores.
#   docs/make_real.sh [build/release/bin]
set -euo pipefail
cd "$(dirname "$0")/.."
bin=$(realpath "${1:-build/release/bin}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
insonify() { "$bin/insonify" "$@" -q; }
compare() { (cd "$work" && insonify compare "$@"); }
cp data/records/{sample.aris,ship_3dsonar_frame5.pcd,sidescan_scotsman.xtf,oculus_three_pings_8bit.raw} "$work"

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

# A side-scan: a line past two walls and a mast on a level bed, as high and as far away as the shadows of the record say.
awk '
  function box(x0, x1, y0, y1, height,   z, k, faces, corners) {
    for (z = bed; z <= bed + height; z += height)
      printf "v %g %g %g\nv %g %g %g\nv %g %g %g\nv %g %g %g\n", x0, y0, z, x1, y0, z, x1, y1, z, x0, y1, z
    split("5 6 7,5 7 8,1 2 6,1 6 5,2 3 7,2 7 6,3 4 8,3 8 7,4 1 5,4 5 8", faces, ",")
    for (k = 1; k <= 10; ++k) { split(faces[k], corners, " "); printf "f %d %d %d\n", n + corners[1], n + corners[2], n + corners[3] }
    n += 8
  }
  BEGIN {
    bed = -4.25; n = 4
    printf "v -4 -31 %g\nv 18 -31 %g\nv 18 31 %g\nv -4 31 %g\nf 1 2 3\nf 1 3 4\n", bed, bed, bed, bed
    box(-2, 12, -5.1, -4.9, 0.5); box(-2, 12, -11.7, -11.5, 0.95); box(12, 12.6, -11.6, -11.35, 3.5)
  }' >"$work/wreck.obj"
cat >"$work/line.toml" <<'TOML'
schema = 1
[survey]
scene = "wreck.obj"
anchor = { latitude_deg = 48.44569, longitude_deg = -68.828155, heading_deg = 341 }
start_utc = "2013-09-10T21:13:39.54Z"
[trajectory]
waypoints_m = [[0, 0, 0], [13.8, 0, 0]]
speed_m_s = 1.15
[[head]]
name = "port"
sonar = "klein-3000"
range = "1:29.98"
set = ["sonar.centre_frequency_hz=600000"]
every_m = 0.12
[[head]]
name = "starboard"
sonar = "klein-3000"
side = "starboard"
range = "1:29.98"
set = ["sonar.centre_frequency_hz=600000"]
every_m = 0.12
TOML
insonify survey "$work/line.toml" -o "$work/line" >/dev/null
insonify export "$work/line" --to xtf -o "$work/line.xtf" >/dev/null
port=$(compare line.xtf sidescan_scotsman.xtf --channel 0)
starboard=$(compare line.xtf sidescan_scotsman.xtf --channel 1 | sed -n '/^range/,$p')
waterfall=(--view waterfall --window 40 --size 900x675 --force)
insonify image "$work/sidescan_scotsman.xtf" "${waterfall[@]}" --title "the record" -o docs/images/real-side-scan.png >/dev/null
insonify image "$work/line.xtf" "${waterfall[@]}" --title "simulated, 30 log r + 2 a r" -o docs/images/real-wreck.png >/dev/null

# An imaging sonar over a bed that fills the ranges in which the record is bright.
insonify make-scene plane -o "$work/near.ply" --points 400000 --size 4,4 >/dev/null
insonify ping "$work/near.ply" --sonar oculus-m1200d-hf --set sonar.beams=256 --pose=0,0,0.36,0,23,0 --range 0.3:1.998 \
  --no-picture -o "$work/near" >/dev/null
oculus=$(compare near oculus_three_pings_8bit.raw -o oculus)
fan=(--size 900x675 --window 45 --force)
insonify image "$work/oculus_three_pings_8bit.raw" "${fan[@]}" --title "the record" -o docs/images/real-oculus.png >/dev/null
insonify image "$work/near" "${fan[@]}" --raw --title "simulated" -o docs/images/real-oculus-bed.png >/dev/null

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

## A side-scan: a wreck

Record: 115 of 461 pings of `scotsman-iver2.xtf` of [CIDCO-dev/OpenSidescan](https://github.com/CIDCO-dev/OpenSidescan) (MIT, licence in `data/records`): the after half of the wreck Scotsman by an Iver2 AUV, 600 kHz,
2 x 1024 samples of 16 bits to 29.98 m, 1 m/s. Beside it a line by `klein-3000` at 600 kHz, the nearest preset, 4.25 m above a level bed (the record's first return) with two walls of 0.5 and 0.95 m and a mast of 3.5 m to
starboard, written by `export --to xtf` and read again: both have a gain, of the record an unknown one.

| the record | the line |
|---|---|
| ![The record](../images/real-side-scan.png) | ![A simulated line](../images/real-wreck.png) |

Port, the bed alone (A the line, B the record):

```
TEXT
echo "$port"
cat <<'TEXT'
```

Starboard, the wreck:

```
TEXT
echo "$starboard"
cat <<'TEXT'
```

Where insonify is off, and what is not its fault:

- First return: that of the line is at its altitude to a bin. That of the record is 0.5 m beyond the altitude in its headers, on either side: the altimeter has a place of its own, or the ranges of the record an offset. The line has no altitude but by sound.
- Shadows: that of the far wall ends where similar triangles say, at 12.35 m x 4.25 / 3.3 = 15.9 m. The longest is that of the mast in either image; the record's is cut at 24.5 m, where the record has a line of
  interference. Shadows of the record are less deep: it has noise, and a wreck scatters into them; the line has neither.
- Fall-off: after 30 log r + 2 a r the line falls by 9 dB from 9 to 27 m, the record by 18 dB after a gain of its own. Its pattern across is not that of the preset (40 degrees, 15 degrees down), which is assumed; and a gain that is not published can be anything.
- Speckle: a bin of the record is the mean of 3.5 samples of the line, so that the line has 2.6 looks in it at all ranges. The record has the contrast of 2.5 looks at 9 m, where loud samples are compressed (2.9 % of all are at the
  largest value), and that of one look at 21 m. Beyond, it is higher than that of speckle: ripples of sand, which the level bed has not.
- Response: neither image is correlated from bin to bin. Along the track the record is, a little (1.15 pings of 0.12 m; with the wreck 1.3): its beam is wider than the 0.21 degrees of the preset.

## An imaging sonar: Oculus

Record: three pings of `three_pings_8bit.raw` of [apl-ocean-engineering/liboculus](https://github.com/apl-ocean-engineering/liboculus) (BSD, licence in `data/records`), 256 beams x 703 ranges of 8 bits at 2.1 MHz, sent with a gamma of 0.5,
which is taken back. Where it was taken is not published. Beside it a level bed by `oculus-m1200d-hf`, from a place where it fills the ranges in which the record is bright.

| the record | the bed |
|---|---|
| ![The record](../images/real-oculus.png) | ![A simulated bed](../images/real-oculus-bed.png) |

```
TEXT
echo "$oculus"
cat <<'TEXT'
```

Where insonify is off, and what is not its fault:

- The record is never silent: beyond 1.2 m its noise, with a gain that grows with range, has the deviation of one look (5.57 dB), which also shows that the gamma is taken back as it was applied. The run has no noise (`--noise` was not asked for):
  it falls by 24 dB from 1 to 1.8 m, the record by 17 dB into its noise, and that is what the figures pixel by pixel measure.
- Speckle of the run is that of 1.6 looks where two of its bins make one of the record; that of the record's bed, 0.8 to 1.2 m, has the texture of a real bed and more contrast than speckle.
- Response across: the record's is 3.6 beams wide, the run's 2.7. That of speckle is 1.41 times the beam at half power, so the beams are 0.60 and 0.46 degrees wide; the preset has 0.4.

## What is missing

No public record was found that has a scanned scene, the sonar's calibration and its raw levels together. Until then levels in dB are checked against closed forms
([verification.md](../verification.md)), and this page checks statistics and ranks.
TEXT
} > docs/results/comparison-with-records.md
