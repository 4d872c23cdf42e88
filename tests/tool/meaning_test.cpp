// SPDX-License-Identifier: BSD-3-Clause
// Tests that unit and axes of a file, as a user states them, count alike in info, prepare, ping, run.toml and scenes of
// parts.
#include <fmt/format.h>

#include "tool/tool_runner.hpp"

namespace {

const std::string head = " --sonar p900-45 --set sonar.beams=16 --pose=0,4,1,0,20,0 --range 1:12 --no-picture -q";

/// A bed that falls from 2 to 4 m below 0, as depths of decimetres without a heading.
std::string depths() {
  std::string text;
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 40; ++column)
      text += fmt::format("{} {} {}\n", 2 * column, 2 * row, 20 + 0.5 * column + 0.01 * row);
  return text;
}

class Meaning : public ToolTest {
 protected:
  void SetUp() override { write("bed.xyz", depths()); }
};

double lowest(const nlohmann::json& info) { return info["bounds"]["min"][2].get<double>(); }

}  // namespace

TEST_F(Meaning, is_told_by_info_with_the_commands_that_go_on) {
  const nlohmann::json plain = json_of("info bed.xyz");
  EXPECT_NEAR(lowest(plain), 20, 1e-6);
  EXPECT_THAT(plain["problems"].dump(), HasSubstr("--z down"));

  const nlohmann::json requested = json_of("info bed.xyz --z down --unit 0.1");
  EXPECT_NEAR(lowest(requested), -(20 + 0.5 * 39 + 0.01 * 39) / 10, 1e-6);
  EXPECT_THAT(requested["meaning"].dump(), testing::AllOf(HasSubstr("\"down\""), HasSubstr("option")));
  const std::string next = requested["next"][0].get<std::string>();
  EXPECT_THAT(next, testing::AllOf(HasSubstr("prepare bed.xyz --unit 0.1 --z down"), HasSubstr("prepared.ply")));
  EXPECT_THAT(succeed("info bed.xyz --z down"), HasSubstr("meaning    z: down (option)"));
  expect_refused("info bed.xyz --z sideways", 2, {"--z = 'sideways'", "down or up"});
  expect_refused("info bed.xyz --nodata few", 2, {"--nodata = 'few'", "none"});
  expect_refused("info bed.xyz --classes 2,300", 2, {"--classes", "0 to 255"});
}

TEST_F(Meaning, is_kept_by_prepare_ping_run_and_parts) {
  succeed("prepare bed.xyz --z down --unit 0.1 -o bed.ply -q");
  EXPECT_NEAR(lowest(json_of("info bed.ply")), -(20 + 0.5 * 39 + 0.01 * 39) / 10, 1e-5);
  succeed("ping bed.xyz --z down --unit 0.1" + head + " -o asked");
  succeed("ping bed.ply" + head + " -o prepared");
  EXPECT_TRUE((ping_of("asked").pressure == ping_of("prepared").pressure).all());
  EXPECT_THAT(read("asked/run.toml"), testing::AllOf(HasSubstr("z = \"down\""), HasSubstr("unit = \"0.1\"")));
  succeed("ping --run asked/run.toml --no-picture -q -o again");
  EXPECT_TRUE((ping_of("asked").pressure == ping_of("again").pressure).all());

  write("scene.toml", "schema = 1\n[[part]]\nfile = \"bed.xyz\"\nunit = \"0.1\"\nz = \"down\"\n");
  write("plain.toml", "schema = 1\n[[part]]\nfile = \"bed.ply\"\n");
  succeed("ping scene.toml" + head + " -o parts");
  succeed("ping plain.toml" + head + " -o plain");
  EXPECT_TRUE((ping_of("parts").pressure == ping_of("plain").pressure).all());
  write("bad.toml", "schema = 1\n[[part]]\nfile = \"bed.xyz\"\nz = \"left\"\n");
  expect_refused("ping bad.toml" + head + " -o bad", 3, {"bad.toml:4", "--z = 'left'"});
}
