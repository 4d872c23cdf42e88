#!/usr/bin/env bash
# Installs what is missing, builds everything with warnings as errors, and runs the tests whose inputs have changed since
# they last passed; with --all, all of them. Other arguments go to ctest.
set -euo pipefail
cd "$(dirname "$0")/.."

apps/install_packages.sh --tests
# Readers of MCAP by others: without npm, or out of its reach, their test is skipped.
if command -v npm >/dev/null && [[ ! -d build/npm/node_modules ]]; then
  mkdir -p build/npm && cp tests/formats/npm/package.json build/npm/
  (cd build/npm && timeout 60 npm install --no-audit --no-fund --ignore-scripts >install.log 2>&1) ||
    echo "tests/run.sh: npm cannot install the packages of tests/formats/npm; their test is skipped"
fi
cmake --preset dev >build-configure.log 2>&1 || { cat build-configure.log; exit 1; }
rm -f build-configure.log
cmake --build --preset dev --target all all_verify_interface_header_sets
tests/run_changed.pl "$@"
