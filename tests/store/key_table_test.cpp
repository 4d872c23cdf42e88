// SPDX-License-Identifier: BSD-3-Clause
// The tables of keys of files are those of the docs.
#include <regex>

#include "store/environment_keys.hpp"
#include "store/material_keys_internal.hpp"
#include "store/mission_keys_internal.hpp"
#include "store/scene_file_keys_internal.hpp"
#include "store/sonar_keys.hpp"
#include "support/page.hpp"
#include "support/test.hpp"

namespace key_tables {

/// Returns the links of a help text as a page of docs/reference has them: one folder up.
std::string links_from_reference(const std::string& help) {
  return std::regex_replace(help, std::regex(R"(\]\(([a-z-]+\.md))"), "](../$1");
}

/// Returns the keys as a section of a page: a heading and the rows key, unit, default, rule, help.
std::string section(const std::string& heading, const std::vector<Key>& keys) {
  std::string rows = "\n## " + heading + "\n\n| key | unit | default | must be | what |\n|---|---|---|---|---|\n";
  for (const Key& key : keys) {
    const bool in_help = key.help.find("default") != std::string::npos;
    const std::string preset = key.required ? "required" : in_help ? "" : key.value.text().value_or("");
    rows += "|" + table_cell("`" + names_of({key}).front() + "`") + table_cell(key.unit) + table_cell(preset) +
            table_cell(key.value.rule) +
            table_cell(links_from_reference(key.help) +
                       (*key.unless ? std::string("; not beside `") + key.unless + "`" : "")) +
            "\n";
  }
  return rows;
}

}  // namespace key_tables

TEST(KeyTables, are_those_of_the_page_of_keys) {
  using key_tables::section;
  SonarSpec sonar;
  Environment environment;
  environment.surface.emplace(), environment.bottom.emplace();
  MirrorEntry mirror;
  MaterialEntry material;
  MissionTables tables;
  MissionFile mission;
  SceneTables scene;
  expect_reference_page(
      "keys.md",
      "# All keys of TOML files\n\n"
      "[keys.md](../keys.md) explains sonars, environments and materials, [survey.md](../survey.md) missions,\n"
      "[scenes.md](../scenes.md) scenes of parts. Without an entry under \"default\" a key is empty or absent by "
      "default.\n" +
          section("Environment", environment_keys(environment)) + section("Mirrors", mirror_keys(mirror)) +
          section("Sonar", sonar_keys(sonar)) + section("Materials", material_keys(material)) +
          section("Missions", mission_keys(tables, mission)) + section("Parts of scenes", scene_part_keys(scene)) +
          section("Scatters", scene_scatter_keys(scene)));
}

TEST(KeyTables, read_what_they_write_and_name_what_breaks_a_rule) {
  double width = radians(12.5);
  std::uint64_t many = ~std::uint64_t{0};
  std::string word_value = "b";
  const std::vector<Key> keys = {{"", "seed", "", seed(many), ""},
                                 {"fan", "width_deg", "deg", angle(width, {.least = 0, .most = 90, .above = true}), ""},
                                 {"fan", "word", "", word(word_value, {"a", "b"}), ""}};
  const std::string text = keys_as_toml(keys);
  EXPECT_EQ(text, "seed = \"18446744073709551615\"\n\n[fan]\nwidth_deg = 12.5\nword = \"b\"\n");
  many = 0, width = 0, word_value = "a";
  read_keys("f.toml", load_toml(own_file("f.toml", text)), keys);
  EXPECT_EQ(many, ~std::uint64_t{0});
  EXPECT_EQ(width, radians(12.5));
  EXPECT_EQ(word_value, "b");
  const auto refusal = [&](const std::string& file) {
    return error_with_kind([&] { read_keys("f.toml", load_toml(own_file("f.toml", file)), keys); });
  };
  EXPECT_EQ(refusal("[fan]\nwidth_deg = 91\n"),
            "content: f.toml:2: fan.width_deg = 91 deg, must be a number > 0 and at most 90");
  EXPECT_EQ(refusal("[fan]\nword = \"c\"\n"), "content: f.toml:2: fan.word = \"c\", must be one of a, b");
  EXPECT_EQ(refusal("width_deg = 3\n"), "content: f.toml:1: unknown key 'width_deg'; did you mean 'fan.width_deg'?");
  EXPECT_EQ(refusal("[fun]\n"), "content: f.toml:1: unknown table [fun]; did you mean [fan]?");
  EXPECT_EQ(refusal("fan = 3\n"), "content: f.toml:1: fan = 3, must be a table with keys of its own");
  EXPECT_EQ(error_with_kind([&] { set_key(keys, "fan.width_deg", "wide", "x: "); }),
            "argument: x: fan.width_deg = \"wide\", must be a number > 0 and at most 90");
  set_key(keys, "fan.width_deg", "30", "");
  EXPECT_EQ(width, radians(30));
}
