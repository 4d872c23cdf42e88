#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds with warnings as errors, and runs tests.
#
#   tests/run.sh [--full] [--all] [OPTIONS OF CTEST]
#
#   --full   also the tests with the label `long` (kills, faults, fuzzing, limits of memory, the commands of the docs), and
#            whether each public header compiles by itself: what CI runs
#   --all    also the tests whose inputs have not changed since they last passed
set -euo pipefail
cd "$(dirname "$0")/.."
targets=(all)
for argument in "$@"; do
  case $argument in
    --help | -h) sed -n '3,9s/^# \{0,1\}//p' "$0" && exit 0 ;;
    --full) targets+=(all_verify_interface_header_sets) ;;
  esac
done

apps/install_packages.sh --tests
# Readers of MCAP by others: without npm, or out of its reach, their test is skipped.
if command -v npm >/dev/null && [[ ! -d build/npm/node_modules ]]; then
  mkdir -p build/npm && cp tests/formats/npm/package.json build/npm/
  (cd build/npm && timeout 60 npm install --no-audit --no-fund --ignore-scripts >install.log 2>&1) ||
    echo "tests/run.sh: npm cannot install the packages of tests/formats/npm; their test is skipped"
fi
# Ninja configures again for what CMakeLists include; presets and packages it does not see.
made=build/dev/build.ninja
if [[ ! -e $made || CMakePresets.json -nt $made || /var/lib/dpkg/status -nt $made ]]; then
  cmake --preset dev >build-configure.log 2>&1 || { cat build-configure.log; exit 1; }
  rm -f build-configure.log
fi
cmake --build --preset dev --target "${targets[@]}"
tests/run_changed.pl "$@"
