#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Measures what the plan promises and writes docs/results/plan.md. Takes about a minute.
#   docs/make_plan.sh [build/release/bin]
set -euo pipefail
cd "$(dirname "$0")/.."
bin=$(realpath "${1:-build/release/bin}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# plan SCENE OPTIONS: the stages that the budget decides, one row: in, or out at its bound.
"$bin/insonify" make-scene harbour -o "$work/harbour.ply" --points 200000 -q >/dev/null
"$bin/insonify" make-scene plane -o "$work/plane.ply" --points 200000 -q >/dev/null
"$bin/insonify" make-scene plane -o "$work/deep.ply" --points 200000 --size 80,80 -q >/dev/null
plan() {
  local name=$1
  shift
  "$bin/insonify" plan "$@" --json -q | awk -v name="$name" '
    /"name":/ { gsub(/[",]/, ""); stage = $2 }
    /"by":/ { budget = /budget/ }
    /"included":/ { in_ = /true/ }
    /"bound_db":/ { gsub(/,/, ""); if (budget) row = row " | " (in_ ? "**in**" : "out") ", " ($2 == "null" ? "not known" : sprintf("%.2g dB", $2)) }
    /"left_out_db":/ { gsub(/,/, ""); left = sprintf("%.2g dB", $2) }
    END { print "| " name row " | " left " |" }'
}

{
cat <<'TEXT'
# What the plan promises

Made by [docs/make_plan.sh](../make_plan.sh); do not edit.

`--accuracy-db` (0.1) is the budget of all effects that a ping leaves out as not needed. It is shared evenly in squares, since the effects are independent: of seven
stages each may cost e / sqrt(7), e = 10^(accuracy / 20) - 1, that is 0.038 dB for 0.1 dB. A stage whose bound exceeds its share is in, every other is out.
`--with` and `--without` override it. Noise, reverberation, occlusion and the way of summing are choices and no part of the budget.

**Measure**: e is the relative L2 norm of the difference that a stage makes to the complex image, given as the level 20 log10(1 + e). The level of the
whole image cannot change by more; a cell of the image's mean power changes by about so much, a weak one by more. The last column of the first table gives the change
of total energy, which hides nearly all of it.

**Bound**: twice the error expected of a sample of the scene, pinged by the ping's own stages with mean power instead of speckle.

## Bounds and effects

Each stage forced in, against everything left out; generated scenes, shipped sonars with a part of their beams (`tests/benchmarks/accuracy/plan_suite.cpp`), split as by default. No stage
changes how the surfels of others are split (`LikeWithLike.*`), so the difference is what the stage computes. Effects below 0.005 dB count as 0.005 dB.
`PlanSuite.effects_are_below_their_bounds_and_above_a_third_of_them` fails if a bound is broken or more than three times too loose.

TEXT
"$bin/plan_table" 2>/dev/null
cat <<'TEXT'

## What a default ping lacks

The same scenes with default options and budgets of 0.1 and 1 dB, against the same ping with every stage in: the bound that the plan gives of all that is left out together, and what it is. Pings that lack nothing are left
out of the table. `PlanSuite.default_pings_are_those_with_everything_in_within_the_budget` holds the budget. True delays of planar arrays are in only if asked for, and not counted here.

TEXT
"$bin/plan_table" left-out 2>/dev/null
cat <<'TEXT'

## What is in, and why

Default options.

- **outer elevations** stay out where the scene ends before the pattern's floor, and come in where it goes on above or below the fan;
- **outer azimuths** are what side lobes receive: most where the fan is narrow, nothing where it spans the scene;
- **absorption's slope** grows with band and range: out only for narrow bands close by;
- **refraction** and **motion** turn phases at once; in wherever there is a profile or a moving head;
- **multipath** is in where pattern and pose let an echo by a boundary be received;
- **true delays** are in for nearly every line array: a band of 5 % of the carrier, or a range of a hundred lengths of the array, costs more than their share;
  those of planar arrays, which are summed row by row, in a minute for 64 rows, stay out unless asked for (`--with true-delays`).

| scene | outer elevations | outer azimuths | absorption's slope | refraction | motion | multipath | true delays | left out |
|---|---|---|---|---|---|---|---|---|
TEXT
plan "harbour, oculus-m750d" "$work/harbour.ply" --sonar oculus-m750d --pose=0,0,-3,0,10,0 --range 0.5:40
plan "harbour and surface, p900-45" "$work/harbour.ply" --sonar p900-45 --pose=0,0,-3,0,5,0 --range 2:30 --set surface.height_m=0
plan "plane, p900-45" "$work/plane.ply" --sonar p900-45 --pose=0,0,3,0,15,0 --range 4:12
plan "plane, oculus-m750d" "$work/plane.ply" --sonar oculus-m750d --pose=0,0,3,0,15,0 --range 1:12
plan "deep water, em2040" "$work/deep.ply" --sonar em2040 --pose=40,0,25,0,0,0 --range 20:40 --set water.depth_m=1000 --set water.temperature_c=3
} >"$work/plan.md"
mv "$work/plan.md" docs/results/plan.md
echo "docs/results/plan.md written"
