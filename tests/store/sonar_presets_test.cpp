// SPDX-License-Identifier: BSD-3-Clause
#include "store/sonar_file.hpp"
#include "support/test.hpp"

namespace {

// Sets INSONIFY_DATA for one test.
class DataFolder {
 public:
  explicit DataFolder(const std::string& path) { ::setenv("INSONIFY_DATA", path.c_str(), 1); }
  ~DataFolder() { ::unsetenv("INSONIFY_DATA"); }
  DataFolder(const DataFolder&) = delete;
  DataFolder& operator=(const DataFolder&) = delete;
};

}  // namespace

TEST(Presets, are_found_by_name_and_sorted) {
  const auto sonars = list_sonars();
  std::vector<std::string> names;
  for (const auto& sonar : sonars) names.push_back(sonar.spec.name);
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  std::istringstream shipped(
      "p900-45 p900-130 m900-130 m900-2250-130 m900-2250-130-hf m450 oculus-m750d oculus-m750d-hf "
      "oculus-m1200d oculus-m1200d-hf oculus-m3000d oculus-m3000d-hf aris-3000 aris-3000-lf aris-1800 "
      "aris-1800-lf didson didson-lf gemini-720is gemini-720im gemini-720ik gemini-1200ik gemini-1200ik-hf "
      "micron seaking seaking-hf imagenex-881l-lf imagenex-881l imagenex-881l-hf imagenex-837 ping360 "
      "seabat-t50 r2sonic-2024 em2040 norbit-wbms waterlinked-3d15 waterlinked-3d15-hf echoscope "
      "edgetech-4125 edgetech-4125-hf klein-3000 klein-3000-lf omniscan-450 starfish-450 starfish-990 "
      "es200-7c ping2 seaking-profiler thesis-table2 sm2000-90");
  for (std::string name; shipped >> name;) EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
}

TEST(Presets, are_named_like_their_file_and_described_in_one_line) {
  for (const auto& sonar : list_sonars()) {
    EXPECT_EQ(std::filesystem::path(sonar.path).stem().string(), sonar.spec.name);
    EXPECT_FALSE(sonar.description.empty()) << sonar.path;
    EXPECT_LE(sonar.description.size(), 80u) << sonar.path;
    EXPECT_EQ(sonar.description.find('\n'), std::string::npos);
  }
}

TEST(Presets, give_status_and_source_of_every_number) {
  const std::set<std::string> known = {"sourced", "recalled", "derived", "assumed", "unknown"};
  for (const auto& sonar : list_sonars()) {
    EXPECT_GE(sonar.numbers.size(), 12u) << sonar.path;
    for (const auto& number : sonar.numbers) {
      EXPECT_TRUE(known.count(number.status)) << sonar.spec.name << " " << number.key << " " << number.status;
      EXPECT_FALSE(number.source.empty()) << sonar.spec.name << " " << number.key;
      EXPECT_EQ(number.source.find("default of insonify"), std::string::npos) << sonar.spec.name << " " << number.key;
    }
  }
}

TEST(Presets, shade_their_array_except_the_thesis) {
  for (const auto& sonar : list_sonars())
    EXPECT_EQ(sonar.spec.side_lobe_db, sonar.spec.name == "thesis-table2" ? 0 : -30) << sonar.spec.name;
}

TEST(Presets, build_a_head_in_nominal_water) {
  for (const auto& sonar : list_sonars()) {
    const SonarHead head = make_head(sonar.spec, nominal_sound_speed);
    EXPECT_EQ(head.fan.beams(), beams_of(sonar.spec)) << sonar.spec.name;
    EXPECT_GT(head.gate.bins(), 100u) << sonar.spec.name;
    EXPECT_LT(head.gate.bins(), 200000u) << sonar.spec.name;
  }
}

// Datasheet DA-148-P01443-10: 750 kHz, 130 x 20 deg, 512 beams of 1.0 deg, 0.1-120 m, 4 mm.
TEST(Presets, oculus_m750d_is_its_datasheet) {
  const SonarSpec s = find_sonar("oculus-m750d").spec;
  EXPECT_EQ(s.centre_frequency, 750e3);
  EXPECT_EQ(s.bandwidth, 1500 / (2 * 0.004));
  EXPECT_EQ(s.source_level_db, 220);
  EXPECT_EQ(s.beams, 512u);
  EXPECT_EQ(s.field_of_view, radians(130));
  EXPECT_EQ(s.beam_width, radians(1));
  EXPECT_EQ(s.elevation_width, radians(20));
  EXPECT_EQ(s.min_range, 0.1);
  EXPECT_EQ(s.max_range, 120);
}

// A. Rascon, NPS thesis, Table 2: beam width 0.1 rad, resolution one inch.
TEST(Presets, thesis_table_2_is_the_thesis) {
  const SonarSpec s = find_sonar("thesis-table2").spec;
  EXPECT_EQ(s.centre_frequency, 900e3);
  EXPECT_NEAR(s.bandwidth, 29527.56, 0.01);
  EXPECT_DOUBLE_EQ(s.beam_width, 0.1);
  EXPECT_EQ(s.beams, 256u);
  EXPECT_EQ(s.field_of_view, radians(45));
  EXPECT_EQ(s.elevation_width, radians(20));
  EXPECT_EQ(s.min_range, 2);
  EXPECT_EQ(s.max_range, 60);
}

TEST(Presets, list_the_derived_bandwidth) {
  std::map<std::string, SourcedNumber> numbers;
  for (const auto& number : find_sonar("oculus-m750d").numbers) numbers[number.key] = number;
  EXPECT_EQ(numbers["range_resolution_m"].value, "0.004");
  EXPECT_EQ(numbers["range_resolution_m"].status, "sourced");
  EXPECT_EQ(numbers["bandwidth_hz"].value, "187500.0");
  EXPECT_EQ(numbers["bandwidth_hz"].status, "derived");
  EXPECT_EQ(numbers["source_level_db"].status, "assumed");
}

TEST(FindSonar, suggests_names_that_contain_the_word_or_resemble_it) {
  const std::string end = " `insonify sonars` lists all; a path ending in .toml is read as a file";
  EXPECT_EQ(error_with_kind([] { find_sonar("p900-54"); }),
            "argument: sonar 'p900-54' is not a preset; did you mean p900-45?" + end);
  EXPECT_EQ(error_with_kind([] { find_sonar("M750d"); }),
            "argument: sonar 'M750d' is not a preset; did you mean oculus-m750d, oculus-m750d-hf?" + end);
  EXPECT_EQ(error_with_kind([] { find_sonar("submarine"); }), "argument: sonar 'submarine' is not a preset." + end);
  EXPECT_EQ(error_with_kind([] { find_sonar("../sonars/p900-45"); }).substr(0, 18), "argument: sonar '.");
}

TEST(FindSonar, reads_a_path_that_ends_in_toml) {
  EXPECT_EQ(find_sonar(INSONIFY_DATA "/sonars/micron.toml").spec.name, "micron");
  EXPECT_EQ(error_with_kind([] { find_sonar("no/such.toml"); }), "file: no/such.toml: no such file; check the path");
}

TEST(DataFolder, is_found_without_help_and_holds_the_data) {
  EXPECT_TRUE(std::filesystem::exists(data_folder() + "/sonars/p900-45.toml"));
  EXPECT_TRUE(std::filesystem::exists(data_folder() + "/materials.toml"));
}

TEST(DataFolder, is_the_one_in_the_environment_or_an_error) {
  std::filesystem::create_directories(own_path("mine/sonars"));
  {
    const DataFolder mine(own_path("mine"));
    EXPECT_EQ(data_folder(), own_path("mine"));
    EXPECT_TRUE(list_sonars().empty());
  }
  const DataFolder wrong(own_path("nowhere"));
  EXPECT_EQ(error_with_kind([] { data_folder(); }),
            "file: INSONIFY_DATA = " + own_path("nowhere") + ": is not a folder with sonars/ in it");
}
