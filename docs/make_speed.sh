#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Times pings and surveys and prints docs/results/speed.md: cold pings as processes (/usr/bin/time), warm pings inside one process
# (tests/benchmarks/speed/ping_speed.cpp), and a survey against single calls. Takes twelve minutes; give it a quiet machine.
#   docs/make_speed.sh [build/dev/bin] > docs/results/speed.md
set -euo pipefail
cd "$(dirname "$0")/.."
bin=$(realpath "${1:-build/dev/bin}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$bin/insonify" make-scene harbour -o "$work/scene.ply" --points 1000000 -q >/dev/null
for form in ply tiles; do "$bin/insonify" prepare "$work/scene.ply" -o "$work/harbour.$form" -q >/dev/null; done

# cold_row NAME RUNS FORM ARGUMENTS: medians of so many calls of `insonify ping` with the scene in this form.
cold_row() {
  local name=$1 runs=$2 form=$3
  shift 3
  for _ in $(seq "$runs"); do
    /usr/bin/time -a -o "$work/times" -f "%U %S %e %M" "$bin/insonify" ping "$work/harbour.$form" --pose=0,0,-3,0,10,0 \
      "$@" --force -q --json -o "$work/run" >"$work/manifest.json"
  done
  local scatterers
  scatterers=$(awk -F'[:,]' '/"sampling": {/ { there = 1 } there && /"scatterers":/ { print $2 + 0; exit }' "$work/manifest.json")
  sort -n -k3 "$work/times" | awk -v name="$name" -v n="$scatterers" -v middle=$(((runs + 1) / 2)) \
    'NR == middle { printf "| %s | %d | %.2f | %.2f | %.0f |\n", name, n, $1 + $2, $3, $4 / 1024 }'
  rm "$work/times"
}

cat <<TEXT
# Speed

Made by \`docs/make_speed.sh\` on $(nproc) cores ($(awk -F': ' '/model name/ { print $2; exit }' /proc/cpuinfo)). The scene is the
built-in harbour of a million surfels, seen from 0,0,-3 with the nose 10 degrees down.

## Cold: one call of \`insonify ping\`, all outputs

Loading, sampling, synthesis, detection, cube, picture and clouds; the scene is prepared, as .ply if not said otherwise. PCL
parses a PLY value by value; tiles (\`prepare -o harbour.tiles\`) are read at the speed of memory. Medians.

| ping | scatterers | CPU [s] | wall [s] | peak memory [MiB] |
|---|---|---|---|---|
TEXT
cold_row "oculus-m750d, 0.5:40 m" 5 ply --sonar oculus-m750d --range 0.5:40
cold_row "the same, .tiles" 5 tiles --sonar oculus-m750d --range 0.5:40
cold_row "oculus-m750d, 0.5:16.5 m" 5 ply --sonar oculus-m750d --range 0.5:16.5
cold_row "the same, unsplit" 11 ply --sonar oculus-m750d --range 0.5:16.5 --scatterers-per-cell 0
cold_row "the same, unsplit, .tiles" 11 tiles --sonar oculus-m750d --range 0.5:16.5 --scatterers-per-cell 0
cold_row "p900-45, 0.5:30 m" 5 ply --sonar p900-45 --range 0.5:30
cold_row "waterlinked-3d15, 0.3:15 m" 1 ply --sonar waterlinked-3d15
cat <<TEXT

## Warm: pings of a scene in memory

\`ping_speed work\`: \`simulate_ping\` with detections, without files and picture, what forms the beams kept from the ping before; medians of five, of eleven that take less than 200 ms, or one ping if it takes more than a second.

TEXT
"$bin/ping_speed" work
"$bin/insonify" make-mission lawnmower --scene "$work/harbour.ply" --range 0.5:10 --size 10,4 --spacing 4 --rate 5 \
  --speed 0.5 -o "$work/mission.toml" >/dev/null
/usr/bin/time -o "$work/survey" -f "%U %S %e %M" "$bin/insonify" survey "$work/mission.toml" -o "$work/survey-run" -q --json >"$work/survey.json"
pings=$(awk -F'[:,]' '/"made":/ { print $2 + 0; exit }' "$work/survey.json")
cat <<TEXT

## A survey against single calls

$pings pings of gemini-720im, 0.5:10 m, moving at 0.5 m/s: one call of \`insonify survey\`, and single calls of \`insonify ping\` (median of five).

| | CPU per ping [s] | wall per ping [s] | peak memory [MiB] |
|---|---|---|---|
TEXT
awk -v n="$pings" '{ printf "| survey | %.3f | %.3f | %.0f |\n", ($1 + $2) / n, $3 / n, $4 / 1024 }' "$work/survey"
cold_row "ping" 5 ply --sonar gemini-720im --range 0.5:10 --velocity 0.5,0,0 | awk -F'|' '{ printf "| ping |%s|%s|%s|\n", $4, $5, $6 }'
cat <<TEXT

## Real time

\`ping_speed presets\`: every preset at its range, at most 30 m, on harbour and plane of 300 000 surfels, warm, with detections, on all cores. The own rate of a sonar is
taken to be the smaller of 10 Hz and c / 2 r_max; a real-time factor above 1 means pings are simulated faster than the sonar makes them.

TEXT
"$bin/ping_speed" presets
cat <<TEXT

## Real time as display images

\`ping_speed display\`: the same presets as images of 600 cells with noise (\`--display 600 --noise\`), on the harbour. Each preset is timed in five
rounds, which are minutes apart: the median of their medians.

TEXT
"$bin/ping_speed" display
