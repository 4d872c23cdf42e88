// SPDX-License-Identifier: BSD-3-Clause
// Sonars written and read again, and keys set by word.
#include "core/random.hpp"
#include "store/sonar_text.hpp"

// Every angle read from degrees is written as degrees that read back to the same bits.
TEST(SonarFile, survives_being_written_and_read_bit_for_bit) {
  std::vector<SonarSpec> specs;
  for (const auto& sonar : list_sonars()) specs.push_back(sonar.spec);
  for (std::uint64_t i = 0; i < 300; ++i) {
    const auto r = random_uniform(5, RandomStage::scene_points, {i, 0, 0});
    SonarSpec& spec = specs.emplace_back(load_sonar(plain).spec);
    spec.name = "n\"" + std::to_string(i) + "\\";
    spec.centre_frequency = 1e6 * (0.2 + r[0]), spec.bandwidth = 1e4 * r[1];
    spec.source_level_db = 200 + r[2];
    spec.field_of_view = radians(180 * r[3]);
    spec.beam_width = radians(r[0]), spec.elevation_width = radians(20 * r[1]);
    spec.elevation = radians(90 * (2 * r[2] - 1));
    spec.side_lobe_db = -20 - 30 * r[3];
    spec.min_range = r[0], spec.max_range = 1 + 100 * r[1];
    spec.bin_size = i % 2 ? std::optional<double>(r[2] * 1e-3) : std::nullopt;
    spec.elevation_shape = static_cast<ElevationShape>(i % 3);
  }
  for (const char* azimuths : {"[-33.3, -7.1, 0, 12.34567890123]", "12.5"})
    set_sonar_value(specs.emplace_back(load_sonar(plain).spec), "azimuths_deg", azimuths);
  set_sonar_value(specs.emplace_back(specs.back()), "beam_width_deg", "2.5");
  EXPECT_EQ(specs.back().beams, 1u);
  EXPECT_EQ(specs.back().field_of_view, radians(2.5)) << "of one beam the field of view is the beam";
  for (const char* window : {"uniform", "hann", "hamming"}) {
    SonarSpec& sweep = specs.emplace_back(load_sonar(plain + "pulse = \"linear_fm\"\npulse_length_s = 2.1e-3\n").spec);
    set_sonar_value(sweep, "replica_window", window);
  }
  for (const SonarSpec& spec : specs) expect_same_bits(load_sonar(sonar_as_toml(spec)).spec, spec);
}

// shading is redundant if it follows from side_lobe_db: Taylor below 0, else uniform.
TEST(SonarFile, shading_is_kept_and_written_only_if_side_lobe_db_does_not_say_it) {
  for (const double side_lobe_db : {-30.0, 0.0})
    for (const Shading shading : {Shading::taylor, Shading::uniform, Shading::hamming, Shading::chebyshev}) {
      SonarSpec spec = load_sonar(plain).spec;
      EXPECT_FALSE(spec.shading.has_value());
      spec.side_lobe_db = side_lobe_db;
      const bool said = shading_of(spec) == shading;
      set_sonar_value(spec, "shading", shading_name(shading));
      EXPECT_EQ(shading_of(spec), shading);
      const std::string text = sonar_as_toml(spec);
      EXPECT_EQ(text.find("shading = ") == std::string::npos, said) << text;
      if (side_lobe_db == 0 && (shading == Shading::taylor || shading == Shading::chebyshev)) {
        refuses_sonar(text,
                      "9: side_lobe_db = 0 dB, must be within -80 and -13.3 for shading taylor or "
                      "chebyshev");
      } else {
        expect_same_bits(load_sonar(text).spec, spec);
      }
    }
}

TEST(SonarFile, is_written_without_the_keys_that_it_does_not_need) {
  for (const char* key :
       {"pulse =", "pulse_length_s", "replica_window", "elevations_deg", "column_beam_width_deg", "transmit_width_deg"})
    EXPECT_EQ(sonar_as_toml(load_sonar(plain).spec).find(key), std::string::npos) << key;
}

// --set gives a key the same value as a file.
TEST(SetSonarValue, sets_every_key_as_a_file_does) {
  const std::pair<const char*, const char*> numbers[] = {{"centre_frequency_hz", "700e3"},
                                                         {"range_resolution_m", "0.01"},
                                                         {"source_level_db", "+215.5"},
                                                         {"beams", "64"},
                                                         {"field_of_view_deg", "60"},
                                                         {"beam_width_deg", "2"},
                                                         {"elevation_width_deg", "12"},
                                                         {"elevation_deg", "-5"},
                                                         {"side_lobe_db", "-25"},
                                                         {"min_range_m", "1"},
                                                         {"max_range_m", "40"},
                                                         {"bin_size_m", "2e-3"},
                                                         {"pulse_length_s", "2e-3"},
                                                         {"column_beam_width_deg", "4"},
                                                         {"transmit_width_deg", "80"}};
  const std::pair<const char*, const char*> words[] = {{"elevation_shape", "line"},
                                                       {"shading", "chebyshev"},
                                                       {"pulse", "linear_fm"},
                                                       {"replica_window", "uniform"},
                                                       {"name", "other"}};
  SonarSpec s = load_sonar(plain).spec;
  std::string text = "schema = 1\n";
  for (const auto& [key, value] : numbers) {
    set_sonar_value(s, key, value);
    text += std::string(key) + " = " + value + "\n";
  }
  for (const auto& [key, value] : words) {
    set_sonar_value(s, key, value);
    text += std::string(key) + " = \"" + value + "\"\n";
  }
  expect_same_bits(load_sonar(text).spec, s);
  EXPECT_EQ(s.bandwidth, 75e3);
  EXPECT_EQ(s.elevation, radians(-5));
  set_sonar_value(s, "azimuths_deg", "-1,0,1");
  EXPECT_EQ(s.azimuths.size(), 3u);
  EXPECT_EQ(s.beams, 3u);
  set_sonar_value(s, "beams", "16");  // evenly spaced again
  EXPECT_TRUE(s.azimuths.empty());
  EXPECT_EQ(s.beams, 16u);
  set_sonar_value(s, "elevations_deg", "-1,1");
  set_sonar_value(s, "beams", "32");  // rows stay rows
  EXPECT_EQ(beams_of(s), 64u);
  set_sonar_value(s, "elevation_deg", "7");  // one row again
  EXPECT_EQ(beams_of(s), 32u);
}

TEST(SetSonarValue, names_the_nearest_key_and_the_rule) {
  SonarSpec s;
  EXPECT_EQ(error_with_kind([&] { set_sonar_value(s, "max_range", "3"); }),
            "argument: sonar: unknown key 'max_range'; did you mean 'max_range_m'?");
  EXPECT_THAT(error_with_kind([&] { set_sonar_value(s, "pressure", "3"); }),
              HasSubstr("argument: sonar: unknown key 'pressure'; known are name, "));
  EXPECT_EQ(error_with_kind([&] { set_sonar_value(s, "beams", "many"); }),
            "argument: sonar: beams = \"many\", must be a whole number within 1 and 65536");
  EXPECT_EQ(error_with_kind([&] { set_sonar_value(s, "max_range_m", "30 m"); }),
            "argument: sonar: max_range_m = \"30 m\", must be a number");
  EXPECT_EQ(error_with_kind([&] { set_sonar_value(s, "max_range_m", ""); }),
            "argument: sonar: max_range_m = \"\", must be a number");
  EXPECT_EQ(error_with_kind([&] { set_sonar_value(s, "max_range_m", "1,2"); }),
            "argument: sonar: max_range_m = [1.0, 2.0], must be a number");
  EXPECT_EQ(error_with_kind([&] { set_sonar_value(s, "elevation_shape", "3"); }),
            "argument: sonar: elevation_shape = 3.0, must be one of gaussian, line, sector");
}
