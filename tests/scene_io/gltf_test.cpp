// SPDX-License-Identifier: BSD-3-Clause
// glTF: files that assimp wrote, nodes that turn and move their meshes, and damaged documents.
#include "scene_io/gltf_maker.hpp"

namespace {

const std::string meshes = INSONIFY_TEST_MESHES;

/// Copies tests/data/meshes/wedge.* to the folder of the test.
std::string wedge_copy(const std::string& name) {
  own_file("wedge_0.bin", file_bytes(meshes + "/wedge_0.bin"));
  return own_file(name, file_bytes(meshes + "/" + name));
}

/// Returns one triangle of 1 m, under nodes that move by (10, 0, 0) and turn by 90 degrees about y.
json turned_triangle() {
  GltfMaker maker;
  maker.primitive()["attributes"]["POSITION"] = maker.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
  const double sine = std::sqrt(0.5);
  maker.root["nodes"] = {{{"translation", {10, 0, 0}}, {"children", {1}}},
                         {{"rotation", {0, sine, 0, sine}}, {"mesh", 0}}};
  return json::parse(maker.text());
}

}  // namespace

// Read as the OBJ from which it was made, but for the axis that points up: (x, y, z) of the file is (x, -z, y) here.
TEST(Gltf, of_another_program_is_the_mesh_that_it_was_given) {
  for (const char* name : {"wedge.glb", "wedge.gltf"}) {
    const LoadedScene loaded = load_scene(wedge_copy(name));
    ASSERT_TRUE(loaded.mesh) << name;
    EXPECT_EQ(loaded.report.format, "glTF mesh");
    EXPECT_EQ(loaded.mesh->triangle.size(), 8U);
    EXPECT_NEAR(area_of_mesh(loaded), 4 * 2 + 3 * 2 + 2 * 5 + 2 * 6, 1e-5);
    const Bounds box = bounds(loaded.scene);
    EXPECT_GT(box.min.x(), -1e-6);
    EXPECT_LT(box.max.x(), 4 + 1e-6);
    EXPECT_LT(box.max.y(), 3 + 1e-6);
    EXPECT_GT(box.max.y(), 2.5);
    EXPECT_GT(box.max.z(), 1.8);
    EXPECT_LT(box.max.z(), 2 + 1e-6);
  }
}

TEST(Gltf, nodes_move_and_turn_their_meshes) {
  const LoadedScene loaded = load_scene(own_file("turned.gltf", turned_triangle().dump()));
  ASSERT_TRUE(loaded.mesh);
  ASSERT_EQ(loaded.mesh->triangle.size(), 1U);
  // About y by 90 degrees: x becomes -z. Then up becomes z: corners (10, 0, 0), (10, 1, 0), (10, 0, 1).
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner : corners_of(*loaded.mesh, 0)) sum += loaded.mesh->origin + corner;
  EXPECT_LT((sum - Eigen::Vector3d(30, 1, 1)).norm(), 1e-5) << sum.transpose();
}

// Corners (10, 0, 0), (10, 1, 0), (10, 0, -1) in the axes of the file.
TEST(Gltf, another_axis_points_up_if_the_caller_says_so) {
  const std::string path = own_file("turned.gltf", turned_triangle().dump());
  for (const bool y_up : {true, false}) {
    LoadOptions options;
    options.meaning.y_up = y_up;
    const LoadedScene loaded = load_scene(path, options);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& corner : corners_of(*loaded.mesh, 0)) sum += loaded.mesh->origin + corner;
    EXPECT_LT((sum - (y_up ? Eigen::Vector3d(30, 1, 1) : Eigen::Vector3d(30, 1, -1))).norm(), 1e-5) << sum.transpose();
  }
}

TEST(Gltf, cut_off_at_any_byte_is_refused) {
  const std::string glb = file_bytes(meshes + "/wedge.glb"), text = turned_triangle().dump(),
                    bin = file_bytes(meshes + "/wedge_0.bin");
  for (std::size_t size = 0; size < glb.size(); ++size)
    expect_error(ErrorKind::content, {"cut.glb"}, [&] { load_scene(own_file("cut.glb", glb.substr(0, size))); });
  for (std::size_t size = 0; size < text.size(); ++size)
    expect_error(ErrorKind::content, {"cut.gltf"}, [&] { load_scene(own_file("cut.gltf", text.substr(0, size))); });
  const std::string wedge = wedge_copy("wedge.gltf");
  for (std::size_t size = 1; size < bin.size(); ++size) {
    own_file("wedge_0.bin", bin.substr(0, size));
    expect_error(ErrorKind::content, {"wedge.gltf", "buffer 0 announces 168 bytes"}, [&] { load_scene(wedge); });
  }
  std::filesystem::remove(own_path("wedge_0.bin"));
  expect_error(ErrorKind::file, {"wedge_0.bin"}, [&] { load_scene(wedge); });
}

TEST(Gltf, that_contradicts_itself_is_refused) {
  const auto refused = [](const char* pointer, const json& value, const std::string& part) {
    json document = turned_triangle();
    document[json::json_pointer(pointer)] = value;
    expect_error(ErrorKind::content, {"bad.gltf", part}, [&] { load_scene(own_file("bad.gltf", document.dump())); });
  };
  refused("/asset/version", "1.0", "glTF version '1.0'");
  refused("/asset/version", 2, "of another type");
  refused("/accessors/0/count", 4, "accessor 0 ends beyond its buffer view");
  refused("/accessors/0/count", -1, "'count' must be a whole number");
  refused("/accessors/0/bufferView", 7, "no entry 7 in 'bufferViews'");
  refused("/accessors/0/type", "VEC9", "accessor 0 is of type 'VEC9'");
  refused("/bufferViews/0/byteLength", 37, "buffer view 0 ends beyond its buffer");
  refused("/buffers/0/byteLength", 40, "announces 40 bytes and has 36");
  refused("/nodes/1/children", {0}, "several parents");
  refused("/nodes/1/mesh", 5, "no entry 5 in 'meshes'");
  refused("/meshes/0/primitives/0/attributes", json::object(), "no positions");
  refused("/meshes", json::array(), "no entry 0 in 'meshes'");
  expect_error(ErrorKind::content, {"text.gltf", "not a glTF document"},
               [] { load_scene(own_file("text.gltf", "v 0 0 0\n")); });
  expect_error(ErrorKind::content, {"text.glb", "expected 'glTF'"},
               [] { load_scene(own_file("text.glb", "solid of another kind")); });
}

TEST(Gltf, values_of_another_type_are_refused) {
  const auto refused = [](const char* pointer, const json& value, const std::string& part) {
    json document = turned_triangle();
    document[json::json_pointer(pointer)] = value;
    expect_error(ErrorKind::content, {"bad.gltf", part, "export it again"},
                 [&] { load_scene(own_file("bad.gltf", document.dump())); });
  };
  refused("/nodes/1/matrix", std::vector<std::string>(16, "NaN"), "of another type (");
  refused("/nodes/1/translation", {"a", "b", "c"}, "of another type (");
  refused("/nodes", 5, "'nodes' is no list");
  refused("/scenes/0/nodes", {-1}, "no entry");
  refused("/nodes/1/children", {1}, "several parents");
  std::string text = turned_triangle().dump();
  text.replace(text.find("\"rotation\":["), 12, "\"matrix\":[NaN");
  expect_error(ErrorKind::content, {"bad.gltf", "JSON cannot be read"},
               [&] { load_scene(own_file("bad.gltf", text)); });
}
