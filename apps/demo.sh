#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# From a bare Debian 12 or 13 to a sonar picture: installs what is missing, builds the tool, makes the harbour scene, looks at
# it and pings it; then builds the viewer, and names the files it wrote and what to try next. A second run installs and builds
# nothing again and replaces the demo's own files. With --python it builds Python's module, too.
set -euo pipefail
cd "$(dirname "$0")/.."

apps/install_packages.sh "$@"
cmake --preset release >build-configure.log 2>&1 || { cat build-configure.log; exit 1; }
rm -f build-configure.log
cmake --build --preset release --target insonify

mkdir -p out
insonify=build/release/bin/insonify
pose=0,0,-3,0,10,0
show() { echo "+ $*"; "$@"; echo; }
show "$insonify" make-scene harbour -o out/harbour.ply --points 200000 --force
show "$insonify" info out/harbour.ply
show "$insonify" plan out/harbour.ply --sonar oculus-m750d --pose=$pose --range 1:40
show "$insonify" ping out/harbour.ply --sonar oculus-m750d --pose=$pose --range 1:40 -o out/harbour --force
show "$insonify" image out/harbour --view fan -o out/harbour-fan.png --force

viewer=(insonify-view)
[[ ${1:-} != --python ]] || viewer+=(_insonify _insonify_io)
cmake --build --preset release --target "${viewer[@]}"
show "$insonify" view out/harbour --screenshot out/harbour-viewer.png --force

echo "insonify wrote:"
ls -1 out/harbour.ply out/harbour/* out/harbour-*.png
cat <<END

Next, for example, after: cd out; export PATH="$PWD/build/release/bin:\$PATH"
  insonify view harbour                                        # the viewer: click into the picture
  insonify image harbour --view ascan --beam 256 -o beam.png   # one beam against range
  insonify ping harbour.ply --sonar p900-45 --pose=$pose --range 1:30 --noise -o p900   # another sonar, with noise
END
