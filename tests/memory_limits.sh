#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs nine verbs under limits of address space (ulimit -v): exit code 0 with the bytes of an unlimited run, or 4 with one
# line and no output; never a signal.
#
#   tests/memory_limits.sh [MIB...]     default: twenty limits, evenly spaced from 300 MiB to 3 GiB
set -euo pipefail
tool=$(realpath "${INSONIFY_TOOL:-$(dirname "$0")/../build/dev/bin/insonify}")
limits=("$@")
((${#limits[@]} > 0)) || limits=($(seq 300 146 3074))
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
head="--sonar p900-45 --pose=0,0,-3,0,10,0"
"$tool" make-scene harbour --points 50000 -o harbour.ply -q
"$tool" ping harbour.ply $head --range 1:8 -o run -q >/dev/null
awk 'BEGIN { for (i = 0; i < 40000; ++i) print 0.05 * (i % 200), 0.05 * int(i / 200), 0.1 * sin(0.05 * (i % 200)) }' >points.xyz

# What an output holds, without what a run says of its time and memory, and of pictures that it had no memory for.
digest() {
  (cd "$1" 2>/dev/null && find . -type f ! -name manifest.json ! -name '*.png' -print0 | sort -z | xargs -0 sha256sum) ||
    sha256sum <"$1"
}
failed=0 runs=0
declare -A whole=() counts=()
while read -r verb made arguments; do
  output=(-o "$made" -q)
  [[ $verb != view ]] || output=(--screenshot "$made" -q)
  [[ $verb != info ]] || output=()
  for mib in unlimited "${limits[@]}"; do
    rm -rf "$made"
    code=0
    (
      [[ $mib == unlimited ]] || ulimit -v $((1024 * mib))
      exec "$tool" $verb $arguments "${output[@]}"
    ) >said 2>error || code=$?
    if [[ $verb == info && $code == 0 ]]; then cp said "$made"; fi
    if [[ $mib == unlimited ]]; then
      ((code == 0)) || { echo "$verb: exit code $code without a limit: $(cat error)" >&2; exit 1; }
      whole[$verb]=$(digest "$made")
      continue
    fi
    runs=$((runs + 1)) counts[$code]=$((${counts[$code]:-0} + 1))
    wrong=
    case $code in
      0) [[ $(digest "$made") == "${whole[$verb]}" ]] || wrong="other bytes than without a limit" ;;
      4)
        [[ ! -e $made ]] || wrong="an output was left"
        [[ $(wc -l <error) == 1 ]] || wrong="$(wc -l <error) lines on stderr"
        ;;
      *) wrong="exit code $code" ;;
    esac
    [[ -z $wrong ]] || { failed=1; echo "$verb with $mib MiB: $wrong: $(head -c 300 error)" >&2; }
  done
  rm -rf "$made"
done <<END
info facts harbour.ply
prepare made.ply points.xyz
ping out harbour.ply $head --range 1:8
image picture.png run
export exported run
make-scene scene.ply harbour --points 50000
compare comparison run run
view screenshot.png run
merge merged run run
END
for code in "${!counts[@]}"; do echo "exit code $code: ${counts[$code]} of $runs"; done
exit $failed
