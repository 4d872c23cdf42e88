// SPDX-License-Identifier: BSD-3-Clause
// Whoever shows, compares or repeats a ping of a scene of parts has the parts where they were when it was sent.
#include <set>

#include <fmt/format.h>

#include "run/ping_setup.hpp"
#include "run_scenes/open_scene.hpp"
#include "run_scenes/stored_run.hpp"
#include "store/cube.hpp"
#include "tool/parts_fixture.hpp"
#include "view/test_pictures.hpp"

namespace {
class DoorsToParts : public PartsOfTool {};
}  // namespace

// The scene of a ping of a survey, which all doors ask for, has each part where /part_views of the ping has it.
TEST_F(DoorsToParts, the_scene_of_a_ping_of_a_survey_is_that_which_was_pinged) {
  mission_over("drawn.toml", "keep = [\"contributors\"]\n[randomise]\nscene = 3\n");
  survey("run");
  merged_cubes("run", {"fls"});
  const Cube cube = read_cube(path("run/fls/cube.h5"));
  ASSERT_GE(cube.pings.size(), 7U);
  insonify::SceneOptions scene = insonify::StoredRun(path("run/fls")).scene();
  EXPECT_EQ(scene.path, "drawn.toml");
  scene.path = path(scene.path);
  const auto parts = insonify::StoredRun(path("run/fls")).open_scene(scene, 0);
  std::size_t drawn = 0;
  std::set<std::pair<double, double>> positions;
  for (const Ping& ping : cube.pings) {
    const auto cloud = parts->cloud_at(parts->moment_of(ping.time, ping.number));
    const PixelLabels& labels = ping.labels;
    ASSERT_EQ(labels.part_names.size(), cloud->parts.size());
    for (std::size_t p = 0; p < cloud->parts.size(); ++p) {
      ASSERT_EQ(labels.part_names[p], cloud->parts[p].name);
      const Pose &was = labels.views[p].world_from_part, &is = cloud->parts[p].world_from_part;
      if (std::count(cloud->part.begin(), cloud->part.end(), p) == 0) continue;  // not in this draw
      EXPECT_TRUE(was.isApprox(is, 1e-12)) << cloud->parts[p].name << " at ping " << ping.number;
      if (cloud->parts[p].label != "pot") continue;
      positions.insert({is.translation().x(), is.translation().y()}), ++drawn;
    }
    const auto same = parts->cloud_at(parts->moment_of(ping.time, ping.number));
    EXPECT_EQ(same, cloud) << "placed once while it is in use";
  }
  EXPECT_GT(positions.size(), 4U) << "of several draws";
  EXPECT_GT(drawn, positions.size());
}

// Two pings of one draw differ by nothing but a millimetre of the head, those of two draws by where bodies lie.
TEST_F(DoorsToParts, a_picture_of_a_survey_has_the_parts_of_its_ping) {
  write("strewn.toml", "schema = 1\n[[part]]\nfile = \"harbour.ply\"\n" + replaced(strewn_pots, "[0.5, 1]", "[2, 3]"));
  mission_over("strewn.toml", "[randomise]\nscene = 2\n");
  write("m.toml", replaced(read("m.toml"), "[[0, 0, -3], [4, 0, -3], [4, 3, -3]]\nspeed_m_s = 1",
                           "[[0, 0, -3], [0.003, 0, -3]]\nspeed_m_s = 0.001"));
  survey("run");
  merged_cubes("run", {"fls"});
  const auto picture = [&](int ping) {
    succeed(
        fmt::format("image run/fls --view scene --colour part --camera top --title one --size 500x400 --force -q "
                    "-o shown.png --ping {}",
                    ping));
    return read_png(path("shown.png"));
  };
  const ReadPicture first = picture(0), same = picture(1), other = picture(2);
  const auto differ = [](const ReadPicture& a, const ReadPicture& b) {
    int count = 0;
    for (int x = 0; x < a.width; ++x)
      for (int y = 0; y < a.height; ++y) count += colour_difference(a.at(x, y), b.at(x, y)) > 12;
    return count;
  };
  EXPECT_GT(differ(first, other), 60 + 10 * differ(first, same));
}

TEST_F(DoorsToParts, soundings_are_compared_with_parts_where_they_were) {
  write("plane.toml",
        "schema = 1\n[[part]]\nfile = \"harbour.ply\"\n[[part]]\nname = \"lift\"\nfile = \"box.obj\"\n"
        "position_m = [6, 0, 20]\nvelocity_mps = [0, 0, 2]\n");
  // On the lid of a box 20.5 m up, that rises by 2 m/s.
  const auto soundings = [](double start, double faster) {
    std::string rows = "ping,time_s,x_m,y_m,z_m\n";
    for (int ping = 0; ping < 4; ++ping)
      for (int k = 0; k < 4; ++k)
        rows += fmt::format("{},{},{},{},{}\n", ping, start + ping, 6.1 + 0.1 * k, 0.1 + 0.1 * k, 20.5 + faster * ping);
    return rows;
  };
  write("right.csv", soundings(0, 2));
  write("wrong.csv", soundings(0, 0));
  EXPECT_LT(json_of("compare right.csv plane.toml --cell 0.1")["distance_95_m"].get<double>(), 0.02);
  EXPECT_GT(json_of("compare wrong.csv plane.toml --cell 0.1")["distance_95_m"].get<double>(), 3);
  write("utc.csv", soundings(1.7e9, 2));
  expect_refused("compare utc.csv plane.toml", 3, {"utc.csv", "from 1970", "give the run"});
  write("timeless.csv", "x_m,y_m,z_m\n6,0,20\n");
  expect_refused("compare timeless.csv plane.toml", 3, {"timeless.csv", "no column time_s", "plane.toml move"});
  // Soundings that are compared with their run have the times of its pings, whatever the table says.
  mission_over("plane.toml");
  survey("run");
  merged_cubes("run", {"fls"});
  std::string rows = "ping,x_m,y_m,z_m\n";
  const Cube cube = read_cube(path("run/fls/cube.h5"));
  for (const Ping& ping : cube.pings)
    rows += fmt::format("{0},6.2,0.2,{1}\n{0},6.3,0.3,{1}\n", ping.number, 20.5 + 2 * ping.time);
  write("run.csv", rows);
  EXPECT_LT(json_of("compare run.csv run/fls --cell 0.1")["distance_95_m"].get<double>(), 0.02);
  write("run.csv", rows + "99,6.3,0.3,20\n");
  expect_refused("compare run.csv run/fls", 3, {"run.csv", "ping 99 is not one of run/fls"});
  expect_refused("compare run.csv run", 3, {"run", "several heads"});
}

TEST_F(DoorsToParts, a_ping_has_the_draw_that_is_asked_for) {
  succeed("ping drawn.toml -o a --time 1 --draw 4" + parts_head);
  const auto positions = [&](const std::string& run) { return manifest_of(run)["scene"]["parts"]; };
  mission_over("drawn.toml", "keep = [\"contributors\"]\n[randomise]\nscene = \"ping\"\n");
  write("m.toml", replaced(read("m.toml"), "seed = 7", "seed = 1"));
  survey("run");
  merged_cubes("run", {"fls"});
  const PixelLabels labels = read_cube(path("run/fls/cube.h5")).pings.at(4).labels;
  const auto pot = std::find(labels.part_names.begin(), labels.part_names.end(), "pot-1") - labels.part_names.begin();
  EXPECT_NEAR(named(positions("a"), "pot-1")["position_m"][0].get<double>(),
              labels.views[static_cast<std::size_t>(pot)].world_from_part.translation().x(), 1e-9);
  succeed("ping --run a/run.toml -o again -q --no-picture");
  EXPECT_EQ(read("a/cube.h5"), read("again/cube.h5"));
  expect_refused("ping scene.toml -o out --draw 1" + parts_head, 2, {"--draw", "no [[scatter]]"});
  expect_refused("ping harbour.ply -o out --draw 1" + parts_head, 2, {"--draw", "no scene of parts"});
}

// However a surface comes into a scene: one limit, before any surfel is made.
TEST_F(DoorsToParts, surfels_too_many_for_any_machine_are_refused_at_once) {
  std::string grid;
  for (int i = 0; i < 400; ++i) grid += fmt::format("{} {} -5\n", 0.5 * (i % 20), 0.5 * (i / 20));
  write("grid.xyz", grid);
  const std::string box = "schema = 1\n[[part]]\nfile = \"harbour.ply\"\n[[part]]\nname = \"box\"\n";
  write("placed.toml", box + "file = \"box.obj\"\nposition_m = [8, 1]\nspacing_m = 1e-9\n");
  write("captured.toml", "schema = 1\n[[part]]\nfile = \"box.obj\"\nspacing_m = 1e-9\n");
  write("heights.toml", "schema = 1\n[[part]]\nfile = \"grid.xyz\"\nspacing_m = 1e-9\n");
  for (const std::string& arguments :
       {std::string("placed.toml"), std::string("captured.toml"), std::string("heights.toml"),
        std::string("grid.xyz --mesh-spacing 1e-9"), std::string("box.obj --mesh-spacing 1e-9")})
    expect_refused("ping " + arguments + parts_head + " -o x", 3,
                   {": surfels 1e-09 m apart on", "at most 400000000", "give a wider spacing"});
}
