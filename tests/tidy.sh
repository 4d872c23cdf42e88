#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# clang-tidy (.clang-tidy) over modules/ and apps/, each source by itself and without precompiled headers (build/tidy).
#
#   tests/tidy.sh                   everything: 5 to 10 s of CPU a source
#   tests/tidy.sh --changed [BASE]  sources that differ from BASE, and for each header that does one source that includes
#                                   it; BASE is where this branch left origin/main, or the last commit
#   tests/tidy.sh FILE...           these sources
set -euo pipefail
cd "$(dirname "$0")/.."
tidy=$(command -v clang-tidy-14 || command -v clang-tidy) || {
  echo "tests/tidy.sh: no clang-tidy; run: apps/install_packages.sh --tidy" >&2
  exit 2
}

changed_sources() {
  local base=${1:-$(git merge-base HEAD origin/main 2>/dev/null || git rev-parse HEAD~1)} file
  git diff --name-only --diff-filter=d "$base" -- modules apps | while read -r file; do
    case $file in
      *.cpp) echo "$file" ;;
      *.hpp) grep -rlF --include=*.cpp "\"${file#*/}\"" modules apps | head -n 1 ;;
    esac
  done
}
case ${1:-} in
  "") mapfile -t sources < <(git ls-files -- 'modules/*.cpp' 'apps/*.cpp') ;;
  --changed) mapfile -t sources < <(changed_sources "${2:-}" | sort -u) ;;
  -*) sed -n '5,8s/^# \{0,1\}//p' "$0" >&2 && exit 2 ;;
  *) sources=("$@") ;;
esac
((${#sources[@]})) || { echo "tests/tidy.sh: nothing has changed"; exit 0; }

cmake --preset dev -B build/tidy -DCMAKE_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON >/dev/null 2>&1 ||
  { echo "tests/tidy.sh: cmake --preset dev fails" >&2; exit 2; }
printf '%s\0' "${sources[@]}" | xargs -0 -n 1 -P "$(nproc)" "$tidy" -p build/tidy --quiet 2> >(grep -vE "warnings? generated|^Suppressed|^Use -" >&2)
