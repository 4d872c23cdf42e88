#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Measures levels of detail on this machine, error against run time, and writes tables and picture of docs/results/detail.md.
# It takes ten minutes; times are only meaningful on an otherwise idle machine. Captured scenes are no part of the project:
# without their folder, their table stays as it is.
#   docs/make_detail.sh [build/release/bin [FOLDER]]   (of office1.pcd, car6.pcd, coral_mcap_vn.obj and
#                                                       records/ship_3dsonar_frame5.pcd)
set -euo pipefail
cd "$(dirname "$0")/.."
programs=${1:-build/release/bin} captured=${2:-}
page=docs/results/detail.md picture=docs/images/detail.png
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$programs/detail_accuracy" "$work/detail.png" >"$work/tables"
# The tables of scenes, and of edges of shadows, each between two marks of the page.
awk -v edges="$work/edges" -v scenes="$work/scenes" \
  '/^\| widest node/ { out = 1; print "" > edges } { print > (out ? edges : scenes) } END { print "" > edges }' "$work/tables"
[[ -z $captured ]] || "$programs/detail_captured" "$captured" >"$work/captured"
awk -v work="$work" '
  /^<!-- end -->$/ { inside = 0 }
  !inside { print }
  match($0, /^<!-- made: [a-z]+ -->$/) {
    file = work "/" $3
    while ((getline line < file) > 0) { inside = 1; print line }
    close(file)
  }' "$page" >"$work/page.md"
[[ $(stat -c %s "$work/detail.png") -lt 150000 ]] || { echo "make_detail.sh: the picture is larger than 150 kB" >&2; exit 1; }
cp "$work/detail.png" "$picture"
mv "$work/page.md" "$page"
echo "$page written"
