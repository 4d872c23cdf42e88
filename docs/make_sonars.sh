#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Draws one picture of every sonar preset and writes docs/results/sonars.md with its numbers. Needs no display.
#   docs/make_sonars.sh [build/release/bin/insonify [NAME...]]     with names: draws only these again
set -euo pipefail
cd "$(dirname "$0")/.."
. docs/picture_page.sh
wanted=" ${*:2} "
begin_page sonars "${1:-build/release/bin/insonify}" $([[ $# -lt 2 ]] || echo keep)
data=$root/data/sonars

# A bed with a box and a wall on it, as a mesh: every head samples it as finely as it must.
cat >bed.obj <<'OBJ'
v -12 -16 -4
v 20 -16 -4
v 20 16 -4
v -12 16 -4
f 1 2 3
f 1 3 4
v 6 -0.5 -4
v 7 -0.5 -4
v 7 0.5 -4
v 6 0.5 -4
v 6 -0.5 -3
v 7 -0.5 -3
v 7 0.5 -3
v 6 0.5 -3
f 9 10 11
f 9 11 12
f 5 12 8
f 5 9 12
f 5 6 10
f 5 10 9
f 8 12 11
f 8 11 7
v -12 6 -4
v 12 6 -4
v 12 6 -2
v -12 6 -2
f 13 14 15
f 13 15 16
OBJ

# Narrow beams need fine surfels: side-scans get a strip of it.
sed "s|^v -12 |v 3 |; s|^v 20 |v 10 |; s|^v 12 |v 10 |" bed.obj >strip.obj

number() { sed -n "s/^$2 = { value = \(.*\), status = .*/\1/p" "$data/$1.toml" | tr -d _; }

# The row of a sonar in the page.
row() {
  local without description
  without=$(sed -n 's/^\([a-z_]*\) = { value = .*, status = "\(assumed\|unknown\|recalled\)".*/\1 (\2)/p' "$file" | paste -sd, | sed 's/,/, /g')
  description=$(sed -n 's/^description = "\(.*\)"/\1/p' "$file")
  printf '| ![%s](../images/sonars/%s.png) | `%s`: %s | %s |\n' "$name" "$name" "$name" "$description" "${without:-none}" >>"$page"
}

cat >"$page" <<'PAGE'
# Sonars

One picture of each preset over the same bed, with a box ahead and a wall to port. Imaging sonars look ahead, 20 degrees down, from a quarter of their range above the bed, in one ping;
scanning heads turn once, 1.5 m above it, and the profiler looks down on the box; multibeams, echo sounders and side-scans are mounted as a mission mounts them, 4 m above it, and make a line over the box, side-scans one of 4 m past it, over a strip of the bed. Range up to 10 m, or what the head reaches;
levels are compensated for range; resolution cells hold two scatterers at least. A number is `sourced` or `derived` from a document that the file in `data/sonars` names, `assumed` or `unknown`, or `recalled`: from memory of product
literature. A search of public documents, by model, found none for what is still `recalled`; not every number was searched for singly. The last column lists the numbers that no document supports. `docs/make_sonars.sh` generates this page.

| sonar | | of its numbers without a document |
|---|---|---|
PAGE

for file in "$data"/*.toml; do
  name=$(basename "$file" .toml)
  reach=$(number "$name" max_range_m)
  far=$(awk -v r="$reach" 'BEGIN { print r < 10 ? r : 10 }')
  near=$(number "$name" min_range_m)
  mounting=$(number "$name" mounting_deg)
  beams=$(number "$name" beams)
  frame="--size 300x260 --colormap copper"
  [[ $name != klein-3000 ]] || far=7  # its narrow beam takes 20 s a ping of 10 m
  row
  [[ $# -lt 2 || $wanted == *" $name "* ]] || continue
  rm -rf run out
  head="[[head]]\nname = \"head\"\nsonar = \"$name\"\nrange = \"$near:$far\"\n"
  if [[ $name == seaking-profiler ]]; then
    printf "schema = 1\n[ping]\nscatterers_per_cell = 2\n[survey]\nscene = \"bed.obj\"\n[trajectory]\nwaypoints_m = [[6.5, 0, 0], [7, 0, 0]]\nspeed_m_s = 0.001\n$head[head.scan]\nstart_deg = -60\nstop_deg = 60\nstep_deg = 1.2\nmode = \"single\"\n" >turn.toml
    insonify survey turn.toml -o run
    insonify merge run
    insonify image run/head --view scan $frame --title "$name" -o "$name.png"
  elif [[ -n $mounting ]]; then
    # A line along x; several beams as a ping of it, one beam as a waterfall.
    every=$([[ $beams == 1 ]] && echo 0.25 || echo 3)
    bed=bed.obj way="[[3, 0, 0], [9, 0, 0]]"
    [[ $mounting != "[90"* ]] || every=0.4 bed=strip.obj way="[[4.5, -3.5, 0], [8.5, -3.5, 0]]"
    [[ $name != klein-3000 ]] || way="[[5.3, -3.5, 0], [7.7, -3.5, 0]]"
    printf "schema = 1\n[ping]\nscatterers_per_cell = 2\n[survey]\nscene = \"$bed\"\n[trajectory]\nwaypoints_m = $way\nspeed_m_s = 1\n${head}every_m = $every\n" >line.toml
    insonify survey line.toml -o run
    insonify merge run
    view=$([[ $beams == 1 ]] && echo waterfall || echo "fan --ping 1")
    insonify image run/head --view $view $frame --title "$name" -o "$name.png"
  elif [[ $beams == 1 ]]; then
    printf "schema = 1\n[ping]\nscatterers_per_cell = 2\n[survey]\nscene = \"bed.obj\"\n[trajectory]\nwaypoints_m = [[0, 0, -2.5], [0.5, 0, -2.5]]\nspeed_m_s = 0.001\n$head[head.scan]\nstep_deg = 3.6\nmode = \"single\"\n" >turn.toml
    insonify survey turn.toml -o run
    insonify merge run
    insonify image run/head --view scan $frame --title "$name" -o "$name.png"
  else
    # The box is at six tenths of the range.
    pose=$(awk -v r="$far" 'BEGIN { print 6 - 0.6 * r ",0," r / 4 - 4 ",0,20,0" }')
    insonify ping bed.obj --sonar "$name" --pose="$pose" --range "$near:$far" --scatterers-per-cell 2 --no-picture -o out
    insonify image out $frame --title "$name" -o "$name.png"
  fi
  keep_picture "$name"
done
