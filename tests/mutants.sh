#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Reads N damaged files per reader (10 000), 250 in turn by one process, which reads by itself what has parsers that are safe,
# else by a ReaderServer, in a process for each (apart: everything, as the tool does). Fails, and keeps the file in
# build/mutants, if one ends otherwise than with 0, 2, 3, 4 or 5, takes 5 s of processor or 1 GB, or says more than one line.
#
#   tests/mutants.sh [READER|all] [N[,M]] [SEED] [apart]     (M: of readers with damage of their own, tests/fuzz/readers.cpp)
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
bin=$root/build/dev/bin
seeds=$(mktemp -d)
trap 'rm -rf "$seeds"' EXIT
"$root"/tests/fuzz/make_seeds.sh "${INSONIFY_TOOL:-$bin/insonify}" "$seeds/seeds"
mkdir -p "$root/build/mutants" && cd "$root/build/mutants"
"${INSONIFY_MUTANTS:-$bin/fuzz_mutants}" "${1:-all}" "$seeds/seeds" "$root/tests/fuzz/regressions" "${2:-10000}" "${3:-1}" ${4:+"$4"}
