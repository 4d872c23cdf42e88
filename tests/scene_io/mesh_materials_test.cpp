// SPDX-License-Identifier: BSD-3-Clause
// Materials of meshes by the names in their files.
#include <gmock/gmock.h>

#include "scene_io/gltf_maker.hpp"

namespace insonify::mesh_materials_tests {

/// A bed of mud at x < 1 and a plate of steel beyond; the corners between belong to both.
constexpr const char* two_materials_obj =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
    "usemtl soft mud#2 # a comment\nf 1 2 3 4\nusemtl steel\nf 2 5 6 3\n";

/// Returns a mesh of the same shape: primitives that share their points, and the materials that the first ones have.
GltfMaker two_materials_gltf(std::size_t with_material) {
  GltfMaker maker;
  json primitive = {
      {"attributes",
       {{"POSITION", maker.add(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 0, -1, 0, 0, -1, 2, 0, 0, 2, 0, -1})}}}};
  maker.root["meshes"][0]["primitives"].clear();
  maker.root["materials"] = {{{"name", "steel"}}, {{"name", "soft mud#2"}}};
  for (const std::size_t k : {0u, 1u}) {
    const std::vector<std::uint16_t> corners[] = {{0, 1, 2, 0, 2, 3}, {1, 4, 5, 1, 5, 2}};
    primitive["indices"] = maker.add(corners[k], "SCALAR");
    primitive.erase("material");
    if (k < with_material) primitive["material"] = 1 - k;
    maker.root["meshes"][0]["primitives"].push_back(primitive);
  }
  return maker;
}

LoadOptions with_table(std::vector<Material> materials) {
  LoadOptions options;
  options.materials = std::move(materials);
  return options;
}

/// Expects one material at x < 1 and another beyond, by names and laws.
void expect_sides(const LoadedScene& loaded, const Material& left, const Material& right) {
  ASSERT_FALSE(loaded.scene.material.empty());
  for (std::size_t i = 0; i < loaded.scene.size(); ++i)
    ASSERT_EQ(loaded.scene.materials.at(loaded.scene.material[i]), world(loaded.scene, i).x() < 1 ? left : right) << i;
}

const Material mud = {.name = "soft mud#2", .lambert_mu = 0.001}, steel = {.name = "steel", .lambert_mu = 0.2};

TEST(MeshMaterials, of_obj_and_gltf_get_the_laws_of_their_names) {
  const auto options = with_table({{.name = "sand", .lambert_mu = 0.5}, steel, mud});
  expect_sides(load_scene(own_file("a.obj", two_materials_obj), options), mud, steel);
  expect_sides(load_scene(own_file("a.gltf", two_materials_gltf(2).text()), options), mud, steel);
}

TEST(MeshMaterials, keep_their_names_without_a_table) {
  for (const std::string& path :
       {own_file("a.obj", two_materials_obj), own_file("a.gltf", two_materials_gltf(2).text())}) {
    const LoadedScene loaded = load_scene(path);
    EXPECT_TRUE(loaded.report.materials_found);
    expect_sides(loaded, {.name = "soft mud#2"}, {.name = "steel"});
  }
}

TEST(MeshMaterials, faces_without_one_are_of_the_default_material) {
  const std::string obj = replaced(replaced(two_materials_obj, "usemtl steel\n", ""), "f 2 5", "usemtl\nf 2 5");
  expect_sides(load_scene(own_file("a.obj", obj)), {.name = "soft mud#2"}, {});
  expect_sides(load_scene(own_file("a.gltf", two_materials_gltf(1).text())), {.name = "soft mud#2"}, {});
}

TEST(MeshMaterials, are_one_and_unnamed_in_a_file_that_names_none) {
  const std::string obj = replaced(replaced(two_materials_obj, "usemtl steel\n", ""), "usemtl soft mud#2 # a", "#");
  GltfMaker gltf = two_materials_gltf(0);
  gltf.root.erase("materials");
  for (const std::string& path : {own_file("a.obj", obj), own_file("a.gltf", gltf.text())}) {
    const LoadedScene loaded = load_scene(path, with_table({steel}));
    EXPECT_FALSE(load_scene(path).report.materials_found);
    EXPECT_TRUE(loaded.report.notes.empty()) << loaded.report.notes[0];
    expect_sides(loaded, steel, steel);
  }
}

TEST(MeshMaterials, of_a_table_without_these_names_are_taken_in_order_with_a_note) {
  const std::string path = own_file("a.obj", two_materials_obj);
  const Material sand = {.name = "sand", .lambert_mu = 0.5}, rock = {.name = "rock", .lambert_mu = 0.1};
  const LoadedScene loaded = load_scene(path, with_table({sand, rock}));
  expect_sides(loaded, sand, rock);
  EXPECT_TRUE(has_note(loaded.report, "none of the names in the file: soft mud#2, steel"))
      << testing::PrintToString(loaded.report.notes);
  expect_error(ErrorKind::content, {"a.obj", "none of the names in the file", "steel", "give laws to these names"},
               [&] { load_scene(path, with_table({sand})); });
}

TEST(MeshMaterials, of_a_gltf_that_has_not_so_many_is_refused) {
  GltfMaker gltf = two_materials_gltf(2);
  gltf.root["materials"].erase(1);
  expect_error(ErrorKind::content, {"a.gltf", "no entry 1 in 'materials'"}, [&] { gltf.load(); });
}

}  // namespace insonify::mesh_materials_tests
