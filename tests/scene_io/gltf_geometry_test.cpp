// SPDX-License-Identifier: BSD-3-Clause
// glTF: strips, fans, instances, mirrored nodes, extensions, sparse and quantised numbers, addresses of buffers.
#include "scene_io/gltf_maker.hpp"

namespace {

/// Returns a flat strip of a width of 1 m along x: 2, 3, 4 ... corners at y = 0 and -1 in turn, whose triangles look
/// up.
std::vector<float> strip_corners(int corners) {
  std::vector<float> numbers;
  for (int i = 0; i < corners; ++i) {
    const float x = static_cast<float>(i / 2), z = i % 2 == 0 ? 0.0F : 1.0F;
    numbers.insert(numbers.end(), {x, 0, z});  // z of the file is -y here
  }
  return numbers;
}

/// Returns true if all triangles of a mesh look up.
bool looks_up(const LoadedScene& loaded) {
  for (std::size_t t = 0; t < loaded.mesh->triangle.size(); ++t) {
    const auto [a, b, c] = corners_of(*loaded.mesh, t);
    if ((b - a).cross(c - a).z() <= 0) return false;
  }
  return true;
}

}  // namespace

TEST(Gltf, strips_and_fans_are_triangles) {
  GltfMaker strip;
  strip.primitive()["attributes"]["POSITION"] = strip.add(strip_corners(10));
  strip.primitive()["mode"] = 5;
  const LoadedScene all = strip.load();
  ASSERT_TRUE(all.mesh);
  EXPECT_EQ(all.mesh->triangle.size(), 8U);
  EXPECT_NEAR(area_of_mesh(all), 4, 1e-6);
  EXPECT_TRUE(looks_up(all));
  // Two strips, joined by triangles without area.
  strip.primitive()["indices"] = strip.add(std::vector<std::uint16_t>{0, 1, 2, 3, 3, 6, 6, 7, 8, 9}, "SCALAR");
  const LoadedScene joined = strip.load();
  EXPECT_NEAR(area_of_mesh(joined), 2, 1e-6);
  EXPECT_EQ(joined.report.dropped_degenerate, 0U);
  EXPECT_TRUE(looks_up(joined));
  // The largest number of its type ends a strip.
  strip.primitive()["indices"] = strip.add(std::vector<std::uint16_t>{0, 1, 2, 3, 65535, 6, 7, 8}, "SCALAR");
  EXPECT_NEAR(area_of_mesh(strip.load()), 1.5, 1e-6);

  GltfMaker fan;
  std::vector<float> corners = {0, 0, 0};
  for (int i = 0; i <= 6; ++i)
    for (const double number : {std::cos(M_PI * i / 6), 0.0, -std::sin(M_PI * i / 6)})
      corners.push_back(static_cast<float>(number));
  fan.primitive()["attributes"]["POSITION"] = fan.add(corners);
  fan.primitive()["mode"] = 6;
  const LoadedScene half_circle = fan.load();
  EXPECT_EQ(half_circle.mesh->triangle.size(), 6U);
  EXPECT_NEAR(area_of_mesh(half_circle), 6 * 0.5 * std::sin(M_PI / 6), 1e-6);
  EXPECT_TRUE(looks_up(half_circle));
}

TEST(Gltf, instances_are_copies_of_their_mesh) {
  GltfMaker maker = square_document();
  json& attributes = maker.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes["TRANSLATION"] = maker.add(std::vector<float>{0, 0, 0, 10, 0, 0, 0, 5, 0});
  attributes["SCALE"] = maker.add(std::vector<float>{1, 1, 1, 2, 2, 2, 3, 3, -3});  // the third is a mirror image
  // A quarter turn about y, in normalised bytes: x becomes -z, which is y here.
  attributes["ROTATION"] = maker.add(std::vector<std::int8_t>{0, 0, 0, 127, 0, 90, 0, 90, 0, 0, 0, 127}, "VEC4");
  maker.root["accessors"].back()["normalized"] = true;
  maker.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  maker.root["nodes"][0]["translation"] = {0, 0, 100};
  const LoadedScene loaded = maker.load();
  EXPECT_EQ(loaded.mesh->triangle.size(), 6U);
  EXPECT_NEAR(area_of_mesh(loaded), 1 + 4 + 9, 1e-4);
  EXPECT_TRUE(looks_up(loaded));
  // The first lies at x 0..1, y -101..-100; the second at x 10..12, y -100..-98; the third at x 0..3, y -100..-97.
  Bounds box{Eigen::Vector3d::Constant(1e9), Eigen::Vector3d::Constant(-1e9)};
  for (std::size_t t = 0; t < 6; ++t)
    for (const Eigen::Vector3d& corner : corners_of(*loaded.mesh, t))
      box = {box.min.cwiseMin(loaded.mesh->origin + corner), box.max.cwiseMax(loaded.mesh->origin + corner)};
  EXPECT_LT((box.min - Eigen::Vector3d(0, -101, 0)).norm(), 1e-3) << box.min.transpose();
  EXPECT_LT((box.max - Eigen::Vector3d(12, -97, 5)).norm(), 1e-3) << box.max.transpose();
}

TEST(Gltf, mirrored_nodes_keep_the_outside_outside) {
  for (const json& scale : {json{1, 1, 1}, json{1, 1, -1}, json{-2, 1, 1}, json{-1, 1, -1}}) {
    GltfMaker maker = square_document();
    maker.root["nodes"][0]["scale"] = scale;
    EXPECT_TRUE(looks_up(maker.load())) << scale;
  }
  GltfMaker below = square_document();
  below.root["nodes"] = {{{"scale", {-1, 1, 1}}, {"children", {1}}}, {{"scale", {1, 1, -1}}, {"mesh", 0}}};
  EXPECT_TRUE(looks_up(below.load()));
}

TEST(Gltf, without_scenes_all_nodes_without_a_parent_are_read) {
  GltfMaker maker = square_document();
  maker.root.erase("scene"), maker.root.erase("scenes");
  maker.root["nodes"] = {{{"translation", {0, 2, 0}}, {"mesh", 0}}, {{"mesh", 0}}, {{"children", {0}}}};
  EXPECT_NEAR(area_of_mesh(maker.load()), 2, 1e-6);
}

TEST(Gltf, extensions_that_do_not_touch_geometry_may_be_required) {
  GltfMaker maker = square_document();
  const json names = {"KHR_materials_unlit", "KHR_texture_transform",  "EXT_texture_webp", "KHR_lights_punctual",
                      "KHR_xmp_json_ld",     "KHR_materials_variants", "ACME_paint"};
  maker.root["extensionsRequired"] = names;
  maker.root["materials"] = {{{"extensions", {{"ACME_paint", json::object()}}}}};
  maker.root["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
  maker.root["images"] = {{{"uri", "data:image/webp;base64,AAAA"}}};
  maker.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  maker.primitive()["extensions"]["KHR_materials_variants"]["mappings"] = json::array();
  EXPECT_NEAR(area_of_mesh(maker.load()), 1, 1e-6);
  EXPECT_TRUE(maker.load().report.notes.empty() || !has_note(maker.load().report, "extension"));
}

// The remedy is the same document, exported without the extension.
TEST(Gltf, extensions_of_geometry_that_are_not_read_are_named) {
  const auto refused = [](const std::string& name, const char* pointer, const std::string& remedy) {
    GltfMaker maker = square_document();
    EXPECT_NO_THROW(maker.load());
    maker.root["extensionsRequired"] = {"KHR_materials_unlit", name};
    maker.root[json::json_pointer(pointer)]["extensions"][name] = json::object();
    expect_error(ErrorKind::content, {"a.gltf", name, remedy}, [&] { maker.load(); });
  };
  const std::string off = "npx @gltf-transform/cli copy in.glb out.glb";
  refused("KHR_draco_mesh_compression", "/meshes/0/primitives/0", off);
  refused("EXT_meshopt_compression", "/bufferViews/0", off);
  refused("ACME_points", "/accessors/0", "export it again without it");
}

TEST(Gltf, sparse_and_quantised_numbers_are_read) {
  GltfMaker sparse = square_document();
  json& points = sparse.root["accessors"][0];
  const auto values = std::vector<float>{0, 0, 3, 3, 0, 3, 3, 0, 0};
  points["sparse"] = {
      {"count", 3},
      {"indices", {{"bufferView", sparse.add_view(std::vector<std::uint8_t>{1, 2, 3})}, {"componentType", 5121}}},
      {"values", {{"bufferView", sparse.add_view(values)}}}};
  EXPECT_NEAR(area_of_mesh(sparse.load()), 9, 1e-6);
  points.erase("bufferView");  // the other numbers are zero
  EXPECT_NEAR(area_of_mesh(sparse.load()), 9, 1e-6);
  points["sparse"]["count"] = 4;
  expect_error(ErrorKind::content, {"accessor 0 ends beyond its buffer view"}, [&] { sparse.load(); });
  points.erase("sparse");
  expect_error(ErrorKind::content, {"accessor 0 has no numbers"}, [&] { sparse.load(); });

  // A square of 4 m of 16 bits: 0 to 65535 is 0 to 1 if normalised, and a stride of 8 bytes pads each row.
  GltfMaker quantised = square_document();
  const std::vector<std::uint16_t> rows = {0, 0, 0, 0, 0, 0, 65535, 0, 65535, 0, 65535, 0, 65535, 0, 0, 0};
  quantised.root["accessors"][0]["bufferView"] = quantised.add_view(rows);
  quantised.root["accessors"][0]["componentType"] = 5123;
  quantised.root["accessors"][0]["normalized"] = true;
  quantised.root["bufferViews"].back()["byteStride"] = 8;
  quantised.root["nodes"][0]["scale"] = {4, 4, 4};
  quantised.root["extensionsRequired"] = {"KHR_mesh_quantization"};
  EXPECT_NEAR(area_of_mesh(quantised.load()), 16, 1e-5);
  quantised.root["accessors"][0]["normalized"] = false;
  quantised.root["nodes"][0]["scale"] = {1e-4, 1e-4, 1e-4};
  EXPECT_NEAR(area_of_mesh(quantised.load()), 6.5535 * 6.5535, 1e-4);
}

TEST(Gltf, addresses_of_buffers_are_percent_encoded) {
  GltfMaker maker = square_document();
  json document = json::parse(maker.text());
  for (const auto& [file, address] : std::vector<std::pair<std::string, std::string>>{
           {"pier head (1).bin", "pier%20head%20%281%29.bin"}, {"50%.bin", "50%25.bin"}, {"a%20b.bin", "a%20b.bin"}}) {
    own_file(file, maker.bytes);
    document["buffers"][0]["uri"] = address;
    EXPECT_NEAR(area_of_mesh(load_scene(own_file("pier.gltf", document.dump()))), 1, 1e-6) << address;
  }
}

TEST(Gltf, poses_and_morph_targets_are_left_out_with_a_note) {
  GltfMaker maker = square_document();
  EXPECT_FALSE(has_note(maker.load().report, "morph"));
  maker.primitive()["targets"] = {{{"POSITION", 0}}};
  EXPECT_TRUE(has_note(maker.load().report, "animations, skins and morph targets are left out"));
  maker.primitive().erase("targets");
  maker.root["nodes"][0]["skin"] = 0;
  EXPECT_TRUE(has_note(maker.load().report, "animations, skins and morph targets are left out"));
  EXPECT_NEAR(area_of_mesh(maker.load()), 1, 1e-6);
}
