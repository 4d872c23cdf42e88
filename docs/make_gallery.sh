#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Draws every view of a built-in scene and writes docs/results/gallery.md with each picture and its command. Needs no display.
#   docs/make_gallery.sh [build/release/bin/insonify]
set -euo pipefail
cd "$(dirname "$0")/.."
. docs/picture_page.sh
begin_page gallery "${1:-build/release/bin/insonify}"

# chapter TITLE TEXT
chapter() { printf '\n## %s\n\n%s\n' "$1" "$2" >>"$page"; }

cat >"$page" <<'PAGE'
# Gallery

Every view of the built-in harbour, with its command; all run in the folder `out` that `apps/demo.sh` makes. `docs/make_gallery.sh` generates this page and its pictures.
Other pages show [scenes of parts](scenes.md) (a tyre and a pot on a reef, a diver in four pings, sixteen drawn images with boxes) and [one picture of every sonar](sonars.md).
PAGE

chapter "One ping" "The harbour has a quay to port, pilings to starboard, a wreck and a pipe ahead. A 256-beam head of 900 kHz, at a depth of three metres and pitched ten degrees down, looks at the sea bed in front of the wreck."
insonify make-scene harbour -o harbour.ply --points 200000
steps "insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --range 2:20 --keep contributors,mask -o ping"
picture fan "The fan in its true geometry, starboard on the right; the three strongest maxima are named." \
  "insonify image ping --annotate 3 --size 900x700 -o fan.png"
picture rect "Bearing against range, dark theme." "insonify image ping --view rect --dark --colormap viridis --size 900x700 -o rect.png"
picture ascan "One beam: level against range." "insonify image ping --view ascan --beam 140 --size 900x500 -o ascan.png"
picture spectrum "Power spectra of all beams and of the pulse." "insonify image ping --view spectrum --size 900x500 -o spectrum.png"
picture labels "What every pixel shows, in the same place as in the fan: materials, shadow and nothing." \
  "insonify image ping --view labels -o labels.png"
picture panels "Summary of the ping on one page." "insonify image ping --view panels --size 1200x900 -o panels.png"
picture scene "The returns in the scene, with head, fan and its footprint on the bed (blue)." "insonify image ping --view scene --size 1000x750 -o scene.png"
picture viewer "The viewer (insonify view ping): a click on a pixel names the surfels behind it." \
  "insonify view ping --beam 140 --size 1400x900 --screenshot viewer.png"

chapter "Before the ping" "Visibility of a scene from a head, without simulating a ping."
picture inspect "Visible, shadowed, back-facing and outside surfels, and holes of the scan. The outline is the fan's elevation width; beyond it the pattern is weak but not zero." \
  "insonify image harbour.ply --view scene --sonar p900-45 --pose=0,0,-3,0,10,0 --range 2:20 --size 1000x750 -o inspect.png"
picture normals "Materials and normals of the scene." "insonify image harbour.ply --view scene --colour material --normals --camera iso --size 1000x750 -o normals.png"

chapter "Speckle, and the level behind it" "The expected level has no speckle: it is the mean over many realisations."
steps "insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --range 2:20 --method incoherent -o mean"
picture expected "Expected level." "insonify image mean --size 900x700 -o expected.png"

chapter "From one surface to another" "Sound that goes from quay, wreck or pilings to the bed, or back, before it returns. [Double echoes](../double-echoes.md)."
steps "insonify ping harbour.ply --sonar oculus-m750d --pose=0,0,-3,0,10,0 --range 0.5:30 --with double-echoes --layers -o double"
picture double-direct "Without them." "insonify image double --layer direct --size 700x500 -o double-direct.png"
picture double-sum "With them: less black behind quay and wreck." "insonify image double --size 700x500 -o double-sum.png"
picture double-echoes "The layer of double echoes: the foot of the quay to port and of the pilings to starboard, and ghosts of wreck and pilings behind them." \
  "insonify image double --layer double-echoes --size 700x500 -o double-echoes.png"

chapter "With the sea around it" "Echoes via surface and bottom only."
steps "insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,0,0 --range 2:20 --multipath --layers --set surface.height_m=0 -o sea"
picture multipath "The multipath layer." "insonify image sea --layer multipath --raw --size 900x700 -o multipath.png"

chapter "Ghosts in a wall" "Two pilings and a smooth wall across the view, as in Figure 22 of the thesis that this project began with. [Mirrors](../mirrors.md)."
steps "awk 'BEGIN { for (c = 0; c < 2; ++c) for (k = 0; k < 48; ++k) for (z = -6; z <= 0; z += 6) print \"v\", 20 - 4 * c + 0.15 * cos(k * 0.1309), 4 * c - 2 + 0.15 * sin(k * 0.1309), z; for (c = 0; c < 2; ++c) for (k = 0; k < 48; ++k) { a = 96 * c + 2 * k + 1; b = 96 * c + 2 * ((k + 1) % 48) + 1; print \"f\", a, b, b + 1, a + 1 } }' > pilings.obj" \
  "printf '[[mirror]]\nname = \"wall\"\nplace_m = [25, 0, 0]\nnormal = [-1, 0, 0]\nreflection = 0.71\nrms_height_m = 0.0002\n' > wall.toml" \
  "insonify ping pilings.obj --sonar m900-2250-130 --pose=0,0,-3,0,0,0 --range 5:36 --environment wall.toml --layers -o ghost"
picture ghost "Pilings at 20 m to starboard and 16 m to port, and behind the wall at 25 m their ghosts: a spot at 30 m mirrors the one at 20 m. The wall itself is the head's own image, heard through side lobes all around." \
  "insonify image ghost --annotate 1 --size 900x700 -o ghost.png"

steps "insonify make-scene sphere --points 20000 --radius 0.15 -o sphere.ply" \
  "printf '[tank]\nsize_m = [6, 4, 3]\ncorner_m = [1, -1.8, -1.4]\nreflection = 0.7\n' > tank.toml" \
  "insonify ping sphere.ply --sonar m900-2250-130 --pose=1.5,0.3,0.1,0,0,0 --range 0.5:8 --environment tank.toml -o tank"
picture tank "A sphere of 30 cm at 3.5 m in a tank of 6 x 4 x 3 m: its ghosts in walls, floor and surface, and the glints of walls and corners with their side lobes, over 70 dB." \
  "insonify image tank --size 800x600 --window 70 -o tank.png"

chapter "Many pings" "A head moves towards the quay; its pings are merged into one run."
steps "printf 'time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,0,-4,-3,0,10,0\n24,12,4,-3,20,10,0\n' > track.csv" \
  "for t in \$(seq 0 1 23); do insonify ping harbour.ply --sonar p900-45 --set sonar.beams=64 --trajectory track.csv --time \$t --range 2:20 --no-picture -o track-\$(printf %02d \$t); done" \
  "insonify merge track-* -o track"
picture waterfall "Waterfall: the strongest beam of every ping, the newest on top." \
  "insonify image track --view waterfall --beam max --size 900x700 -o waterfall.png"
printf '\n`insonify image track --animate -o frames` draws every ping with a common colour scale, as frames of a film.\n' >>"$page"

chapter "A side-scan line" "Port and starboard on the ground of a flat bottom: the wreck, pipe and boulders with their shadows, to starboard the pilings; right below, the bed is deeper than assumed. [More on surveys](../survey.md)."
steps "insonify make-mission lawnmower --scene harbour.ply --sonar starfish-450 --range 1:20 --centre 23,-5,-3.5 --size 20,0 --rate 2 -o line.toml" \
  "sed -i 's/^range/set = [\"sonar.bandwidth_hz=15000\"]\\n&/' line.toml" \
  "insonify survey line.toml -o line" "insonify merge line --mosaic 0.1"
picture side-scan "A side-scan line along the wreck." \
  "insonify image line/port --starboard line/starboard --view waterfall --altitude 4.5 --size 1000x600 -o side-scan.png"
picture track "The same line from above: the way over the mosaic of both sides." \
  "insonify image line --view track --size 900x700 -o track.png"

chapter "A swath over a slope and a step" "A bathymetric head above a slope of 45 degrees to port, a level bed, and a step of one metre to starboard. Soundings by centre of gravity and by phase, from the ping alone. [How they are found](../equations.md), E92 to E95."
steps "printf 'v %s 24 -8\nv %s 12 -20\nv %s -8 -20\nv %s -8 -19\nv %s -45 -19\n' -2 -2 -2 -2 -2 2 2 2 2 2 > groove.obj" \
  "for i in 1 2 3 4; do echo f \$i \$((i + 1)) \$((i + 6)) \$((i + 5)); done >> groove.obj" \
  "insonify ping groove.obj --sonar r2sonic-2024 --pose=0,0,0,0,0,0 --range 12:48 --split --noise --no-picture -o groove" \
  "insonify export groove --to csv -o groove.csv"
picture soundings "Soundings of one ping across the track." "insonify image groove --view soundings --size 1000x500 -o soundings.png"

chapter "A survey" "A multibeam along the wreck and a scanning head, from one mission; the viewer plays it from its blocks, merged or not."
steps "printf 'schema = 1\n[survey]\nscene = \"harbour.ply\"\n[trajectory]\nwaypoints_m = [[0, -4, -3], [18, -4, -3], [18, 5, -3]]\nspeed_m_s = 1\n[[head]]\nname = \"fls\"\nsonar = \"p900-45\"\nset = [\"sonar.beams=128\"]\nrange = \"1:15\"\npitch_deg = -15\nrate_hz = 2\n[[head]]\nname = \"turning\"\nsonar = \"ping360\"\nrange = \"0.75:15\"\n[head.scan]\nstep_deg = 5\ndwell_s = 0.2\n' > two.toml" \
  "insonify survey two.toml -o two"
picture survey "The viewer (insonify view two): the ping, head and way in the scene, a waterfall of one beam; a slider and every key have their place." \
  "insonify view two --ping 30 --beam 64 --size 1400x900 --screenshot survey.png"
picture sweep "The scanning head: the sweep as its display shows it, older where it is still to come (insonify view two --head turning)." \
  "insonify view two --head turning --ping 100 --size 1400x900 --screenshot sweep.png"

chapter "The head itself" "The directional response of its array."
picture pattern "Beam pattern." "insonify beampattern p900-45 --steer=-20 --size 900x500 -o pattern.png"

sed -i "s#$work/##g" "$page"
echo "docs/results/gallery.md written"
