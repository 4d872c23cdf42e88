#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Draws scenes of parts and writes docs/results/scenes.md with each picture and its command. Needs no display.
#   docs/make_scenes.sh [build/release/bin/insonify]
set -euo pipefail
cd "$(dirname "$0")/.."
. docs/picture_page.sh
begin_page scenes "${1:-build/release/bin/insonify}"

# file NAME: writes what is on standard input to a file, and lists it.
file() {
  cat >"$1"
  printf '\n`%s`:\n\n```toml\n' "$1" >>"$page"
  cat "$1" >>"$page"
  printf '```\n' >>"$page"
}

cat >"$page" <<'PAGE'
# Scenes of parts, in pictures

Bodies on the built-in reef ([scenes.md](../scenes.md)): placed, in motion, and drawn anew for each ping. `docs/make_scenes.sh` generates this page and its pictures.

## A drum and a pot on a reef
PAGE
steps "insonify make-scene reef -o reef.ply" "insonify make-object drum -o drum.ply" "insonify make-object crab-pot -o pot.ply" \
  "insonify make-object diver -o diver.ply"
file scene.toml <<'SCENE'
schema = 1
[[part]]
file = "reef.ply"
[[part]]
name = "drum"
file = "drum.ply"
position_m = [4.6, 0.6]
rest = "bed"
bury_m = 0.1
yaw_deg = 60
[[part]]
name = "pot"
file = "pot.ply"
position_m = [5.5, -1.0]
SCENE
picture parts "The parts where they rest." "insonify image scene.toml --view scene --colour part --camera iso --size 900x650 -o parts.png"
steps "insonify ping scene.toml --sonar oculus-m750d --pose=-0.5,0,-2.2,0,18,0 --range 0.5:10 --keep contributors -o ping"
picture fan "What an Oculus hears of them: the drum ahead, and the pot to starboard behind it." "insonify image ping --size 900x650 -o fan.png"
picture labels "What every pixel shows." "insonify image ping --view labels -o labels.png"

printf '\n## A diver who crosses the fan\n' >>"$page"
file dive.toml <<'SCENE'
schema = 1
[[part]]
file = "reef.ply"
[[part]]
name = "diver"
file = "diver.ply"
position_m = [3.4, 2.4, -3.0]
yaw_deg = -90
velocity_mps = [0, -0.8, 0]
SCENE
for time in 0 2 4 6; do
  picture "dive-$time" "After $time s." \
    "insonify ping dive.toml --time $time --sonar oculus-m750d --pose=-0.5,0,-2.4,0,10,0 --range 1:7 -o dive-$time && insonify image dive-$time --size 600x450 -o dive-$time.png"
done

printf '\n## A data set, drawn anew for each ping\n' >>"$page"
file strewn.toml <<'SCENE'
schema = 1
[[part]]
file = "reef.ply"
[[scatter]]
files = ["drum.ply", "pot.ply"]
count = [1, 4]
area_m = [[2.5, -3], [7, -3], [7, 3], [2.5, 3]]
min_distance_m = 1.2
yaw_deg = 180
rest = "bed"
bury = [0, 0.3]
empty_share = 0.1
SCENE
file mission.toml <<'SCENE'
schema = 1
[survey]
scene = "strewn.toml"
seed = 5
[trajectory]
waypoints_m = [[-1.5, 0, -2.2], [0.1, 0, -2.2]]
speed_m_s = 0.1
[[head]]
name = "fls"
sonar = "oculus-m750d"
set = ["sonar.beams=256"]
range = "1:8"
pitch_deg = -18
rate_hz = 1
[randomise]
scene = "ping"
position_m = 0.3
heading_deg = 8
[ping]
scatterers_per_cell = 2
keep = ["contributors"]
SCENE
steps "insonify survey mission.toml -o survey" \
  "insonify dataset survey -o set --stuff coral_sand,reef_rock,coral --split 100:0:0 --least-pixels 60"
picture sheet "Its sheet: boxes of drums and pots, in the colours of their classes." "cp set/sheet.png sheet.png"
sed -i "s#$work/##g" "$page"
echo "docs/results/scenes.md written"
