#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Presses Ctrl-C at COUNT (20) moments spread evenly over the run of each verb, and prints for every step that was met (as -v
# names it) the time until the prompt is back. Fails if that is above a second, if the exit code is not 130 (or 0, where the
# run was over), or if anything is left. The short form is tool.Interrupt.*.
#
#   tests/interrupts.sh [COUNT]
set -euo pipefail
tool=$(realpath "${INSONIFY_TOOL:-$(dirname "$0")/../build/dev/bin/insonify}")
count=${1:-20}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/files" && cd "$work/files"
head="--sonar p900-45 --pose=0,0,-3,0,10,0"
"$tool" make-scene harbour --points 1000000 -o harbour.ply -q
"$tool" ping harbour.ply $head --range 1:15 --keep contributors --no-picture -q -o run
awk 'BEGIN { for (i = 0; i < 600000; ++i) print 0.02 * (i % 800), 0.02 * int(i / 800), 0.1 * sin(0.05 * (i % 800)) }' >points.xyz
kept=$(ls -A)

now() { date +%s%N; }
# A shell starts commands in the background with SIGINT ignored; this one is as a user starts it.
start() { perl -e '$SIG{INT} = "DEFAULT"; exec @ARGV' "$tool" "$@" -v >/dev/null 2>../said & }
failed=0
printf '| verb | step | Ctrl-C | longest [s] |\n|---|---|---|---|\n'
while read -r verb made arguments; do
  # How long it takes undisturbed, at most 20 s.
  begin=$(now)
  timeout -s INT 20 "$tool" $verb $arguments -o "$made" -q >/dev/null 2>&1 || true
  whole=$(($(now) - begin))
  rm -rf "$made"
  declare -A times=() longest=()
  for ((i = 0; i < count; ++i)); do
    start $verb $arguments -o "$made"
    job=$!
    sleep "$(awk -v t=$whole -v i=$i -v n=$count 'BEGIN { printf "%.3f", 0.1 + t * 1e-9 * i / n }')"
    step=$(grep -v '^insonify: ' ../said | tail -1 | sed -E 's/ [^ ]*(\/|\.)[^ ]*//; s/\.\.\.$//' || true)
    begin=$(now)
    kill -INT "$job" 2>/dev/null || true
    code=0
    wait "$job" || code=$?
    took=$((($(now) - begin) / 1000000))
    [[ $code == 0 ]] && rm -rf "$made" && step="done"
    step=${step:-before the first}
    times[$step]=$((${times[$step]:-0} + 1))
    ((took > ${longest[$step]:-0})) && longest[$step]=$took
    if [[ $code != 0 && $code != 130 ]] || ((took > 1000)) || [[ $(ls -A) != "$kept" ]]; then
      failed=1
      echo "$verb in \"$step\": exit code $code after $took ms, files: $(ls -A | tr '\n' ' ')" >&2
    fi
  done
  for step in "${!times[@]}"; do
    printf '| %s | %s | %d | %.2f |\n' "$verb" "$step" "${times[$step]}" "$((longest[$step]))e-3"
  done | sort
  unset times longest
done <<END
ping out harbour.ply --sonar oculus-m750d --pose=0,0,-3,0,10,0 --range 0.5:40 --keep contributors,insonification
ping out harbour.ply --sonar oculus-m750d --pose=0,0,-3,0,10,0 --range 0.5:40 --method direct
prepare made.ply points.xyz
prepare made.tiles points.xyz
make-scene made.ply harbour --points 5000000
make-scene made.tiles harbour --points 5000000
merge merged run run run run run run run run
export exported run
export made.las run --to las --utm 32N
accuracy report --scene harbour.ply $head --range 1:10
END
exit $failed
