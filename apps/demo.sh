#!/usr/bin/env bash
# From a bare Debian 12 to a sonar picture: installs what is missing, builds the tool, makes the harbour scene, looks at it,
# pings it, and names the files it wrote and what to try next. A second run installs and builds nothing again and replaces
# the demo's own files.
set -euo pipefail
cd "$(dirname "$0")/.."

apps/install_packages.sh
cmake --preset release >build-configure.log 2>&1 || { cat build-configure.log; exit 1; }
rm -f build-configure.log
cmake --build --preset release --target insonify  # the viewer and the tour of the API can wait

mkdir -p out
insonify=build/release/bin/insonify
pose=0,0,-3,0,10,0
show() { echo "+ $*"; "$@"; echo; }
show "$insonify" make-scene harbour -o out/harbour.ply --points 200000 --force
show "$insonify" info out/harbour.ply
show "$insonify" plan out/harbour.ply --sonar oculus-m750d --pose=$pose --range 1:40
show "$insonify" ping out/harbour.ply --sonar oculus-m750d --pose=$pose --range 1:40 -o out/harbour --force
show "$insonify" image out/harbour --view fan -o out/harbour-fan.png --force

echo "insonify wrote:"
ls -1 out/harbour.ply out/harbour/* out/harbour-fan.png
cat <<END

Next, for example:
  $insonify ping out/harbour.ply --sonar p900-45 --pose=$pose --range 1:30 --noise -o out/p900   # another sonar, with noise
  $insonify image out/harbour --view ascan --beam 256 -o out/harbour-beam.png                   # one beam against range
  cmake --build --preset release && $insonify view out/harbour                                  # the viewer
END
