#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes small valid files of every format that is read, as FOLDER/READER/*, and for libFuzzer the words in them,
# FOLDER/READER.dict.
#
#   tests/fuzz/make_seeds.sh TOOL FOLDER
set -euo pipefail
[[ $# == 2 ]] || { sed -n '6s/^# *//p' "$0" >&2; exit 2; }
tool=$(realpath "$1") root=$(cd "$(dirname "$0")/../.." && pwd)
rm -rf "$2" && mkdir -p "$2" && cd "$2"
mkdir pcd ply obj stl vtk vtp gltf glb xyz pts ptx dae fbx off x3d wrl 3mf csv asc las laz tiff tiles sonar environment mission materials mirrors scene \
  scene.beside profile trajectory tum scatterers labels cube contributors aris xtf oculus record gsf kmall r2sonic swath npy png run levels survey work

# Formats that the tool writes.
"$tool" make-scene poles --points 40 -o ply/scene.ply -q >/dev/null
"$tool" make-scene poles --points 40 -o pcd/scene.pcd -q >/dev/null
"$tool" make-scene poles --points 40 -o tiles/scene.tiles -q >/dev/null
"$tool" make-scene poles --points 4000 -o work/poles.ply -q >/dev/null
"$tool" ping work/poles.ply --sonar p900-45 --set sonar.beams=4 --pose=0,0,0,0,0,0 --range 3:5 --layers --noise \
  --multipath --set surface.height_m=2 --keep contributors --no-picture -q -o work/run >/dev/null
cp work/run/cube.h5 cube/ && cp work/run/contributors.h5 contributors/ && cp work/run/run.toml environment/
cp work/run/run.toml sonar/ && cp work/run/run.toml run/
"$tool" image work/run --view grey -o png/eight.png -q >/dev/null
"$tool" image work/run --view grey --bits 16 -o png/sixteen.png -q >/dev/null
"$tool" export work/run --to las --utm 32N -o las/bottom.las -q >/dev/null
"$tool" export work/run --to geotiff --cell 0.05 --utm 32N -o tiff/bottom.tif -q >/dev/null
"$tool" export work/run -o work/vtk -q >/dev/null
find work/vtk -name '*.vtp' -size -64k -exec cp {} vtp/ \;
"$tool" ping work/poles.ply --sonar starfish-450 --set sonar.range_resolution_m=0.05 --pose=0,0,0,0,0,0 --range 3:5 --no-picture -q \
  -o work/side >/dev/null
"$tool" export work/side --to xtf --anchor 54,8 -o xtf/side.xtf -q >/dev/null
"$tool" export work/side --to xtf --linear --anchor 54,8 -o xtf/floats.xtf -q >/dev/null
"$tool" export work/run --to gsf --anchor 54,8 --start-utc 2026-05-01T08:30:00Z -o gsf/run.gsf -q >/dev/null
/usr/bin/python3 "$root"/tests/formats/write_swaths.py work
cp work/*.gsf gsf/ && cp work/*.kmall kmall/ && cp work/*.xtf r2sonic/ && cp gsf/run.gsf work/arrays.gsf swath/
cp "$root"/data/sonars/{p900-45,ping360,em2040}.toml sonar/
cp "$root"/data/materials.toml materials/
cp "$root"/tests/data/laz/*.laz laz/
cp "$root"/tests/data/meshes/*.3mf 3mf/

# Text, by hand.
square='0 0 0\n1 0 0\n1 1 0\n0 1 0\n'
printf "ply\nformat ascii 1.0\ncomment made\nelement vertex 4\nproperty float x\nproperty float y\nproperty double z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n${square}3 0 1 2\n3 0 2 3\n" >ply/mesh.ply
printf "# .PCD v.7\nVERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA ascii\n$square" >pcd/text.pcd
printf "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\nf -1 -2 -3\n" >obj/mesh.obj
printf "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\nendsolid a\n" >stl/text.stl
printf "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\nelement vertex 4\nproperty float x\nproperty list uchar float uv\nproperty float y\nproperty float z\nend_header\n6 0 1 3 -1 2 1\n0 1 5 0 0\n1 0 0 0\n1 0 1 0\n0 2 5 6 1 0\n" >ply/strips.ply
printf "v 0 0 0\nv 6 0 0\nv 6 5 0\nv 4 5 0\nv 4 1 0\nv 2 1 0\nv 2 5 0\nv 0 5 1\nv 3 3 0\nf 1 2 3 4 \\\\\n5 6 7 8 # slip\nf 1 1 9 5 5 6 2 3 9 4\nf 8 7 6 5 4 3 2 1\n" >obj/polygons.obj
printf " SOLID of a name\n\nFACET normal nan 0 1 outer loop\n vertex 0 0 0 vertex 1 0 0\nvertex 1 1 0\nvertex 0 1 1e9\nendloop endfacet\nend solid\n" >stl/other.stl
printf "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n${square}POLYGONS 2 8\n3 0 1 2\n3 0 2 3\nPOINT_DATA 4\nSCALARS label int 1\nLOOKUP_TABLE default\n1 2 3 4\nNORMALS n float\n0 0 1 0 0 1 0 0 1 0 0 1\nFIELD f 1\narea 1 4 float\n1 1 1 1\n" >vtk/old.vtk
printf "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n${square}TRIANGLE_STRIPS 2 4\nOFFSETS vtktypeint64\n0 4\nCONNECTIVITY vtktypeint64\n0 1 2 3\nMETADATA\nx y\n\nPOINT_DATA 4\nCOLOR_SCALARS c 2\n0 0 1 1 0 0 1 1\n" >vtk/strip.vtk
printf '<?xml version="1.0"?>\n<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">\n<PolyData>\n<Piece NumberOfPoints="4" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="1">\n<PointData><DataArray type="Int32" Name="label" NumberOfComponents="1" format="ascii">1 2 3 4</DataArray></PointData>\n<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 1 1 0 0 1 0</DataArray></Points>\n<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray><DataArray type="Int64" Name="offsets" format="ascii">4</DataArray></Polys>\n</Piece></PolyData></VTKFile>\n' >vtp/text.vtp
printf "4\n$square" >xyz/count.xyz
printf '<?xml version="1.0"?>\n<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit meter="0.0254"/><up_axis>Z_UP</up_axis></asset>\n<library_geometries><geometry id="g" name="t"><mesh><source id="p"><float_array id="a" count="9">0 0 0 1 0 0 1 1 0</float_array><technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>\n<library_visual_scenes><visual_scene id="s"><node id="n"><scale>-1 1 1</scale><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>\n' >dae/mesh.dae
printf 'OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n' >off/mesh.off
printf '<?xml version="1.0"?>\n<X3D version="3.3"><Scene><Transform translation="0 1 0"><Shape><IndexedFaceSet coordIndex="0 1 2 -1"><Coordinate point="0 0 0 1 0 0 1 1 0"/></IndexedFaceSet></Shape></Transform></Scene></X3D>\n' >x3d/mesh.x3d
printf '#VRML V2.0 utf8\nDEF A Transform { translation 0 1 0 scale -1 1 1 children [ DEF S Shape { appearance Appearance { material DEF M Material { } } geometry IndexedFaceSet { solid FALSE coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0 ] } coordIndex [ 0 1 2 -1 ] } } ] } # one\nScript { url "a" }\nCollision { proxy NULL children [ USE A USE S ] }\nROUTE A.b TO S.c\n' >wrl/mesh.wrl
printf '<?xml version="1.0"?>\n<!DOCTYPE X3D>\n<X3D><Scene><Group DEF="A"><Shape DEF="S"><Appearance DEF="L"><Material DEF="M"/></Appearance><IndexedFaceSet coordIndex="0 1 2 -1"><Coordinate point="0 0 0 1 0 0 1 1 0"/></IndexedFaceSet></Shape></Group><Transform DEF="B" translation="5 0 0"><Group/><!-- > --><Group USE="A"/><Shape USE="S"/></Transform><Switch whichChoice="0"><Transform USE="B"></Transform></Switch></Scene></X3D>\n' >x3d/groups.x3d
printf '#VRML V2.0 utf8\nDEF A Group { children Shape { geometry IndexedFaceSet { coord DEF P Coordinate { point [ 0 0 0, 1 0 0, 1 1 0 ] } coordIndex [ 0 1 2 -1 ] ccw FALSE } } }\nDEF B Transform { translation 5 0 0 children [ Group { } USE A LOD { level [ USE A USE A ] } ] }\nTransform { rotation 0 0 1 1 children [ USE B USE B ] }\n' >wrl/groups.wrl
printf '; FBX 7.3.0 project file\nFBXHeaderExtension: {\n FBXHeaderVersion: 1003\n FBXVersion: 7300\n}\nGlobalSettings: {\n Properties70: {\n  P: "UpAxis", "int", "Integer", "",2\n  P: "UnitScaleFactor", "double", "Number", "",2.54\n }\n}\nObjects: {\n Geometry: 100, "Geometry::t", "Mesh" {\n  Vertices: *9 {\n   a: 0,0,0,1,0,0,1,1,0\n  }\n  PolygonVertexIndex: *3 {\n   a: 0,1,-3\n  }\n }\n Model: 200, "Model::o", "Mesh" {\n }\n}\nConnections: {\n C: "OO",200,0\n C: "OO",100,200\n}\n' >fbx/mesh.fbx
printf "2\n0 0 0 -3 1 2 3\n1 0 0 -3 1 2 3\n2\n0 1 0 4 1 2 3\n1 1 0 4 1 2 3\n" >pts/scans.pts
scan='2\n2\n1 0 5\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 0 5 1\n0 0 -5 .5\n1 0 -5 .5\n0 0 0 .5\n1 1 -5 .5\n'
printf "$scan" >ptx/one.ptx
printf "$scan$scan" >ptx/two.ptx
printf "x y z nx ny nz area label\n0 0 0 0 0 1 .1 1\n1 0 0 0 0 1 .1 1\n1 1 0 0 0 1 .1 2\n0 1 0 0 0 1 .1 2\n" >xyz/named.xyz
printf '"x";"y";"z"\n0;0;0\n1;0;0\n1;1;0\n' >csv/quoted.csv
printf "x,y,z\n0,0,0\n1,0,0\n1,1,0\n" >csv/plain.csv
printf 'Easting (m);"Depth [ft]";Northing (m);a [b;\n1,5;2,5D0;0;1\n0;2;1;2\n1;2;3;4\n' >csv/headings.csv
printf 'x,y,z,GPS time, ,x\n0,0,0,1,2,3\n1,0,0,1,2,3\n1,1,0,1,2,3\n' >csv/names.csv
printf '# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n1 0 0 0 1 2 3 .5 1 2\n2 1 0 0 1 2 3 .5\n3 0 1 0 1 2 3 .5 1 2 3 4\n' >xyz/tracks.xyz
printf "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n-1 -1 -1\n-1 -2 -1\n-1 -1 -9999\n" >asc/grid.asc
printf "NROWS 2\nNCOLS 3\ncellsize 1\nxllcenter 0\nyllcenter 0\n-1 -1 -1\n-1 -2 -1\n" >asc/order.asc
printf "depth_m,sound_speed\n0,1500\n10,1490\n" >profile/speed.csv
printf "depth_m,temperature_c,salinity_psu\n0,10,35\n10,8,35\n" >profile/ctd.csv
printf "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,0,0,-3,0,10,0\n1,1,0,-3,5,10,0\n" >trajectory/track.csv
printf "0 0 0 -3 0 0 0 1\n1 1 0 -3 0 0 0 1\n" >tum/track.txt
printf "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n5,0,0,0.1,1,0\n" >scatterers/points.csv
printf "bearing_deg,range_m,text\n3,4,wreck\n" >labels/labels.csv
cat >environment/all.toml <<'TOML'
[water]
temperature_c = 10
salinity_psu = 35
[surface]
height_m = 0
[bottom]
height_m = -10
[wind]
speed_m_s = 8
TOML
cat >materials/two.toml <<'TOML'
schema = 1
[[material]]
name = "sand"
lambert_mu_db = -27
TOML
# All laws, and a table over angles and frequencies.
cat >materials/laws.toml <<'TOML'
schema = 1
[[material]]
name = "bed"
law = "seabed"
density_ratio = 1.8
speed_ratio = 1.2
loss = 0.016
volume_parameter = 0.002
spectral_strength_cm4 = 0.0044
spectral_exponent = 3.25
grain_mm = 0.3
[[material]]
name = "mud"
law = "small_slope"
density_ratio = 1.2
speed_ratio = 0.98
loss = 0.002
volume_parameter = 0.001
spectral_strength_cm4 = 0.0005
[[material]]
name = "hull"
law = "rough"
slope = 0.2
micro_roughness_mm = 0.1
diffuse_mu_db = -40
density = 7800
compression_speed = 5900
shear_speed = 3200
[[material]]
name = "air"
law = "rough"
slope = 0.1
reflection = 0.9
[[material]]
name = "measured"
law = "table"
incidence_deg = [0, 10, 30, 60, 89]
frequency_khz = [100, 1000]
sigma_db = [-10, -12, -20, -30, -40, -8, -10, -18, -28, -38]
bistatic = "half_vector"
TOML
cat >materials/smooth.toml <<'TOML'
schema = 1
[[material]]
name = "tiles"
like = "concrete"
mirror = true
mirror_reflection = 0.9
rms_height_m = 0.0001
relief_slope = 0
[[material]]
name = "other"
law = "table"
incidence_deg = [0, 45, 80]
sigma_db = [-10, -20, -30]
bistatic = "separable"
TOML
cat >mirrors/walls.toml <<'TOML'
[surface]
height_m = 0
[bottom]
height_m = -9
[[mirror]]
name = "quay"
place_m = [0, 3, -2]
normal = [0, -1, 0]
reflection = 0.71
rms_height_m = 0.0005
[[mirror]]
name = "plate"
place_m = [8, 0, -4]
normal = [-1, 0, 0]
size_m = [4, 3]
density_kg_m3 = 2300
pressure_speed = 4000
shear_speed = 2400
thickness_m = 0.1
[[mirror]]
name = "corners"
corners_m = [[8, -2, -5], [8, -2, -2], [3, -4, -2], [3, -4, -5]]
TOML
cat >mirrors/tank.toml <<'TOML'
[tank]
size_m = [9, 6, 5]
corner_m = [-1, -3, -5.5]
reflection = 0.7
rms_height_m = 0.0001
[[mirror]]
name = "lid"
place_m = [4, 0, -1.5]
normal = [0, 0, -1]
size_m = [1, 1]
TOML

# Scenes of parts, beside the files that they name.
cat >scene.beside/box.obj <<'OBJ'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
OBJ
perl -e 'print "x y z nx ny nz area\n";
  for my $i (0 .. 399) { printf "%g %g -5 0 0 1 .25\n", .5 * ($i % 20), .5 * int($i / 20) - 5 }' >scene.beside/bed.xyz
cp materials/two.toml scene.beside/table.toml
printf "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,5,-1,-4,0,0,0\n6,5,1,-4,90,0,0\n" >scene.beside/swim.csv
printf 'schema = 1\n[[part]]\nfile = "box.obj"\nspacing_m = 0.2\nposition_m = [0, 0, 0]\n' >scene.beside/raft.toml
cat >scene/all.toml <<'TOML'
schema = 1
[[part]]
file = "bed.xyz"
[[part]]
name = "crate"
file = "box.obj"
label = "box"
material = "steel"
spacing_m = 0.2
position_m = [5, 1]
rest = "bed"
bury_m = 0.1
yaw_deg = 30
scale = 0.5
[[part]]
name = "hangs"
file = "box.obj"
spacing_m = 0.2
thin_m = 0.1
unit = "m"
viewpoint_m = [0, 0, 0]
position_m = [6, -1, -4]
pitch_deg = 10
roll_deg = -20
velocity_mps = [0.1, 0.2, 0]
turn_deg_per_s = [0, 0, 10]
[[part]]
name = "swims"
file = "box.obj"
materials = "table.toml"
spacing_m = 0.3
trajectory = "swim.csv"
TOML
cat >scene/strewn.toml <<'TOML'
schema = 1
[[part]]
file = "bed.xyz"
[[part]]
name = "raft"
file = "raft.toml"
position_m = [4, 0, -2]
[[scatter]]
files = ["box.obj", "box.obj"]
names = ["pot", "tub"]
labels = ["pot", "tub"]
spacing_m = 0.3
count = [1, 3]
area_m = [[4, -2], [7, -2], [7, 2], [4, 2]]
min_distance_m = 0.5
yaw_deg = 180
tilt_deg = 5
bury = [0, 0.2]
scale = [0.2, 0.4]
empty_share = 0
rest = "bed"
[[scatter]]
files = ["raft.toml"]
count = 1
area_m = [[3, -2], [4, -2], [4, 2], [3, 2]]
TOML

# Binary, by hand.
perl -e '
  sub put { my ($name, $bytes) = @_; open(my $out, ">:raw", $name) or die; print $out $bytes; close $out }
  my @corner = ([0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]);
  my $floats = pack("f<*", map { @$_ } @corner);
  put("stl/binary.stl", "\0" x 80 . pack("V", 2) . (pack("f<12", 0, 0, 1, map { @$_ } @corner[0 .. 2]) . "\0\0") x 2);
  # By columns, and packed by LZF as literals alone: runs of up to 32 bytes, each behind its length less one.
  my $columns = pack("f<*", map { my $axis = $_; map { $_->[$axis] } @corner } 0 .. 2);
  my $packed = join("", map { chr(length($_) - 1) . $_ } unpack("(a32)*", $columns));
  my $head = "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4\nHEIGHT 1\nPOINTS 4\nDATA ";
  put("pcd/packed.pcd", $head . "binary_compressed\n" . pack("VV", length $packed, length $columns) . $packed);
  put("pcd/binary.pcd", $head . "binary\n" . $floats);
  put("vtk/binary.vtk", "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 4 float\n"
    . pack("f>*", map { @$_ } @corner) . "\nPOLYGONS 1 5\n" . pack("N*", 4, 0 .. 3)
    . "\nPOINT_DATA 4\nSCALARS label int 1\nLOOKUP_TABLE default\n" . pack("N*", 1 .. 4) . "\n");
  my $ply = "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    . "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  put("ply/binary.ply", $ply . pack("f>*", map { @$_ } @corner) . chr(4) . pack("N*", 0 .. 3));
  my $buffer = $floats . pack("v*", 0, 1, 2, 0, 2, 3);
  my $json = sub { sprintf(q({"asset":{"version":"2.0"},"buffers":[{%s"byteLength":60}],"bufferViews":[{"buffer":0,"byteLength":48},) .
    q({"buffer":0,"byteOffset":48,"byteLength":12}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},) .
    q({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],) .
    q("nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],"scene":0}), $_[0]) };
  use MIME::Base64;
  put("gltf/square.gltf", $json->(q("uri":"data:application/octet-stream;base64,) . encode_base64($buffer, "") . q(",)));
  my $text = $json->(""); $text .= " " while length($text) % 4;
  put("glb/square.glb", "glTF" . pack("VV", 2, 12 + 8 + length($text) + 8 + 60) . pack("V", length $text) . "JSON" . $text
    . pack("V", 60) . "BIN\0" . $buffer);
  my $more = q({"asset":{"version":"2.0"},"extensionsRequired":["KHR_materials_unlit","KHR_mesh_quantization","EXT_mesh_gpu_instancing"],) .
    q("buffers":[{"uri":"data:;base64,%s","byteLength":96}],"bufferViews":[{"buffer":0,"byteLength":24,"byteStride":6},{"buffer":0,) .
    q("byteOffset":24,"byteLength":12},{"buffer":0,"byteOffset":36,"byteLength":2},{"buffer":0,"byteOffset":40,"byteLength":6},) .
    q({"buffer":0,"byteOffset":48,"byteLength":24},{"buffer":0,"byteOffset":72,"byteLength":8}],"accessors":[{"bufferView":0,) .
    q("componentType":5122,"normalized":true,"count":4,"type":"VEC3","sparse":{"count":1,"indices":{"bufferView":2,"componentType":5121},) .
    q("values":{"bufferView":3}}},{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"},{"bufferView":4,"componentType":5126,) .
    q("count":2,"type":"VEC3"},{"bufferView":5,"componentType":5120,"normalized":true,"count":2,"type":"VEC4"}],) .
    q("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":5},{"attributes":{"POSITION":0},"mode":6}]}],) .
    q("nodes":[{"children":[1],"matrix":[1,0,0,0,0,-1,0,0,0,0,1,0,5,0,0,1]},{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":) .
    q({"attributes":{"TRANSLATION":2,"ROTATION":3}}}}]});
  put("gltf/strips.gltf", sprintf($more, encode_base64(pack("s<12 v6 C x3 s<3 x2 f<6 c8 x16", map({ 30000 * $_ } map { @$_ } @corner),
    0, 1, 3, 65535, 2, 1, 2, 9, 9, 9, 0, 0, 0, 7, 0, 0, 0, 0, 0, 127, 0, 90, 0, 90), "")));
  my $header = sprintf("%-117s\n", "{\x27descr\x27: \x27<f4\x27, \x27fortran_order\x27: False, \x27shape\x27: (3, 4), }");
  put("npy/array.npy", "\x93NUMPY\1\0" . pack("v", length $header) . $header . $floats);
  open(my $in, "<:raw", "'"$root"'/data/records/sample.aris") or die; read($in, my $record, 1 << 20); close $in;
  put("aris/sample.aris", $record);
  # The header of a record and two of its pings.
  open($in, "<:raw", "'"$root"'/data/records/sidescan_scotsman.xtf") or die; read($in, $record, 1024 + 2 * 4480); close $in;
  put("xtf/record.xtf", $record), put("record/record.xtf", $record);
  # A ping of three beams and four ranges, by itself and as an item of a log, and one of 16 bits with gains, of version 2.
  my $bearings = pack("s<3", -1000, 100, 1000);
  my $fire = sub { my ($version, $flags) = @_; pack("C5d<4", 2, 0, 0, 127, $flags, 2, 50, 0, 0) . ($version == 2 ? "\0" x 36 : "") };
  my $message = sub { my ($version, $rest) = @_; pack("v5Vv", 0x4f53, 1, 0, 0x23, $version, length $rest, 0) . $rest };
  my $one = $message->(1, $fire->(1, 25) . pack("VVd<4VCd<vvVVV", 7, 0, 2.1e6, 8, 1, 1490, 0, 0, .25, 4, 3, 128, 12, 140)
    . $bearings . pack("C*", 1 .. 12));
  my $two = $message->(2, $fire->(2, 29) . pack("VVd<8Cd<vvV4VVV", 8, 0, 2.1e6, 8, 1, 45, 2, 3, 1490, 9, 1, .25, 4, 3, 0, 0, 0, 0,
    208, 40, 248) . $bearings . join("", map { pack("f<v3", $_, 1, 2, 3) } 1 .. 4));
  put("oculus/both.raw", $one . $two);
  # The first with the flag of gains that it does not have.
  put("oculus/flag.raw", substr($one, 0, 20) . chr(29) . substr($one, 21));
  # LAS 1.4 with keys of a system in feet, WKT behind the points, extra bytes of three floats, and noise.
  my $las = sub { my ($user, $number, $body, $length) = @_; pack("va16v$length" . "x32", 0, $user, $number, length $body) . $body };
  my $keys = $las->("LASF_Projection", 34735, pack("v12", 1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 2263), "v");
  my $extra = $las->("LASF_Spec", 4, pack("vCCa32x4x72x80", 0, 29, 8, "normal"), "v");
  my $rows = join("", map { pack("l<3vCCCCvvd<f<3", 1000 * $_, 1000 * ($_ & 1), 0, 0, 0, 0, $_ == 3 ? 7 : 2, 0, 0, 0, 0, 0, 0, 1) } 0 .. 4);
  my $behind = $las->("LASF_Projection", 2112, q(LOCAL_CS["a",UNIT["foot",0.3048]]) . "\0", "Q<");
  my $start = 375 + length($keys . $extra);
  put("las/system.las", pack("a4x20CCx68vVVCvVx20d<6d<6x8Q<VQ<x120", "LASF", 1, 4, 375, $start, 2, 6, 42, 5, (.001) x 3, (0) x 3, 4, 0, 1, 0, 0, 0,
    $start + length $rows, 1, 5) . $keys . $extra . $rows . $behind);
  put("oculus/log.raw", pack("VVx40", 0x11223344, 48) . pack("VVvvx4d<vx2VVx4", 0xaabbccdd, 40, 10, 1, 0, 0, length $one, length $one) . $one);
'
"$tool" prepare csv/names.csv -o ply/names.ply -q >/dev/null
for kind in lawnmower orbit tunnel; do
  "$tool" make-mission $kind --scene x.ply -o mission/$kind.toml -q >/dev/null
done
# Tiles whose surfels merge, one of several tiles; and a survey of two blocks, whose files stand in one, each behind a line "NAME SIZE".
"$tool" make-scene plane --points 300 --size 6,6 -o levels/plane.tiles -q >/dev/null
"$tool" make-scene harbour --points 6000 -o levels/harbour.tiles -q >/dev/null
cat >work/m.toml <<'TOML'
schema = 1
[survey]
scene = "poles.ply"
[trajectory]
waypoints_m = [[0, 0, 0], [1, 0, 0]]
speed_m_s = 1
[[head]]
name = "fls"
sonar = "p900-45"
range = "3:5"
set = ["sonar.beams=4"]
rate_hz = 3
TOML
"$tool" make-scene poles --points 300 -o work/few.ply -q >/dev/null && mv work/few.ply work/poles.ply
"$tool" survey work/m.toml -o work/survey/run --pings-per-block 2 -q >/dev/null
cp work/m.toml work/poles.ply work/survey/
(cd work/survey && find . -type f -printf '%P\n' | sort | while read -r name; do
  printf '%s %d\n' "$name" "$(stat -c %s "$name")" && cat "$name"
done) >survey/run.folder
rm -r work

# Words of text and of binary formats alike.
for reader in *; do
  cat "$reader"/* | tr -c '[:alnum:]_. -' '\n' | grep -aoE '[[:alpha:]_]{2,32}' | sort -u | head -500 |
    sed 's/.*/"&"/' >"$reader.dict" || true  # a table has no words
done
