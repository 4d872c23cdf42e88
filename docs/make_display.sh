#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Compares drawn display cells with means of samples on this machine, and writes the tables of docs/results/display.md and
# its picture, docs/images/display.png. It takes some two and a half hours; times are only meaningful on an idle machine.
#   docs/make_display.sh [build/release/bin]
set -euo pipefail
cd "$(dirname "$0")/.."
programs=${1:-build/release/bin}
page=docs/results/display.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for table in scenes motion paths; do
  { echo; "$programs/display_accuracy" "$table"; echo; } >"$work/$table"
done
{ echo; "$programs/display_accuracy" cells 12 "$work/display.png"; echo; } >"$work/cells"
[[ $(stat -c %s "$work/display.png") -lt 150000 ]] || { echo "make_display.sh: the picture is larger than 150 kB" >&2; exit 1; }
cp "$work/display.png" docs/images/display.png
# Each table between its two marks of the page.
awk -v work="$work" '
  /^<!-- end -->$/ { inside = 0 }
  !inside { print }
  match($0, /^<!-- made: [a-z]+ -->$/) {
    inside = 1
    file = work "/" $3
    while ((getline line < file) > 0) print line
    close(file)
  }' "$page" >"$work/page.md"
mv "$work/page.md" "$page"
echo "$page written"
