#!/usr/bin/env bash
# Installs what is missing, builds everything with warnings as errors, and runs all tests. A second run does nothing twice.
set -euo pipefail
cd "$(dirname "$0")/.."

apps/install_packages.sh --tests
cmake --preset dev >build-configure.log 2>&1 || { cat build-configure.log; exit 1; }
rm -f build-configure.log
cmake --build --preset dev
cmake --build --preset dev --target all_verify_interface_header_sets
ctest --preset dev -j "$(nproc)" "$@"
