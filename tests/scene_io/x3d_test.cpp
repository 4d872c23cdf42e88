// SPDX-License-Identifier: BSD-3-Clause
// Groups of X3D and VRML that are empty or used again, which Assimp by itself misplaces, and the names of their materials.
#include <gmock/gmock.h>

#include "scene_io/load_scene.hpp"
#include "scene_io/test_files.hpp"
#include "support/files.hpp"

namespace insonify::x3d_tests {

class X3dFile : public testing::Test {
 protected:
  void SetUp() override {
    if (scene_extensions().find(".x3d") == std::string::npos) GTEST_SKIP() << "built without Assimp";
  }
};

/// Returns the first corner of each triangle, in the order of the file, in its axes.
std::vector<Eigen::Vector3d> places(const LoadedScene& loaded) {
  const SceneMesh& mesh = loaded.mesh.value();
  std::vector<Eigen::Vector3d> all;
  for (const auto& triangle : mesh.triangle) {
    const Eigen::Vector3d p = mesh.origin + mesh.point[triangle[0]].cast<double>();
    all.emplace_back(p.x(), p.z(), -p.y());
  }
  return all;
}

std::vector<Eigen::Vector3d> places_in(const std::string& name, const std::string& body) {
  const bool vrml = name.ends_with(".wrl");
  own_file(name, (vrml ? "#VRML V2.0 utf8\n" : "<?xml version='1.0'?>\n<!DOCTYPE X3D>\n<X3D><Scene>") + body +
                     (vrml ? "" : "</Scene></X3D>\n"));
  return places(load_scene(own_path(name)));
}

const std::string vrml_plate =
    "DEF Plate Group { children Shape { geometry IndexedFaceSet {"
    " coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0 ] } coordIndex [ 0 1 2 -1 ] } } }\n";
const std::string x3d_plate =
    "<Group DEF='Plate'><Shape><IndexedFaceSet coordIndex='0 1 2 -1'>"
    "<Coordinate point='0 0 0 1 0 0 1 1 0'/></IndexedFaceSet></Shape></Group>\n";
const std::vector<Eigen::Vector3d> three_plates = {{0, 0, 0}, {5, 0, 0}, {5, 0, 0}};

TEST_F(X3dFile, what_follows_a_group_that_is_used_again_stays_in_its_place) {
  EXPECT_EQ(places_in("twice.wrl", vrml_plate + "Transform { translation 5 0 0 children [ USE Plate USE Plate ] }"),
            three_plates);
  const std::string begin = x3d_plate + "<Transform translation='5 0 0'>", end = "</Transform>";
  EXPECT_EQ(places_in("twice.x3d", begin + "<Group USE='Plate'/><Group USE=\"Plate\"> </Group>" + end), three_plates);
}

TEST_F(X3dFile, what_follows_an_empty_group_stays_in_its_place) {
  const std::vector<Eigen::Vector3d> two = {{0, 0, 0}, {5, 0, 0}};
  EXPECT_EQ(places_in("none.wrl", vrml_plate + "Transform { translation 5 0 0 children [ Group { } USE Plate ] }"),
            two);
  for (const char* empty : {"<Group/>", "<Transform scale='2 2 2'></Transform>", "<StaticGroup> </StaticGroup>",
                            "<Switch whichChoice='0'/>", "<Group><!-- > nothing <Group> --></Group>",
                            "<Transform\n translation = '1 1 1' />"})
    EXPECT_EQ(places_in("none.x3d",
                        x3d_plate + "<Transform translation='5 0 0'>" + empty + "<Group USE='Plate'/></Transform>"),
              two)
        << empty;
}

TEST_F(X3dFile, groups_of_groups_that_are_used_again_are_whole) {
  const std::vector<Eigen::Vector3d> all = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 9, 0}, {2, 9, 0}, {0, 0, 7}};
  EXPECT_EQ(places_in("nested.wrl", vrml_plate + R"(DEF Pair Group { children [
  Transform { translation 1 0 0 children USE Plate } Transform { translation 2 0 0 children USE Plate } ] }
Transform { translation 0 9 0 children USE Pair }
Transform { translation 0 0 7 children LOD { level [ USE Plate USE Pair ] } }
)"),
            all);
  EXPECT_EQ(places_in("nested.x3d", x3d_plate + R"(<Group DEF='Pair'>
  <Transform translation='1 0 0'><Group USE='Plate'/></Transform><Transform translation='2 0 0'><Group USE='Plate'/></Transform></Group>
<Transform translation='0 9 0'><Group USE='Pair'/></Transform>
<Transform translation='0 0 7'><Switch whichChoice='1'><Group/><Group USE='Plate'/><Group USE='Pair'/></Switch></Transform>
)"),
            all);
}

TEST_F(X3dFile, x3d_keeps_names_of_materials) {
  const auto shape = [](const std::string& looks) {
    return "<Shape>" + looks +
           "<IndexedFaceSet coordIndex='0 1 2 -1'><Coordinate point='0 0 0 1 0 0 1 1 0'/></IndexedFaceSet></Shape>";
  };
  own_file("named.x3d", "<X3D><Scene>" + shape("<Appearance DEF='Look'><Material DEF=\"Steel'&lt;2>\"/></Appearance>") +
                            shape("<Appearance><Material DEF='mud' shininess='0'/></Appearance>") +
                            shape("<Appearance USE='Look'/>") + shape("") +
                            shape("<Appearance><Material USE='mud'/></Appearance>") + "</Scene></X3D>");
  LoadOptions options;
  options.materials = {{.name = "Steel'<2>", .lambert_mu = 0.2}, {.name = "mud", .lambert_mu = 0.1}};
  const LoadedScene loaded = load_scene(own_path("named.x3d"), options);
  const SceneMesh& mesh = loaded.mesh.value();
  std::vector<double> strengths;
  for (const auto& triangle : mesh.triangle)
    strengths.push_back(mesh.materials.at(mesh.material[triangle[0]]).lambert_mu);
  EXPECT_EQ(strengths, (std::vector{0.2, 0.1, 0.2, Material{}.lambert_mu, 0.1}));
}

TEST_F(X3dFile, x3d_that_grows_without_bound_or_names_other_files_is_refused) {
  std::string vrml = vrml_plate, x3d = x3d_plate, before = "Plate";
  for (int k = 0; k < 40; ++k) {
    const std::string name = "A" + std::to_string(k);
    vrml += "DEF " + name + " Group { children [ USE " + before + " USE " + before + " ] }\n";
    x3d += "<Group DEF='" + name + "'><Group USE='" + before + "'/><Group USE='" + before + "'/></Group>\n";
    before = name;
  }
  const std::string reason = "groups that are used again make it larger by more than 64 MiB";
  expect_error(ErrorKind::content, {"laughs.wrl", reason, "as .glb"}, [&] { places_in("laughs.wrl", vrml); });
  expect_error(ErrorKind::content, {"laughs.x3d", reason, "as .glb"}, [&] { places_in("laughs.x3d", x3d); });
  expect_error(ErrorKind::content, {"parts.x3d", "nodes of type Inline are not read", "as .glb"},
               [&] { places_in("parts.x3d", x3d_plate + "<Inline url='\"part.x3d\"'/>"); });
  std::string deep;
  for (int k = 0; k < 100'000; ++k) deep += "<Group>";
  expect_error(ErrorKind::content, {"deep.x3d", "more than 500 elements are within each other", "as .glb"},
               [&] { places_in("deep.x3d", deep); });
  std::string wide;  // UTF-16
  for (const char c : x3d_plate) wide += {c, '\0'};
  expect_error(ErrorKind::content, {"wide.x3d", "holds zero bytes", "save it as UTF-8"},
               [&] { places_in("wide.x3d", wide); });
  expect_error(ErrorKind::content, {"absent.x3d", "export it again"},
               [&] { places_in("absent.x3d", x3d_plate + "<Group USE='Nothing'/>"); });
}

TEST_F(X3dFile, damaged_tags_are_refused) {
  const std::string whole = "<X3D><Scene>" + x3d_plate +
                            "<Transform translation='5 0 0'><!-- two -->"
                            "<Group USE='Plate'/><Switch DEF = \"S\" whichChoice='0'/></Transform></Scene></X3D>";
  for (std::size_t length = 0; length + 6 < whole.size(); length += 5) {
    own_file("cut.x3d", whole.substr(0, length));
    expect_error(ErrorKind::content, {"cut.x3d"}, [] { load_scene(own_path("cut.x3d")); });
  }
}

}  // namespace insonify::x3d_tests
