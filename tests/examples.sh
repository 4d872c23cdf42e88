#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs every command of the documentation as it stands, page by page, each in a folder that holds what apps/demo.sh makes in
# its folder out: the harbour.
#
#   tests/examples.sh TOOL PAGE...
#
# Commands are blocks between ``` lines of which one begins with "insonify "; a block after the line
# <!-- not run by tests --> is left out. Lines that open a window (insonify view without --screenshot) draw it into a file. Prints what fails.
set -euo pipefail
tool=$(realpath "$1") && shift
pages=()
for page in "$@"; do pages+=("$(realpath "$page")"); done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export PATH=$(dirname "$tool"):$PATH
insonify make-scene harbour -o "$work/harbour.ply" --points 200000 >/dev/null

failed=0 count=0
for page in "${pages[@]}"; do
  folder=$work/$(basename "$page" .md)
  mkdir -p "$folder/out"
  cp "$work/harbour.ply" "$folder/out"
  awk -v stem="$folder/block-" '
    /^```/ { if (open) { close(name); if (!commands || long) system("rm -f " name); open = long = 0 }
             else { name = sprintf("%s%03d", stem, ++n); printf "" > name; open = 1; commands = 0 } next }
    /^<!-- not run by tests -->/ { long = 1 }
    open { print > name; if ($0 ~ /^insonify /) commands = 1 }' "$page"
  cd "$folder/out"
  for block in "$folder"/block-*; do
    [[ -s $block ]] || continue
    count=$((count + 1))
    sed -i -E '/^insonify view/ { /--screenshot/! s/( *#.*)?$/ --screenshot window.png/ }' "$block"
    bash -euo pipefail "$block" >"$folder/log" 2>&1 && continue
    failed=1
    echo "$page: commands that fail:"
    sed 's/^/    /' "$block"
    echo "with"
    tail -5 "$folder/log" | sed 's/^/    /'
  done
  cd "$work"
  rm -rf "$folder"
done
echo "$count blocks of commands"
((count > 0)) || failed=1
exit $failed
