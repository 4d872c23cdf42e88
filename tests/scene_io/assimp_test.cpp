// SPDX-License-Identifier: BSD-3-Clause
// Meshes that Assimp reads, from files written here by their descriptions: units, up axes, mirrored nodes, materials.
#include <gmock/gmock.h>

#include "scene_io/load_scene.hpp"
#include "scene_io/test_files.hpp"
#include "support/files.hpp"

namespace insonify::assimp_tests {

using Eigen::Vector3d;

// A triangle in the plane x = 2, below a node that mirrors x; its outside looks to +x before and to -x after.
std::string collada(const std::string& asset) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">)" +
         asset + R"(
<library_materials><material id="m" name="steel"><instance_effect url="#e"/></material></library_materials>
<library_effects><effect id="e"><profile_COMMON><technique sid="c"><lambert/></technique></profile_COMMON></effect></library_effects>
<library_geometries><geometry id="g" name="plate"><mesh><source id="p"><float_array id="a" count="9">2 0 0 2 3 0 2 0 4</float_array>
<technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles material="s" count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="w"><node id="n"><scale>-1 1 1</scale><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="s" target="#m"/></technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#w"/></scene></COLLADA>
)";
}

std::string fbx(int up, double unit) {
  return R"(; FBX 7.3.0 project file
FBXHeaderExtension: {
 FBXHeaderVersion: 1003
 FBXVersion: 7300
}
GlobalSettings: {
 Properties70: {
  P: "UpAxis", "int", "Integer", "",)" +
         std::to_string(up) + R"(
  P: "UpAxisSign", "int", "Integer", "",1
  P: "UnitScaleFactor", "double", "Number", "",)" +
         std::to_string(unit) + R"(
 }
}
Objects: {
 Geometry: 100, "Geometry::plate", "Mesh" {
  Vertices: *9 {
   a: 2,0,0,2,3,0,2,0,4
  }
  PolygonVertexIndex: *3 {
   a: 0,1,-3
  }
 }
 Model: 200, "Model::node", "Mesh" {
  Properties70: {
   P: "Lcl Scaling", "Lcl Scaling", "", "A",-1,1,1
  }
 }
}
Connections: {
 C: "OO",200,0
 C: "OO",100,200
}
)";
}

class AssimpFile : public testing::Test {
 protected:
  void SetUp() override {
    if (scene_extensions().find(".dae") == std::string::npos) GTEST_SKIP() << "built without Assimp";
  }
  // The mesh of a file.
  static SceneMesh mesh_in(const std::string& name, const std::string& text) {
    own_file(name, text);
    return load_scene(own_path(name)).mesh.value();
  }
  // Corners of the only triangle, in the order of its winding, in the world.
  static std::array<Vector3d, 3> corners(const SceneMesh& mesh) {
    std::array<Vector3d, 3> positions;
    for (int k = 0; k < 3; ++k) positions[k] = mesh.origin + mesh.point[mesh.triangle.at(0)[k]].cast<double>();
    return positions;
  }
  static Vector3d normal(const std::array<Vector3d, 3>& c) { return (c[1] - c[0]).cross(c[2] - c[0]).normalized(); }
};

TEST_F(AssimpFile, collada_obeys_unit_up_axis_and_mirrored_nodes) {
  const std::string inches = R"(<asset><unit name="inch" meter="0.0254"/><up_axis>)";
  const auto z_up = corners(mesh_in("z.dae", collada(inches + "Z_UP</up_axis></asset>")));
  EXPECT_TRUE(z_up[0].isApprox(0.0254 * Vector3d(-2, 0, 0), 1e-6)) << z_up[0].transpose();
  EXPECT_TRUE(normal(z_up).isApprox(-Vector3d::UnitX(), 1e-6)) << "the outside stays outside";
  double height = 0;
  for (const Vector3d& c : z_up) height = std::max(height, c.z());
  EXPECT_NEAR(height, 0.0254 * 4, 1e-6);

  const auto y_up = corners(mesh_in("y.dae", collada(inches + "Y_UP</up_axis></asset>")));
  height = 0;
  for (const Vector3d& c : y_up) height = std::max(height, c.z());
  EXPECT_NEAR(height, 0.0254 * 3, 1e-6);  // y of the file
  EXPECT_TRUE(normal(y_up).isApprox(-Vector3d::UnitX(), 1e-6));
}

TEST_F(AssimpFile, fbx_obeys_unit_and_up_axis) {
  for (const int up : {1, 2}) {
    const auto c = corners(mesh_in("mesh.fbx", fbx(up, 2.54)));
    double height = 0;
    for (const Vector3d& corner : c) height = std::max(height, corner.z());
    EXPECT_NEAR(height, 0.0254 * (up == 2 ? 4 : 3), 1e-6) << up;
    EXPECT_NEAR(c[0].x(), -0.0508, 1e-6);
    EXPECT_TRUE(normal(c).isApprox(-Vector3d::UnitX(), 1e-6));
  }
  own_file("x_up.fbx", fbx(0, 1));
  expect_error(ErrorKind::content, {"x_up.fbx", "neither y nor z"}, [] { load_scene(own_path("x_up.fbx")); });
}

TEST_F(AssimpFile, materials_are_found_by_their_names) {
  own_file("steel.dae", collada("<asset/>"));
  LoadOptions options;
  options.materials = {{.name = "sand", .lambert_mu = 0.001}, {.name = "steel", .lambert_mu = 0.2}};
  const SceneCloud scene = load_scene(own_path("steel.dae"), options).scene;
  ASSERT_FALSE(scene.material.empty());
  EXPECT_EQ(scene.materials.at(scene.material[0]).name, "steel");
  EXPECT_EQ(scene.materials.at(scene.material[0]).lambert_mu, 0.2);
}

TEST_F(AssimpFile, without_names_gets_the_first_law_of_a_table) {
  LoadOptions options;
  options.materials = {{.name = "steel", .lambert_mu = 0.2}};
  const LoadedScene loaded = load_scene(own_file("a.off", "OFF\n3 1 0\n2 0 0\n2 3 0\n2 0 4\n3 0 1 2\n"), options);
  EXPECT_THAT(loaded.report.notes, testing::IsEmpty());
  EXPECT_EQ(loaded.scene.materials.at(loaded.scene.material.at(0)), options.materials[0]);
  EXPECT_EQ(load_scene(own_path("a.off")).scene.materials.at(0), Material{});
}

// Compares with a twin in OBJ, whose numbers are exact in float.
TEST_F(AssimpFile, off_and_x3d_equal_their_twins_in_obj) {
  const auto obj = corners(mesh_in("twin.obj", "v 2 0 0\nv 2 3 0\nv 2 0 4\nf 1 2 3\n"));
  const auto off = corners(mesh_in("twin.off", "OFF\n3 1 0\n2 0 0\n2 3 0\n2 0 4\n3 0 1 2\n"));
  const auto x3d = corners(mesh_in("twin.x3d", R"(<?xml version="1.0"?>
<X3D version="3.3"><Scene><Shape><IndexedFaceSet coordIndex="0 1 2 -1"><Coordinate point="2 0 0 2 3 0 2 0 4"/></IndexedFaceSet></Shape></Scene></X3D>
)"));
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(off[k], obj[k]);
    EXPECT_EQ(x3d[k], Vector3d(obj[k].x(), -obj[k].z(), obj[k].y()));  // y points up
  }
}

// A plate of steel, moved and mirrored, and one of a material without a name, used twice; with what makes no mesh.
constexpr const char* vrml_scene = R"(#VRML V2.0 utf8
DEF Clock TimeSensor { loop TRUE }  # a comment
Transform { translation 1, 2, 3 scale -1 1 1 children [
  DEF Plate Shape { appearance DEF Look Appearance { material DEF Steel'<2> Material { diffuseColor 1 0 0 } }
    geometry IndexedFaceSet { coord DEF P Coordinate { point [ 2 0 0, 2 3 0, 2 0 4 ] } coordIndex [ 0 1 2 -1 ] } }
  Script { field SFBool on TRUE url "javascript: function f(x) { return '}' }" }
  ROUTE Clock.time TO Plate.x ] }
Shape { geometry IndexedFaceSet { coord USE P coordIndex [ 0 2 1 -1 ] ccw FALSE normal Normal { vector [ 1 0 0 ] } } }
Collision { proxy Shape { geometry Box { size 100 100 100 } } children [ NULL, USE Plate ] }
LOD { range 10 level [ Anchor { children Billboard { children USE Plate } } Shape { geometry Sphere { } } ] }
)";

TEST_F(AssimpFile, vrml_equals_its_twin_in_obj_and_keeps_names_of_materials) {
  LoadOptions options;
  options.materials = {{.name = "Steel'<2>", .lambert_mu = 0.2}};
  own_file("scene.wrl", vrml_scene);
  const LoadedScene loaded = load_scene(own_path("scene.wrl"), options);
  const SceneMesh& mesh = loaded.mesh.value();
  EXPECT_EQ(loaded.report.format, "VRML mesh");
  ASSERT_EQ(mesh.triangle.size(), 4u);
  // With y up, (x, y, z) becomes (x, -z, y). The mirror exchanges the last two corners. 'ccw FALSE' turns corners over, from
  // the last to the first.
  const Vector3d plate[] = {{2, 0, 0}, {2, 0, 3}, {2, -4, 0}}, moved[] = {{-1, -3, 2}, {-1, -7, 2}, {-1, -3, 5}};
  for (int k = 0; k < 3; ++k) {
    const auto corner = [&](int t) { return Vector3d(mesh.origin + mesh.point[mesh.triangle[t][k]].cast<double>()); };
    EXPECT_EQ(corner(0), moved[k]);
    EXPECT_EQ(corner(1), plate[(k + 1) % 3]);
    EXPECT_EQ(corner(2), plate[k]);
    EXPECT_EQ(corner(3), plate[k]);
    const auto material = [&](int t) { return mesh.materials.at(mesh.material[mesh.triangle[t][k]]); };
    EXPECT_EQ(material(0).lambert_mu, 0.2);
    EXPECT_EQ(material(1), Material{});
    EXPECT_EQ(material(2), material(0));
  }
}

TEST_F(AssimpFile, x3d_with_nodes_that_are_left_out_is_noted) {
  own_file("level.x3d", R"(<?xml version="1.0"?>
<X3D version="3.3"><Scene><Shape><Box/></Shape><LOD><Shape><Box size="9 9 9"/></Shape></LOD>
<Shape><IndexedFaceSet ccw="false" coordIndex="0 1 2 -1"><Coordinate point="0 0 0 0 0 0 0 0 0"/></IndexedFaceSet></Shape></Scene></X3D>
)");
  const LoadedScene loaded = load_scene(own_path("level.x3d"));
  EXPECT_NEAR(area_of_mesh(loaded), 24, 1e-6);
  EXPECT_TRUE(has_note(loaded.report, "nodes of type LOD, and what is in them, are left out"));
  EXPECT_TRUE(has_note(loaded.report, "'ccw' is left out"));
}

TEST_F(AssimpFile, vrml_that_is_damaged_or_not_plain_is_refused) {
  const auto expect_no = [](const std::string& text, const std::string& reason) {
    own_file("bad.wrl", "#VRML V2.0 utf8\n" + text);
    expect_error(ErrorKind::content, {"bad.wrl", reason, "export it"}, [] { load_scene(own_path("bad.wrl")); });
  };
  const auto expect_line = [](const std::string& text, const std::string& reason) {
    own_file("bad.wrl", "#VRML V2.0 utf8\n" + text);
    expect_error(ErrorKind::content, {"bad.wrl:2: expected " + reason, "cut off"},
                 [] { load_scene(own_path("bad.wrl")); });
  };
  expect_no("PROTO Own [ ] { Group { } } Own { }", "nodes of type PROTO are not read");
  expect_no("Inline { url \"other.wrl\" }", "nodes of type Inline are not read");
  expect_no("Shape { geometry ElevationGrid { ccw FALSE height [ 0 ] } }",
            "nodes of type ElevationGrid with 'ccw FALSE'");
  expect_line("USE Nothing", "the name of a node before USE");
  expect_line("DEF A Group { children USE A }", "the name of a node before USE");
  expect_line("Script { { }", "'}', found ''");
  expect_line("Group [ ]", "'{', found '['");
  std::string deep;
  for (int k = 0; k < 100'000; ++k) deep += "Group { children ";
  expect_line(deep, "at most 200 nodes within each other");
  const std::string whole = vrml_scene;
  for (std::size_t length = 16; length < whole.size() - 40; length += 23) {
    own_file("cut.wrl", whole.substr(0, length));
    try {
      load_scene(own_path("cut.wrl"));
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::content) << length << error.what();
    }
  }
}

TEST_F(AssimpFile, damage_is_named_with_a_remedy) {
  own_file("cut.dae", collada("<asset/>").substr(0, 900));
  expect_error(ErrorKind::content, {"cut.dae", "cannot be read", "export it again"},
               [] { load_scene(own_path("cut.dae")); });
  own_file("empty.off", "OFF\n0 0 0\n");
  expect_error(ErrorKind::content, {"empty.off"}, [] { load_scene(own_path("empty.off")); });
  own_file("part.3mf", "PK");
  expect_error(ErrorKind::content, {"part.3mf", "cannot be read", "export it again"},
               [] { load_scene(own_path("part.3mf")); });
}

// Two parts of steel and sand, in inches; the second stands 100 inches to the side: tests/data/meshes/README.md.
TEST_F(AssimpFile, of_3mf_obeys_unit_places_and_names_of_materials) {
  const std::string path = INSONIFY_TEST_MESHES "/two_parts.3mf";
  LoadOptions options;
  options.materials = {{.name = "sand", .lambert_mu = 0.2}};
  const auto expect_parts = [&](double unit) {
    const LoadedScene loaded = load_scene(path, options);
    Vector3d low(9, 9, 9), high(-9, -9, -9);
    for (const Eigen::Vector3f& corner : loaded.mesh.value().point) {
      const Vector3d position = loaded.mesh->origin + corner.cast<double>();
      low = low.cwiseMin(position), high = high.cwiseMax(position);
    }
    EXPECT_LT(low.norm(), 1e-6) << low.transpose();
    EXPECT_LT((high - unit * Vector3d(110, 20, 30)).norm(), 1e-5 * unit) << high.transpose();
    for (std::size_t i = 0; i < loaded.scene.size(); ++i) {
      const bool side = world(loaded.scene, i).x() > unit * 50;
      EXPECT_EQ(loaded.scene.materials.at(loaded.scene.material[i]).name, side ? "sand" : "steel");
    }
  };
  options.meaning = meaning_override("unit", "m");
  expect_parts(1);
#ifdef INSONIFY_GOLDEN_RASTER
  options.meaning = {};
  expect_parts(0.0254);
#else
  options.meaning = {};
  expect_error(ErrorKind::content, {"two_parts.3mf", "give --unit mm"}, [&] { load_scene(path, options); });
#endif
}

}  // namespace insonify::assimp_tests
