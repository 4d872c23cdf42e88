#!/usr/bin/env bash
# Draws one picture of every sonar preset and writes docs/sonars.md with its numbers. Needs no display.
#   docs/make_sonars.sh [build/release/bin/insonify]
set -euo pipefail
cd "$(dirname "$0")/.."
tool=$(realpath "${1:-build/release/bin/insonify}")
pictures=$PWD/docs/images/sonars
page=$PWD/docs/sonars.md
data=$PWD/data/sonars

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
rm -rf "$pictures"
mkdir -p "$pictures"
cd "$work"
insonify() { "$tool" "$@" -q >/dev/null; }

# A bed with a box and a wall on it, as a mesh: every head samples it as finely as it must.
cat >bed.obj <<'OBJ'
v -12 -16 -4
v 20 -16 -4
v 20 16 -4
v -12 16 -4
f 1 2 3
f 1 3 4
v 6 -1 -4
v 7 -1 -4
v 7 1 -4
v 6 1 -4
v 6 -1 -3
v 7 -1 -3
v 7 1 -3
v 6 1 -3
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

number() { sed -n "s/^$2 = { value = \(.*\), status = .*/\1/p" "$data/$1.toml" | tr -d _; }

cat >"$page" <<'PAGE'
# Sonars

One picture of each preset over the same bed, 4 m below the head, with a box ahead and a wall to port. Imaging sonars look ahead, 20 degrees down, in one ping;
scanning heads turn once; multibeams, echo sounders and side-scans are mounted as a mission mounts them and make a line of 6 m. Range up to 10 m, or what the head reaches;
levels are compensated for range. A number is `sourced` or `derived` from a document that the file in `data/sonars` names, `assumed` or `unknown`, or `recalled`: from memory of product
literature, with no document at hand. The last column counts those that no document supports. `docs/make_sonars.sh` generates this page.

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
  rm -rf run out
  if [[ -n $mounting && $name != seaking-profiler ]]; then
    # A line along x; several beams as a ping of it, one beam as a waterfall.
    printf 'schema = 1\n[survey]\nscene = "bed.obj"\n[trajectory]\nwaypoints_m = [[0, 0, 0], [6, 0, 0]]\nspeed_m_s = 1\n[[head]]\nname = "head"\nsonar = "%s"\nrange = "%s:%s"\nevery_m = 0.2\n' \
      "$name" "$near" "$far" >line.toml
    [[ $beams == 1 ]] || sed -i 's/every_m = 0.2/every_m = 3/' line.toml
    insonify survey line.toml -o run
    insonify merge run
    view=$([[ $beams == 1 ]] && echo waterfall || echo fan)
    insonify image run/head --view "$view" $frame --title "$name" -o "$name.png"
  elif [[ $beams == 1 ]]; then
    printf 'schema = 1\n[survey]\nscene = "bed.obj"\n[trajectory]\nwaypoints_m = [[0, 0, 0], [0.5, 0, 0]]\nspeed_m_s = 0.001\n[[head]]\nname = "head"\nsonar = "%s"\nrange = "%s:%s"\n[head.scan]\nstep_deg = 3.6\nmode = "single"\n' \
      "$name" "$near" "$far" >turn.toml
    insonify survey turn.toml -o run
    insonify merge run
    insonify image run/head --view scan $frame --title "$name" -o "$name.png"
  else
    insonify ping bed.obj --sonar "$name" --pose=0,0,0,0,20,0 --range "$near:$far" --no-picture -o out
    insonify image out $frame --title "$name" -o "$name.png"
  fi
  mv "$name.png" "$pictures/"
  without=$(sed -n 's/^\([a-z_]*\) = { value = .*, status = "\(assumed\|unknown\|recalled\)".*/\1 (\2)/p' "$file" | paste -sd, | sed 's/,/, /g')
  description=$(sed -n 's/^description = "\(.*\)"/\1/p' "$file")
  printf '| ![%s](images/sonars/%s.png) | `%s`: %s | %s |\n' "$name" "$name" "$name" "$description" "${without:-none}" >>"$page"
done
