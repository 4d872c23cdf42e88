// SPDX-License-Identifier: BSD-3-Clause
#include "store/environment_file.hpp"

#include "core/text.hpp"
#include "store/environment_keys.hpp"
#include "support/test.hpp"

namespace {

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string error_of_environment(const std::string& text) {
  return error_with_kind([&] { load_environment(own_file("e.toml", text)); });
}

/// Returns the keys that set_environment_value sets, as "section.key", in the order of files.
std::vector<std::string> environment_key_names() {
  Environment e;
  std::vector<std::string> names = names_of(environment_keys(e));
  std::erase_if(names, [](const std::string& name) { return name.starts_with("profile.") || name == "mirror"; });
  return names;
}

}  // namespace

TEST(EnvironmentFile, an_empty_file_is_plain_sea_water) {
  const Environment e = load_environment(own_file("e.toml", ""));
  EXPECT_EQ(e.water.temperature_c, 10);
  EXPECT_FALSE(e.surface || e.bottom || e.volume_scattering_db || e.wind_speed || e.self_noise_db || e.profile);
}

TEST(EnvironmentFile, a_table_makes_its_part_present) {
  const Environment e = load_environment(own_file("e.toml", "[surface]\n[bottom]\nheight_m = -12\n"));
  ASSERT_TRUE(e.surface && e.bottom);
  EXPECT_EQ(e.surface->height, 0);
  EXPECT_EQ(e.bottom->height, -12);
  EXPECT_FALSE(e.bottom->lambert_mu);
}

TEST(EnvironmentFile, everything_set_by_key_reads_back_from_its_toml) {
  Environment e;
  double x = 0.5;
  for (const std::string& name : environment_key_names()) {
    if (name.starts_with("tank.")) continue;  // instead of surface and bottom
    const auto dot = name.find('.');
    const std::string value = name == "water.sound_speed_formula"  ? "leroy"
                              : name == "water.absorption_formula" ? "ainslie-mccolm"
                              : name == "bottom.height_m"          ? "-20"
                              : name == "surface.height_m"         ? "1.5"
                              : name == "water.level_m"            ? "1.5"
                              : name == "bottom.lambert_mu_db"     ? "-27"
                              : name == "surface.scattering_db"    ? "-30"
                              : name == "volume.scattering_db"     ? "-70"
                                                                   : std::to_string(x += 0.01);
    set_environment_value(e, name.substr(0, dot), name.substr(dot + 1), value);
  }
  const std::string text = environment_as_toml(e);
  const Environment back = load_environment(own_file("e.toml", text));
  EXPECT_EQ(environment_as_toml(back), text);
  EXPECT_EQ(back.water.ph, e.water.ph);
  EXPECT_EQ(back.surface->rms_height, e.surface->rms_height);
  EXPECT_EQ(back.sound_speed_formula, SoundSpeedFormula::leroy);
  EXPECT_EQ(back.absorption_formula, AbsorptionFormula::ainslie_mccolm);
  EXPECT_NEAR(*back.bottom->lambert_mu, 0.00199526, 1e-8);
  for (const std::string& name : environment_key_names())
    EXPECT_TRUE(name.starts_with("tank.") || holds(text, name.substr(name.find('.') + 1) + " = ")) << name;
}

TEST(EnvironmentFile, holds_a_tank_in_three_lines_and_mirrors_of_all_kinds) {
  const Environment tank =
      load_environment(own_file("tank.toml", "[tank]\nsize_m = [6, 4, 3]\ncorner_m = [0, 0, -3]\nreflection = 0.7\n"));
  ASSERT_EQ(mirrors_of(tank).size(), 6u);
  EXPECT_EQ(*surface_height(tank), 0);
  EXPECT_EQ(environment_as_toml(load_environment(own_file("again.toml", environment_as_toml(tank)))),
            environment_as_toml(tank));
  Environment set;
  set_environment_value(set, "tank", "size_m", "6,4,3");
  EXPECT_EQ(set.tank->size, Eigen::Vector3d(6, 4, 3));

  const Environment e = load_environment(
      own_file("walls.toml",
               "[[mirror]]\nname = \"quay\"\nplace_m = [0, 3, 0]\nnormal = [0, -2, 0]\ndensity_kg_m3 = 2300\n"
               "pressure_speed = 4000\nshear_speed = 2400\nrms_height_m = 0.001\n"
               "[[mirror]]\nplace_m = [5, 0, -2]\nnormal = [-1, 0, 0]\nsize_m = [2, 1]\nreflection = -1\n"
               "[[mirror]]\ncorners_m = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n"));
  ASSERT_EQ(e.mirrors.size(), 3u);
  EXPECT_EQ(e.mirrors[0].solid->shear_speed, 2400);
  EXPECT_TRUE(e.mirrors[0].corners.empty());
  ASSERT_EQ(e.mirrors[1].corners.size(), 4u);
  EXPECT_LT((e.mirrors[1].corners[0] - Eigen::Vector3d(5, 1, -2.5)).norm(), 1e-12);
  EXPECT_EQ(e.mirrors[2].normal, Eigen::Vector3d::UnitZ());
  const std::string text = environment_as_toml(e);
  EXPECT_EQ(environment_as_toml(load_environment(own_file("walls-again.toml", text))), text);
}

TEST(EnvironmentFile, refuses_mirrors_and_tanks_that_are_none) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"[[miror]]\nname = \"a\"\n", "did you mean 'mirror'?"},
      {"[[mirror]]\nplace_m = [0, 0, 0]\nnormal = [0, 0, 1]\nreflektion = 1\n", "did you mean 'mirror.reflection'?"},
      {"[[mirror]]\nplace_m = [0, 0, 0]\nnormal = [0, 0, 1]\nreflection = 2\n", "within -1 and 1"},
      {"[[mirror]]\nplace_m = [0, 0, 0]\nnormal = [0, 0, 0]\n", "length of normal"},
      {"[[mirror]]\nname = \"a\"\n", "either corners_m, or place_m and normal"},
      {"[[mirror]]\ncorners_m = [[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 0]]\n", "flat convex polygon"},
      {"[[mirror]]\ncorners_m = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]\n", "span no plane"},
      {"[tank]\nsize = [1, 2, 3]\n", "did you mean 'tank.size_m'?"},
      {"[tank]\nreflection = 0.5\n", "tank.size"},
      {"[tank]\nsize_m = [1, 2, 3]\n[surface]\nheight_m = 0\n", "a tank has a surface"}};
  for (const auto& [text, expected] : mistakes) {
    const std::string error = error_of_environment(text);
    EXPECT_TRUE(holds(error, expected)) << error;
  }
}

TEST(EnvironmentFile, refuses_more_mirrors_and_corners_than_a_ping_can_have) {
  const std::string wall = "[[mirror]]\nplace_m = [9, 0, 0]\nnormal = [-1, 0, 0]\n";
  std::string walls = "[tank]\nsize_m = [9, 9, 9]\n";
  for (int i = 0; i < 57; ++i) walls += wall;
  EXPECT_EQ(mirrors_of(load_environment(own_file("walls.toml", walls))).size(), 63u);
  const std::string error = error_of_environment(walls + wall + wall);
  EXPECT_TRUE(holds(error, ":174: 59 mirrors, must be at most 57")) << error;
  const auto round = [](int corners) {
    std::string text = "\n[[mirror]]\ncorners_m = [";
    for (int i = 0; i < corners; ++i)
      text += printed("[%.15f, %.15f, 0], ", std::cos(2 * pi * i / corners), std::sin(2 * pi * i / corners));
    return text + "]\n";
  };
  EXPECT_EQ(load_environment(own_file("round.toml", round(64))).mirrors[0].corners.size(), 64u);
  EXPECT_TRUE(holds(error_of_environment(round(65)), ":2: mirror 'mirror': number of corners = 65, must be within 3"));
}

TEST(EnvironmentFile, names_line_and_nearest_key_of_a_mistake) {
  EXPECT_TRUE(holds(error_of_environment("[water]\ntemprature_c = 4\n"),
                    ":2: unknown key 'water.temprature_c'; did you mean 'water.temperature_c'?"));
  EXPECT_TRUE(holds(error_of_environment("[water]\nph = \"acid\"\n"), ":2: water.ph = \"acid\", must be a number"));
  EXPECT_TRUE(holds(error_of_environment("[water]\nabsorption_formula = \"thorp\"\n"),
                    ":2: water.absorption_formula = \"thorp\", must be one of francois-garrison"));
  EXPECT_TRUE(holds(error_of_environment("depth_m = 3\n"), ":1: unknown key 'depth_m'; did you mean 'water.depth_m'?"));
}

TEST(EnvironmentFile, refuses_values_that_make_no_environment_with_value_unit_and_rule) {
  EXPECT_TRUE(holds(error_of_environment("[wind]\nspeed_m_s = -3\n"), "wind_speed = -3 m/s, must be within 0 and 100"));
  EXPECT_TRUE(holds(error_of_environment("[surface]\nheight_m = 0\n[bottom]\nheight_m = 1\n"),
                    "bottom.height = 1 m, must be below surface.height = 0 m"));
  EXPECT_TRUE(holds(error_of_environment("[bottom]\nlambert_mu_db = 3\nheight_m = -5\n"), "must be within 0 and 1/pi"));
}

TEST(EnvironmentFile, a_profile_reads_back_from_its_toml) {
  const Environment e =
      load_environment(own_file("e.toml", "[profile]\ndepth_m = [0, 2.5]\nsound_speed = [1510, 1490.1]\n"));
  ASSERT_TRUE(e.profile);
  EXPECT_EQ(e.profile->depth, (std::vector<double>{0, 2.5}));
  const Environment back = load_environment(own_file("back.toml", environment_as_toml(e)));
  ASSERT_TRUE(back.profile);
  EXPECT_EQ(back.profile->depth, e.profile->depth);
  EXPECT_EQ(back.profile->sound_speed, e.profile->sound_speed);
  EXPECT_TRUE(holds(error_of_environment("[profile]\ndepth_m = [0, 5]\n"), ":1: missing key 'profile.sound_speed'"));
  EXPECT_TRUE(holds(error_of_environment("[profile]\ndepth_m = 0\nsound_speed = [1500]\n"),
                    ":2: profile.depth_m = 0 m, must be a list, each a number"));
  EXPECT_TRUE(holds(error_of_environment("[profile]\ndepth_m = [3, 1]\nsound_speed = [1500, 1500]\n"),
                    "must be deeper than the entry before it"));
}

TEST(EnvironmentFile, of_a_run_toml_only_the_environment_counts) {
  const std::string run =
      "insonify_version = \"0\"\nseed = 1\n[scene]\npath = \"a\"\n[ping]\nnoise = true\n"
      "[water]\nph = 7.5\n[sonar]\nname = \"x\"\n";
  EXPECT_EQ(load_environment(own_file("run.toml", run)).water.ph, 7.5);
  EXPECT_TRUE(holds(error_of_environment(run + "[wnd]\n"), ":11: unknown table [wnd]; did you mean [wind]?"));
}

TEST(EnvironmentFile, refuses_unknown_tables_even_if_empty) {
  EXPECT_TRUE(holds(error_of_environment("[surfce]\n"), ":1: unknown table [surfce]; did you mean [surface]?"));
  EXPECT_TRUE(
      holds(error_of_environment("[sonar]\nbeams = 3\n"), ":1: unknown table [sonar]; known are [water] [surface]"));
}

TEST(EnvironmentFile, refuses_text_that_is_no_number) {
  Environment e;
  EXPECT_EQ(error_with_kind([&] { set_environment_value(e, "wind", "speed_m_s", "strong"); }),
            "argument: wind.speed_m_s = \"strong\", must be a number");
  EXPECT_EQ(error_with_kind([&] { set_environment_value(e, "wind", "sped_m_s", "1"); }),
            "argument: unknown key 'wind.sped_m_s'; did you mean 'wind.speed_m_s'?");
  EXPECT_EQ(
      error_with_kind([&] { set_environment_value(e, "profile", "depth_m", "[0, 1]"); }),
      "argument: profile.depth_m: a profile is set as a whole: by [profile] of an environment file, or by a CSV file "
      "(--profile)");
}
