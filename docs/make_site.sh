#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the site: README, the pages of docs/ and the reference of every public header, by Doxygen (Debian: doxygen). Fails for a
# warning of Doxygen and for a link or picture that leads nowhere. Takes some 20 s.
#
#   docs/make_site.sh [FOLDER]    default build/site, from where `cpack -G DEB` takes it into insonify-doc
set -euo pipefail
cd "$(dirname "$0")/.."
out=$(realpath -m "${1:-build/site}")
command -v doxygen >/dev/null || { echo "docs/make_site.sh: no doxygen; run: apt install doxygen" >&2; exit 2; }
stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT

# Headers as a user includes them, each in the group of its module; pages with links that Doxygen follows.
docs/site/stage.pl "$stage"
rm -rf "$out"
mkdir -p "$out"
sed "s|@stage@|$stage|g; s|@out@|$out|g; s|@site@|$PWD/docs/site|g" docs/site/Doxyfile >"$stage/Doxyfile"
doxygen "$stage/Doxyfile" 2>"$stage/warnings" || { cat "$stage/warnings" >&2; exit 1; }
[[ ! -s $stage/warnings ]] || { sed "s|$stage/||" "$stage/warnings" >&2; exit 1; }
cp -r docs/images "$out/images"
cp -r "$stage/files" "$out/files"
docs/site/check_links.pl "$out"
echo "$out/index.html"
