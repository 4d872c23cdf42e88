#!/usr/bin/env bash
# Times whole pings of the built-in harbour and prints a table: medians of five runs, processes as /usr/bin/time sees
# them. Takes some minutes; give it a quiet machine.
#   docs/make_speed.sh [build/release/bin]
set -euo pipefail
cd "$(dirname "$0")/.."
bin=$(realpath "${1:-build/release/bin}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$bin/insonify" make-scene harbour -o "$work/scene.ply" --points 1000000 -q >/dev/null
"$bin/insonify" prepare "$work/scene.ply" -o "$work/harbour.ply" -q >/dev/null

echo "| ping | scatterers | CPU [s] | wall [s] | peak memory [MiB] | CPU per scatterer [ns] |"
echo "|---|---|---|---|---|---|"
while read -r sonar range; do
  for _ in 1 2 3 4 5; do
    /usr/bin/time -a -o "$work/times" -f "%U %S %e %M" "$bin/insonify" ping "$work/harbour.ply" --sonar "$sonar" \
      --pose=0,0,-3,0,10,0 --range "$range" --force -q --json -o "$work/run" >"$work/manifest.json"
  done
  scatterers=$(awk -F'[:,]' '/"sampling": {/ { there = 1 } there && /"scatterers":/ { print $2 + 0; exit }' "$work/manifest.json")
  sort -n -k3 "$work/times" | awk -v name="$sonar, $range m" -v n="$scatterers" \
    'NR == 3 { printf "| %s | %d | %.2f | %.2f | %.0f | %.0f |\n", name, n, $1 + $2, $3, $4 / 1024, ($1 + $2) / n * 1e9 }'
  rm "$work/times"
done <<'PINGS'
oculus-m750d 0.5:40
oculus-m750d 0.5:16.5
p900-45 0.5:30
PINGS
