#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Tries a reader with libFuzzer for a time, address and undefined-behaviour checks on. What it finds is kept in
# build/fuzz/found/READER; a case that is mended goes to tests/fuzz/regressions/READER, which mutants.sh reads each time.
# Builds the tool, which makes the seeds, and with clang in build/fuzz what reads files; the corpus grows there.
#
#   tests/fuzz.sh READER SECONDS     (names of readers: tests/fuzz/readers.cpp)
set -euo pipefail
[[ $# == 2 ]] || { sed -n '7s/^# *//p' "$0" >&2; exit 2; }
cd "$(dirname "$0")/.."
reader=$1 seconds=$2 build=build/fuzz
command -v clang++-16 >/dev/null || {
  echo "tests/fuzz.sh installs clang-16" >&2
  $([[ $EUID == 0 ]] || echo sudo) apt-get install -y --no-install-recommends clang-16 libclang-rt-16-dev
}
if [[ ! -x ${INSONIFY_TOOL:-build/dev/bin/insonify} ]]; then
  cmake --preset dev >/dev/null && cmake --build --preset dev --target insonify
fi
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
# Readers work in this process, where libFuzzer sees them, as those of any library. GCC's name for the address
# checks says to the sources that they are on; the libraries' types have no type information.
cmake -S . -B $build -G Ninja -DCMAKE_BUILD_TYPE=Debug -DINSONIFY_VIEW=OFF -DINSONIFY_FUZZ=ON -DCMAKE_UNITY_BUILD=ON \
  -DCMAKE_C_COMPILER=clang-16 -DCMAKE_CXX_COMPILER=clang++-16 -DINSONIFY_SANITIZE=address,undefined \
  -DCMAKE_CXX_FLAGS="-O1 -fsanitize=fuzzer-no-link -fno-sanitize=vptr -D__SANITIZE_ADDRESS__=1 -include $PWD/tests/fuzz/for_clang.hpp" "${launcher[@]}" >/dev/null
cmake --build $build --target fuzz_readers -- -k 0 -j "${JOBS:-2}" >$build/log || { tail -30 $build/log >&2; exit 1; }
ln -sf fuzz_readers "$build/bin/fuzz_$reader"

[[ -d $build/seeds ]] || tests/fuzz/make_seeds.sh "${INSONIFY_TOOL:-build/dev/bin/insonify}" $build/seeds
mkdir -p "$build/corpus/$reader" "$build/found/$reader"
folders=("$build/corpus/$reader" "$build/seeds/$reader")
[[ -d tests/fuzz/regressions/$reader ]] && folders+=("tests/fuzz/regressions/$reader")
words=()  # a table of numbers has none
[[ -s $build/seeds/$reader.dict ]] && words=("-dict=$build/seeds/$reader.dict")
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=0 UBSAN_OPTIONS=print_stacktrace=1
exec "$build/bin/fuzz_$reader" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=65536 -print_final_stats=1 \
  "${words[@]}" -artifact_prefix="$build/found/$reader/" "${folders[@]}"
