#include <nlohmann/json.hpp>

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
  const auto described = nlohmann::json::parse(succeed("info bare.pcd --json"));
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

TEST_F(Prepare, refuses_a_spacing_that_is_not_positive) {
  for (const char* spacing : {"0", "-1", "dense"})
    expect_refused(std::string("prepare plane.ply -o thin.ply --thin ") + spacing, 2, {"--thin"});
}
