#!/usr/bin/env bash
# Installs what is missing, builds everything with warnings as errors, and runs the tests whose inputs have changed since
# they last passed; with --all, all of them. Other arguments go to ctest.
set -euo pipefail
cd "$(dirname "$0")/.."

apps/install_packages.sh --tests
cmake --preset dev >build-configure.log 2>&1 || { cat build-configure.log; exit 1; }
rm -f build-configure.log
cmake --build --preset dev --target all all_verify_interface_header_sets
tests/run_changed.pl "$@"
