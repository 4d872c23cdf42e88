#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Programs load no library from the folder in which they are called: there it may be a stranger's. Calls each in a folder
# of empty files with the names of all its libraries.
#
#   tests/tool/no_local_libraries.sh PROGRAM...
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
for program in "$@"; do
  ldd "$program" | awk '$2 == "=>" { print $1 }' | xargs touch
  "$program" --version >/dev/null
done
files=(*)
echo "${#files[@]} names of libraries, none of them loaded from here"
((${#files[@]} > 20))
