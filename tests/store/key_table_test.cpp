// SPDX-License-Identifier: BSD-3-Clause
// The tables of keys of files are those of the docs.
#include <fstream>
#include <sstream>

#include "store/environment_keys_internal.hpp"
#include "store/material_keys_internal.hpp"
#include "store/mission_keys_internal.hpp"
#include "store/scene_file_keys_internal.hpp"
#include "store/sonar_keys_internal.hpp"
#include "support/test.hpp"

namespace key_tables {

std::string page(const std::string& name) {
  std::stringstream text;
  text << std::ifstream(std::string(INSONIFY_DOCS) + "/" + name).rdbuf();
  return text.str();
}

/// A cell of a table in Markdown.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text.empty() ? " |" : " " + text + " |";
}

/// The keys as rows of a table in Markdown: key, unit, default, rule, help.
std::string keys_as_markdown(const std::vector<Key>& keys) {
  std::string rows = "| key | unit | default | must be | what |\n|---|---|---|---|---|\n";
  for (const Key& key : keys) {
    const bool in_help = key.help.find("default") != std::string::npos;
    const std::string preset = key.required ? "required" : in_help ? "" : key.value.text().value_or("");
    rows += "|" + cell("`" + names_of({key}).front() + "`") + cell(key.unit) + cell(preset) + cell(key.value.rule) +
            cell(key.help + (*key.unless ? std::string("; not beside `") + key.unless + "`" : "")) + "\n";
  }
  return rows;
}

void expect_on(const std::string& name, const std::vector<Key>& keys) {
  const std::string text = page(name), table = keys_as_markdown(keys);
  std::stringstream rows(table);
  for (std::string row; std::getline(rows, row);)
    if (text.find(row + "\n") == text.npos) ADD_FAILURE() << "docs/" << name << " lacks this row:\n" << row;
  EXPECT_TRUE(text.find(table) != text.npos) << "docs/" << name << " must hold the rows in this order, and no other:\n"
                                             << table;
}

}  // namespace key_tables

TEST(KeyTables, of_the_docs_are_those_of_the_code) {
  SonarSpec sonar;
  key_tables::expect_on("keys.md", sonar_keys(sonar));
  Environment environment;
  environment.surface.emplace(), environment.bottom.emplace();
  key_tables::expect_on("keys.md", environment_keys(environment));
  MirrorEntry mirror;
  key_tables::expect_on("keys.md", mirror_keys(mirror));
  MaterialEntry material;
  key_tables::expect_on("keys.md", material_keys(material));
  MissionTables tables;
  MissionFile mission;
  key_tables::expect_on("survey.md", mission_keys(tables, mission));
  SceneTables scene;
  key_tables::expect_on("scenes.md", scene_part_keys(scene));
  key_tables::expect_on("scenes.md", scene_scatter_keys(scene));
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
