#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Draws the pictures of docs/objects.md: each object, and some of them as a sonar shows them. Needs no display.
#   docs/make_objects.sh [build/release/bin/insonify]
set -euo pipefail
cd "$(dirname "$0")/.."
. docs/picture_page.sh
begin_page objects "${1:-build/release/bin/insonify}"

for name in $("$tool" make-object | awk 'NF == 0 { exit } NR > 1 { print $1 }'); do
  area=$("$tool" make-object "$name" -o "$name.ply" --json | awk -F'[:,]' '/area_m2/ { print $2 }')
  spacing=$(awk -v area="$area" 'BEGIN { print sqrt(area / 2e6) }')
  insonify prepare "$name.ply" --mesh-spacing "$spacing" -o dense.ply --force
  insonify image dense.ply --view scene --size 480x360 --title "$name" -o "$name.png"
  keep_picture "$name"
done
