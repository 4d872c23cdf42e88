#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Draws the pictures of docs/surfaces.md: each law, and a harbour by Lambert's law and by laws of its own. Needs no display.
#   docs/make_surfaces.sh [build/release/bin/insonify]
set -euo pipefail
cd "$(dirname "$0")/.."
. docs/picture_page.sh
begin_page surfaces "${1:-build/release/bin/insonify}"

cat >table.toml <<'END'
schema = 1
[[material]]
name = "measured"
law = "table"
incidence_deg = [0, 10, 20, 40, 60, 80]
frequency_khz = [100, 400]
sigma_db = [-8, -14, -19, -22, -25, -33, -6, -11, -16, -19, -22, -30]
END
insonify materials medium-sand@seabed -o seabed.png
insonify materials medium-sand@small_slope -o small_slope.png
insonify materials concrete@rough --khz 100,400,900 -o rough.png
insonify materials table.toml --khz 100,200,400 -o table.png
for kind in lambert natural; do
  materials=""
  [[ $kind == lambert ]] || materials="--materials natural"
  insonify make-scene harbour --points 400000 $materials -o $kind.ply
  insonify ping $kind.ply --sonar oculus-m750d --pose=0,0,-3,10,12,0 --range 1:25 -o $kind
  insonify image $kind --size 900x700 -o harbour_$kind.png
  keep_picture harbour_$kind
done
for law in seabed small_slope rough table; do keep_picture $law; done
