#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs tests under sanitizers. The suite is in parts, each of which ends within an hour on two cores; without PART, says
# which there are. The first part of a sanitizer builds what the others use.
#
#   tests/sanitize.sh address|thread PART
set -euo pipefail
cd "$(dirname "$0")/.."
runs="EnvironmentRun|PingRun|Tiles|SideScan|MergedRuns|ExportProducts|SurveyStops|Missions|survey_killed_.*"
declare -A parts=(
  [core]="core_test files_test sonar_test scene_test sampling_test:core|files|sonar|scene|sampling"
  [sound]="acoustics_test beamforming_test returns_test:acoustics|beamforming|returns"
  [files]="tiles_test scene_io_test store_test formats_test:tiles|scene_io|store|formats"
  [pings]="simulate_test survey_test compare_test accuracy_test:simulate|survey|compare|accuracy"
  [laws]="laws_test 02_thesis:laws"
  [tool]="tool_test:tool:tool\.($runs)"
  [runs]="tool_test:tool\.($runs)"
  [docs]="insonify insonify-view:docs:docs\.commands_of_survey_work"
  [survey]="insonify insonify-view:docs\.commands_of_survey_work"
  [view]="view_test viewer_test:view|viewer"
  [python]="_insonify _insonify_io insonify:"
)
if [[ $# != 2 || -z ${parts[${2:-}]:-} || ! ${1:-} =~ ^(address|thread)$ ]]; then
  echo "usage: tests/sanitize.sh address|thread PART, of: ${!parts[*]}" >&2
  exit 2
fi
preset=asan
[[ $1 == thread ]] && preset=tsan
IFS=: read -r targets suites others <<<"${parts[$2]}"
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
[[ $2 == python ]] && launcher+=(-DINSONIFY_PYTHON=ON)
cmake --preset $preset "${launcher[@]}" >/dev/null
cmake --build --preset $preset -j "${JOBS:-2}" --target $targets
# Libraries that are not instrumented keep memory for the life of the process, and run threads of their own; a program that
# is interrupted does not wait for its threads.
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS="suppressions=$PWD/tests/support/thread_suppressions.txt history_size=4 die_after_fork=0 report_thread_leaks=0 atexit_sleep_ms=0"
# OpenMP, which PCL uses, joins its threads in ways that ThreadSanitizer does not see: none of them.
[[ $1 == thread ]] && export OMP_THREAD_LIMIT=1
started=$SECONDS
if [[ $2 == python ]]; then
  # Calls of all kinds from eight threads; Python itself is not instrumented.
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  build/$preset/bin/insonify make-scene poles --points 2000 -q -o "$work/poles.ply" >/dev/null
  build/$preset/bin/insonify prepare "$work/poles.ply" -q -o "$work/poles.tiles" >/dev/null
  LD_PRELOAD=$(c++ -print-file-name=lib$preset.so) PYTHONPATH=build/$preset/python \
    /usr/bin/python3 tests/python/mixed_calls.py "$work" "${CALLS:-6}"
  echo "tests/sanitize.sh $1 $2: clean, $((SECONDS - started)) s of calls"
  exit
fi
ctest --preset $preset -R "^($suites)(\.|\$)" -E "^(${others:-none})\$" --timeout 3000
echo "tests/sanitize.sh $1 $2: clean, $((SECONDS - started)) s of tests"
