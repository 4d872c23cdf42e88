// SPDX-License-Identifier: BSD-3-Clause
// Tests what --keep contributors and --keep insonification write.
#include <nlohmann/json.hpp>

#include "scene_io/load_scene.hpp"
#include "store/contributor_file.hpp"
#include "store/cube.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

class KeptFiles : public ToolTest {
 protected:
  const std::string ping =
      "ping harbour.ply --sonar p900-45 --set sonar.beams=32 --pose=0,0,-3,0,10,0 --range 2:15 "
      "--no-picture -q ";

  void SetUp() override { have("harbour.ply", "make-scene harbour --points 20000"); }
};

TEST_F(KeptFiles, contributors_fit_the_cube_and_name_the_materials_of_the_scene) {
  succeed(ping + "-o out --keep contributors --contributors 2");
  const Ping p = ping_of("out");
  const NamedContributors named = read_contributor_file(path("out/contributors.h5"));
  EXPECT_EQ(named.contributors.beams, p.fan.beams());
  EXPECT_EQ(named.contributors.bins, p.gate.bins());
  EXPECT_EQ(named.contributors.per_pixel, 2U);
  const SceneCloud scene = load_scene(path("harbour.ply")).scene;
  ASSERT_EQ(named.materials.size(), scene.materials.size());
  for (std::size_t m = 0; m < named.materials.size(); ++m) EXPECT_EQ(named.materials[m], scene.materials[m].name);
  Eigen::Index beam = 0, bin = 0;
  p.pressure.abs().maxCoeff(&beam, &bin);
  const std::size_t loudest = named.contributors.at(static_cast<std::size_t>(beam), static_cast<std::size_t>(bin));
  const std::uint32_t surfel = named.contributors.surfel[loudest];
  ASSERT_LT(surfel, scene.size());
  EXPECT_EQ(named.contributors.id[loudest], scene.id[surfel]);
  EXPECT_EQ(named.contributors.material[loudest], scene.material[surfel]);
  const auto manifest = manifest_of("out");
  EXPECT_EQ(manifest["contributors"]["per_pixel"], 2);
  EXPECT_GT(manifest["contributors"]["mean_share_listed"], 0.1);
  EXPECT_GT(manifest["seconds"]["contributors"], 0);
  EXPECT_FALSE(std::filesystem::exists(path("out/insonification.ply")));
}

TEST_F(KeptFiles, are_the_same_bytes_for_one_and_two_threads) {
  succeed(ping + "-o one -j1 --keep contributors,insonification");
  succeed(ping + "-o two -j2 --keep contributors --keep insonification");
  for (const std::string file : {"contributors.h5", "insonification.ply", "insonification.pcd"})
    EXPECT_EQ(read("one/" + file), read("two/" + file)) << file;
}

TEST_F(KeptFiles, insonification_opens_as_a_cloud_of_the_whole_scene) {
  succeed(ping + "-o out --keep insonification");
  const auto manifest = manifest_of("out");
  const std::size_t surfels = load_scene(path("harbour.ply")).scene.size();
  EXPECT_EQ(manifest["insonification"]["surfels"], surfels);
  EXPECT_GT(manifest["insonification"]["insonified"], surfels / 100);
  EXPECT_LE(manifest["insonification"]["insonified"], manifest["sampling"]["visible"]);
  for (const std::string file : {"out/insonification.ply", "out/insonification.pcd"}) {
    const LoadedScene loaded = load_scene(path(file));
    EXPECT_EQ(loaded.scene.size(), surfels) << file;
    EXPECT_FALSE(loaded.report.normals_estimated) << file;
  }
  EXPECT_FALSE(std::filesystem::exists(path("out/contributors.h5")));
}

TEST_F(KeptFiles, are_not_there_unless_asked_for) {
  succeed(ping + "-o out");
  for (const std::string file : {"contributors.h5", "insonification.ply", "insonification.pcd"})
    EXPECT_FALSE(std::filesystem::exists(path("out/" + file))) << file;
  EXPECT_FALSE(manifest_of("out").contains("contributors"));
}

TEST_F(KeptFiles, of_unknown_kind_or_number_are_refused) {
  expect_refused(ping + "-o out --keep contributions", 2, {"--keep", "contributions"});
  expect_refused(ping + "-o out --keep contributors --contributors 256", 2, {"--contributors", "256"});
  expect_refused(ping + "-o out --keep contributors --contributors 0", 2, {"--contributors"});
}
