// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "scene_io/cloud_field.hpp"
#include "scene_io/load_scene.hpp"
#include "tool/tool_runner.hpp"

namespace {

class Prepare : public ToolTest {
 protected:
  void SetUp() override { have("plane.ply", "make-scene plane --points 4000 --size 8,8"); }
  nlohmann::json prepared(const std::string& arguments) const {
    return nlohmann::json::parse(succeed("prepare " + arguments + " --json -q"));
  }
};

}  // namespace

TEST_F(Prepare, thins_to_the_spacing_asked_for_and_keeps_the_area) {
  const nlohmann::json whole = prepared("plane.ply -o whole.ply"), thin = prepared("plane.ply -o thin.ply --thin 0.5");
  EXPECT_NEAR(thin["surfels"].get<double>(), 8 * 8 / (0.5 * 0.5), 40);
  EXPECT_NEAR(thin["area_m2"].get<double>(), whole["area_m2"].get<double>(), 1e-4);
  EXPECT_THAT(thin["notes"].dump(), HasSubstr("thinned to 0.5 m"));
  const nlohmann::json again = prepared("thin.ply -o again.ply");
  EXPECT_EQ(again["surfels"], thin["surfels"]);
  EXPECT_NEAR(again["area_m2"].get<double>(), whole["area_m2"].get<double>(), 1e-4);
}

TEST_F(Prepare, finds_normals_and_areas_of_bare_points) {
  succeed("make-scene reef --points 20000 -o reef.ply -q");
  succeed("make-scene reef --points 20000 --bare -o bare.pcd -q");
  const auto described = json_of("info bare.pcd");
  EXPECT_FALSE(described["normals"].get<bool>());
  EXPECT_EQ(described["fields"].size(), 3u);
  const nlohmann::json from_points = prepared("bare.pcd -o completed.ply --viewpoint 6,0,5");
  EXPECT_TRUE(from_points["normals_oriented"].get<bool>());
  const nlohmann::json exact = prepared("reef.ply -o exact.ply");
  // Corals of 2 cm branches are finer than 20 000 points show; the rest of the area is found.
  EXPECT_NEAR(from_points["area_m2"].get<double>(), exact["area_m2"].get<double>(),
              0.15 * exact["area_m2"].get<double>());
  expect_refused("make-scene reef --bare -o reef.tiles", 2, {"--bare", "reef.tiles", ".ply or .pcd"});
}

TEST_F(Prepare, keeps_the_surface_of_a_height_field_and_of_a_mesh) {
  std::string points, mesh;
  for (int i = 0; i < 900; ++i)
    points +=
        fmt::format("{} {} {}\n", 0.1 * (i % 30), 0.1 * (i / 30), 0.1 * std::sin(0.5 * (i % 30) + 0.2 * (i / 30)));
  write("bed.xyz", points);
  write("bed.obj", "v 0 0 0\nv 3 0 0\nv 3 3 0.5\nv 0 3 0\nf 1 2 3\nf 1 3 4\n");
  for (const std::string file : {"bed.xyz --viewpoint 1.5,1.5,9", "bed.obj"}) {
    const std::string kind = file.substr(4, 3);
    succeed("prepare " + file + " -q -o " + kind + ".ply");
    const std::string head = " --sonar p900-45 --set sonar.beams=16 --pose=-1,1.5,1,0,20,0 --range 1:5 --no-picture -q";
    succeed("ping " + file + head + " -o " + kind + "_read");
    succeed("ping " + kind + ".ply" + head + " -o " + kind + "_prepared");
    EXPECT_TRUE(read(kind + "_read/cube.h5") == read(kind + "_prepared/cube.h5")) << file;
    succeed("prepare " + kind + ".ply -q -o " + kind + "_again.ply");
    EXPECT_TRUE(read(kind + "_again.ply") == read(kind + ".ply")) << file;
  }
  EXPECT_THAT(prepared("bed.obj -o bed.pcd")["notes"].dump(), HasSubstr("has no place for triangles"));
  EXPECT_EQ(prepared("bed.obj -o bed.ply")["notes"].size(), 0u);
}

// A table of materials fits the cloud and what was prepared of it, by the field that it names, by numbers and by names;
// columns of which a scene makes no use survive.
TEST_F(Prepare, keeps_every_column_by_its_name_and_fits_its_table_again) {
  std::string rows = "x,y,z,label,instance,reflectance\n";
  for (int i = 0; i < 900; ++i)
    rows += fmt::format("{},{},{},{},{},{}\n", 0.1 * (i % 30), 0.1 * (i / 30), 0.01 * (i % 7), i % 30 < 15 ? 1 : 4,
                        i / 300, 0.25 * i);
  write("cloud.csv", rows);
  const std::string mud = "[[material]]\nname = \"mud\"\nlambert_mu_db = -20\n",
                    rock = "[[material]]\nname = \"rock\"\nlambert_mu_db = -10\n";
  write("table.toml", "schema = 1\nfield = \"label\"\n" + mud + "label = 1\n" + rock + "label = 4\n");
  write("names.toml", "schema = 1\n" + rock + mud);  // without numbers, in another order
  write("intervals.toml", "schema = 1\nfield = \"reflectance\"\n" + mud + "to = 100\n" + rock + "from = 100\n");
  const auto names_in = [&](const std::string& file) {
    std::set<std::string> names;
    const auto info = json_of("info " + file);
    for (const auto& field : info["fields"]) names.insert(field["name"].get<std::string>());
    return names;
  };
  for (const std::string ending : {".ply", ".pcd"}) {
    const std::string once = "once" + ending, again = "again" + ending;
    prepared("cloud.csv -o " + once + " --materials table.toml");
    EXPECT_THAT(names_in(once), testing::IsSupersetOf({"label", "instance", "reflectance", "area", "id"}));
    EXPECT_FALSE(names_in(once).contains("material"));
    for (const std::string table : {"table.toml", "names.toml"}) {
      const nlohmann::json result = prepared(once + " -o " + again + " --force --materials " + table);
      EXPECT_EQ(read(again), read(once)) << table;
      EXPECT_EQ(result["notes"].size(), 0U) << result;
    }
    // The values of the field stand beside the materials that their intervals mean.
    prepared("cloud.csv -o by.ply --force --materials intervals.toml");
    EXPECT_THAT(names_in("by.ply"), testing::IsSupersetOf({"material", "label", "reflectance"}));
    prepared("by.ply -o by2.ply --force --materials intervals.toml");
    const SceneCloud by = load_scene(path("by.ply")).scene;
    EXPECT_EQ(load_scene(path("by2.ply")).scene.material, by.material);
    EXPECT_EQ(std::count(by.material.begin(), by.material.end(), 0), 400);  // of 900, reflectance below 100
    EXPECT_EQ(by.materials.at(1).name, "rock");
    const CloudField instance = load_cloud_field(path(once), "instance"),
                     field = load_cloud_field(path(once), "reflectance");
    ASSERT_EQ(instance.value.size(), 900U);
    for (std::size_t i = 0; i < 900; ++i) {
      EXPECT_EQ(field.value[i], 0.25 * field.id[i]);
      EXPECT_EQ(instance.value[i], field.id[i] / 300);
    }
  }
  // Thinned, each surfel keeps its own.
  prepared("once.ply -o thin.ply --thin 0.3");
  const CloudField thin = load_cloud_field(path("thin.ply"), "reflectance");
  EXPECT_LT(thin.value.size(), 300U);
  for (std::size_t i = 0; i < thin.value.size(); ++i) EXPECT_EQ(thin.value[i], 0.25 * thin.id[i]);
  EXPECT_THAT(prepared("cloud.csv -o cloud.tiles")["notes"].dump(),
              HasSubstr("cannot store the columns instance, reflectance"));
  // A material that the table lacks stays what the file says.
  write("rock.toml", "schema = 1\n" + rock);
  EXPECT_THAT(prepared("once.ply -o part.ply --materials rock.toml")["notes"].dump(),
              HasSubstr("has no mud: as in the file"));
}

TEST_F(Prepare, refuses_a_spacing_that_is_not_positive) {
  for (const char* spacing : {"0", "-1", "dense"})
    expect_refused(std::string("prepare plane.ply -o thin.ply --thin ") + spacing, 2, {"--thin"});
}
