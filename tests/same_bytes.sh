#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds tool and Python module of another commit and of this tree, makes the same runs with both, and compares the bytes
# of all files that they write. For changes that must not change a result: moves, renames, merged code.
#
#   tests/same_bytes.sh [--tools BASE_TOOL TOOL] [--work FOLDER] [BASE]
#
#   BASE           commit to compare with (HEAD: the tree before what is not committed yet)
#   --tools A B    compares two tools that are built already, with Python's modules in ../python beside their folders
#   --work FOLDER  builds BASE and runs there, and leaves it
#
# Seconds, memory and numbers of processes are left out. 0 if all is the same, 1 if not, with the names of the files.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
tools=() work="" base=HEAD
while (($#)); do
  case $1 in
    --tools) tools=("$(realpath "$2")" "$(realpath "$3")") && shift 3 ;;
    --work) work=$2 && shift 2 ;;
    -*) sed -n '3,13s/^# \{0,1\}//p' "$0" >&2 && exit 2 ;;
    *) base=$1 && shift ;;
  esac
done
if [[ -z $work ]]; then
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
fi
mkdir -p "$work" && work=$(realpath "$work")

build() { # FOLDER: prints the path of its tool
  (cd "$1" && cmake --preset release >&2 && cmake --build --preset release --target insonify _insonify _insonify_io >&2)
  echo "$1/build/release/bin/insonify"
}
if ((${#tools[@]} == 0)); then
  mkdir -p "$work/base"
  git -C "$root" archive "$base" | tar -x -C "$work/base"
  tools=("$(build "$work/base")" "$(build "$root")")
fi

box_mesh() { # an OBJ of two boxes
  awk 'BEGIN { for (b = 0; b < 2; ++b) { for (i = 0; i < 8; ++i)
      print "v", 5 + 3 * b + (i % 2), -1 + b + 2 * (int(i / 2) % 2), -4 + 2 * int(i / 4)
      split("1 3 4 2 5 6 8 7 1 2 6 5 3 7 8 4 1 5 7 3 2 4 8 6", f)
      for (i = 0; i < 6; ++i) print "f", f[4*i+1] + 8*b, f[4*i+2] + 8*b, f[4*i+3] + 8*b, f[4*i+4] + 8*b } }'
}
height_raster() { # ESRI ASCII, dunes of 30 m x 30 m
  awk 'BEGIN { printf "ncols 301\nnrows 301\nxllcorner -15\nyllcorner -15\ncellsize 0.1\nNODATA_value -9999\n"
      for (r = 0; r < 301; ++r) { for (c = 0; c < 301; ++c) printf "%.3f ", -6 + 0.3 * sin(c / 9) + 0.2 * sin((r + c) / 4); print "" } }'
}

# One run per line: its name, then its commands.
runs() {
  cat <<'RUNS'
first       insonify plan harbour.ply --sonar oculus-m750d --pose=0,0,-3,20,10,0 --range 1:30 > plan.txt; insonify ping harbour.ply --sonar oculus-m750d --pose=0,0,-3,20,10,0 --range 1:30 -o run; insonify image run --view ascan --beam 256 -o beam.png; insonify image run --view rect -o rect.png; insonify export run -o vtk
reef        insonify make-scene reef --bare -o reef.pcd; insonify prepare reef.pcd -o reef.ply --viewpoint 6,0,5; insonify ping reef.ply --sonar oculus-m750d --pose=0,0,-3,0,15,0 --range 0.5:12 -o run; insonify info reef.ply > info.txt
sea         insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,0,0 --multipath --noise --layers --set surface.height_m=0 -o run
synthesize  printf 'range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n8,0.1,0,0.05,1,0\n12,-0.2,0,0.2,0,1\n' > s.csv; insonify synthesize s.csv --sonar p900-45 --range 1:20 -o run; insonify beampattern p900-45 --steer 30 -o pattern.png
labels      insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --range 2:12 --keep contributors -o run; insonify ping --run run/run.toml --seed 2 -o other; insonify compare run other -o compared; insonify dataset run -o dataset --stuff sand
mesh        insonify ping boxes.obj --sonar oculus-m750d --pose=0,0,-3,0,0,0 --range 1:12 -o run
raster      insonify ping dunes.asc --sonar oculus-m750d --pose=0,0,-3,0,30,0 --range 1:12 -o run
tiles       insonify prepare harbour.ply -o harbour.tiles; insonify ping harbour.tiles --sonar oculus-m750d --pose=0,0,-3,20,10,0 --range 1:30 -o run
swath       insonify ping harbour.ply --sonar em2040 --pose=10,0,-1,0,0,0 --range 1:20 -o run; insonify export run --to gsf --anchor 54.1,7.9,90 -o a.gsf; insonify export run --to las --anchor 54.1,7.9,90 -o a.las; insonify export run --to mcap -o a.mcap
volume      insonify ping harbour.ply --sonar waterlinked-3d15 --pose=0,0,-3,20,10,0 --range 1:15 -o run
survey      insonify survey mission.toml -o run; insonify merge run
parts       printf 'time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,6,-3,-2,0,0,0\n6,6,3,-2,0,0,0\n' > way.csv; printf 'schema = 1\n[[part]]\nfile = "harbour.ply"\n[[part]]\nname = "box"\nfile = "boxes.obj"\ntrajectory = "way.csv"\n[[scatter]]\nfiles = ["boxes.obj"]\nnames = ["pot"]\ncount = [2, 4]\narea_m = [[4, -4], [12, -4], [12, 4], [4, 4]]\nscale = [0.1, 0.2]\n' > scene.toml; insonify ping scene.toml --sonar p900-45 --pose=0,0,-3,0,10,0 --range 2:15 --time 2 --draw 3 --keep contributors -o run; insonify image run --view scene -o scene.png
over        insonify prepare harbour.ply -o harbour.tiles; sed 's/harbour.ply/harbour.tiles/' mission.toml > over.toml; printf '[water]\nlevel_m = 0.37\n' >> over.toml; insonify survey over.toml -o run; insonify merge run
drawn       cp mission.toml drawn.toml; printf '[randomise]\nsource_level_db = 1\ntemperature_c = 2\nposition_m = 0.1\nattitude_deg = 1\n' >> drawn.toml; insonify survey drawn.toml -o run; insonify merge run
batch       /usr/bin/python3 batch.py
accuracy    insonify accuracy --methods gridded,direct --tolerances 1e-3,1e-6 --repeats 1 --no-picture -o run
RUNS
}

mission() { # two heads along two lines
  cat <<'MISSION'
schema = 1
[survey]
scene = "harbour.ply"
seed = 3
start_utc = "2026-05-01T08:30:00Z"
anchor = { latitude_deg = 54.1, longitude_deg = 7.9, heading_deg = 30 }
[trajectory]
waypoints_m = [[0, -2, -3], [8, -2, -3], [8, 2, -3]]
speed_m_s = 2
[[head]]
name = "fls"
sonar = "gemini-720im"
rate_hz = 1
range = "0.5:12"
[[head]]
name = "mb"
sonar = "em2040"
rate_hz = 1
range = "0.5:12"
MISSION
}

batch() { # pings by Python's module, with their pictures and returns as files, and one as a run
  cat <<'BATCH'
import insonify as iy
import numpy as np

head = iy.sonar("p900-45", min_range=1, max_range=12)
simulator = iy.PingSimulator(head, iy.Environment(temperature_c=8, self_db=40), noise=True)
scene = iy.load_scene("harbour.ply")
poses = [[x, 0, -3, 10 * x, 10, 0] for x in range(6)]
made = list(simulator.pings(scene, poses, threads=2, keep="contributors"))
for ping in made:
    np.save(f"{ping.number}-pressure.npy", ping.pressure)
    np.save(f"{ping.number}-soundings.npy", ping.soundings)
    np.save(f"{ping.number}-instances.npy", ping.instance_image)
    print(ping.number, ping.time, ping.seed, ping.sound_speed, ping.world_from_head.tolist(), ping.notes)
made[2].save("run")
BATCH
}

do_runs() { # TOOL FOLDER
  rm -rf "$2" && mkdir -p "$2/bin"
  ln -s "$1" "$2/bin/insonify"
  local name commands
  while read -r name commands; do
    mkdir "$2/$name" && cd "$2/$name"
    ln "$work/inputs/"* .
    PATH=$2/bin:$PATH PYTHONPATH=$(dirname "$(dirname "$1")")/python PYTHONDONTWRITEBYTECODE=1 bash -euo pipefail -c "$commands" >log 2>&1 || { echo "$name: the run fails:" && cat log && exit 1; }
  done < <(runs)
}

# A file without what differs between any two runs: seconds, memory, load and numbers of processes.
without_times() {
  case $1 in
    ./accuracy/log | ./accuracy/run/manifest.json) ;;
    ./accuracy/run/sweep.csv) cut -d, -f1-10 "$1" ;;
    */manifest.json | */status.json)
      sed -E '/"seconds": \{/,/\}/d; /"(seconds|peak_memory_mib|process)":/d' "$1" ;;
    */log) sed -E 's/ in [0-9.]+ s\b//' "$1" ;;
    *) cat "$1" ;;
  esac
}

rm -rf "$work/inputs" && mkdir -p "$work/inputs"
"${tools[0]}" make-scene harbour --points 60000 -o "$work/inputs/harbour.ply" >/dev/null
box_mesh >"$work/inputs/boxes.obj"
height_raster >"$work/inputs/dunes.asc"
mission >"$work/inputs/mission.toml"
batch >"$work/inputs/batch.py"
# Both work in a folder of the same name, one after the other.
for side in 0 1; do
  (do_runs "${tools[$side]}" "$work/runs")
  rm -rf "$work/runs$side" && mv "$work/runs" "$work/runs$side"
done
different=0 files=0
while read -r file; do
  files=$((files + 1))
  cmp -s <(cd "$work/runs0" && without_times "$file") <(cd "$work/runs1" && without_times "$file") && continue
  echo "differs: $file"
  different=1
done < <(cd "$work" && { (cd runs0 && find . -type f); (cd runs1 && find . -type f); } | sort -u)
echo "$files files of $(runs | wc -l) runs"
exit $different
