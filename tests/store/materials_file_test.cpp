#include "store/materials_file.hpp"

#include "core/units.hpp"
#include "store_testing.hpp"

using namespace insonify;

namespace {

std::string error_of_materials(const std::string& text) {
  const std::string path = own_file("m.toml", text);
  return replaced(error_of([&] { load_materials(path); }), path, "m.toml");
}

Material shipped(const std::string& name) {
  for (const auto& m : load_materials(INSONIFY_DATA "/materials.toml"))
    if (m.material.name == name) return m.material;
  ADD_FAILURE() << "no material " << name;
  return {};
}

}  // namespace

TEST(Materials, are_read_with_their_origin) {
  const auto list = load_materials(own_file("m.toml",
                                            "schema = 1\n[[material]]\nname = \"mud\"\nlambert_mu_db = -20\nstatus = "
                                            "\"sourced\"\nsource = \"a paper\"\n"
                                            "[[material]]\nname = \"weed\"\nlabel = 5\nlambert_mu_db = -30.0\n"));
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].material.name, "mud");
  EXPECT_DOUBLE_EQ(list[0].material.lambert_mu, 0.01);
  EXPECT_EQ(list[0].label, 0);
  EXPECT_EQ(list[0].status, "sourced");
  EXPECT_EQ(list[0].source, "a paper");
  EXPECT_EQ(list[1].label, 5);
  EXPECT_EQ(list[1].status, "user");
}

TEST(Materials, may_be_silent_but_not_louder_than_what_arrives) {
  const auto with = [](const std::string& db) {
    return "schema = 1\n[[material]]\nname = \"x\"\nlambert_mu_db = " + db + "\n";
  };
  EXPECT_EQ(load_materials(own_file("m.toml", with("-inf")))[0].material.lambert_mu, 0);
  EXPECT_EQ(load_materials(own_file("m.toml", with("-4.97")))[0].material.lambert_mu, 1 / pi);
  EXPECT_EQ(error_of_materials(with("-4.9")),
            "content: m.toml:4: lambert_mu_db = -4.9 dB, must be at most -4.97 dB (1/pi: no surface sends "
            "back more "
            "than it receives)");
  EXPECT_NE(error_of_materials(with("nan")).find("m.toml:4: lambert_mu_db = nan dB, must be"), std::string::npos);
}

TEST(Materials, by_label_stand_at_their_label_and_gaps_are_filled) {
  const auto list = load_materials(own_file("m.toml",
                                            "schema = 1\n[[material]]\nname = \"b\"\nlabel = 3\nlambert_mu_db = -20\n"
                                            "[[material]]\nname = \"a\"\nlabel = 1\nlambert_mu_db = -10\n"));
  const auto materials = materials_by_label(list);
  ASSERT_EQ(materials.size(), 4u);
  EXPECT_EQ(materials[0].name, "unlabelled");
  EXPECT_EQ(materials[0].lambert_mu, Material{}.lambert_mu);
  EXPECT_EQ(materials[1].name, "a");
  EXPECT_EQ(materials[2].name, "unlabelled");
  EXPECT_EQ(materials[3].name, "b");
  EXPECT_TRUE(materials_by_label({}).empty());
}

TEST(Materials, errors_name_line_key_and_remedy) {
  const std::string start = "schema = 1\n[[material]]\nname = \"x\"\n";
  EXPECT_EQ(error_of_materials(start + "lambert_mu = -20\n"),
            "content: m.toml:4: unknown key 'lambert_mu'; did you mean 'lambert_mu_db'?");
  EXPECT_EQ(error_of_materials(start), "content: m.toml:2: missing key 'lambert_mu_db'");
  EXPECT_EQ(error_of_materials(start + "lambert_mu_db = \"loud\"\n"),
            "content: m.toml:4: lambert_mu_db must be a number");
  EXPECT_EQ(error_of_materials("schema = 1\n[[material]]\nname = 7\nlambert_mu_db = -20\n"),
            "content: m.toml:3: name must be text in quotes");
  EXPECT_EQ(error_of_materials(start + "lambert_mu_db = -20\nlabel = 1.5\n"),
            "content: m.toml:5: label = 1.5, must be a whole number within 0 and 65535");
  EXPECT_EQ(error_of_materials(start + "lambert_mu_db = -20\nlabel = 65536\n"),
            "content: m.toml:5: label = 65536, must be a whole number within 0 and 65535");
  EXPECT_EQ(error_of_materials("schema = 1\nmaterials = []\n"),
            "content: m.toml:2: unknown key 'materials'; did you mean 'material'?");
  EXPECT_EQ(error_of_materials("schema = 1\n"), "content: m.toml:1: no [[material]] in the file");
  EXPECT_EQ(error_of_materials("schema = 1\nmaterial = [1]\n"),
            "content: m.toml:2: material must be a table: [[material]]");
  EXPECT_EQ(error_of_materials("schema = 2\n"), "content: m.toml:1: schema = 2, this insonify reads schema 1");
  EXPECT_EQ(error_of_materials("[[material]]\n"), "content: m.toml:1: missing key 'schema'");
}

TEST(Materials, refuse_a_label_or_name_given_twice) {
  const std::string two =
      "schema = 1\n[[material]]\nname = \"x\"\nlambert_mu_db = -20\n"
      "[[material]]\nname = \"y\"\nlabel = 0\nlambert_mu_db = -20\n";
  EXPECT_EQ(error_of_materials(two), "content: m.toml:5: label 0 of 'y' belongs to 'x' already");
  EXPECT_EQ(error_of_materials(replaced(replaced(two, "\"y\"", "\"x\""), "= 0", "= 4")),
            "content: m.toml:5: material 'x' is listed twice");
}

TEST(ShippedMaterials, start_with_the_default_and_have_a_source_each) {
  const auto list = load_materials(INSONIFY_DATA "/materials.toml");
  EXPECT_GE(list.size(), 20u);
  EXPECT_EQ(list[0].label, 0);
  EXPECT_EQ(list[0].material.name, "default");
  EXPECT_DOUBLE_EQ(list[0].material.lambert_mu, Material{}.lambert_mu);
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(list[i].label, static_cast<int>(i)) << list[i].material.name;
    EXPECT_GT(list[i].material.lambert_mu, 0);
    EXPECT_LE(list[i].material.lambert_mu, 1 / pi);
    EXPECT_TRUE(list[i].status == "sourced" || list[i].status == "derived") << list[i].material.name;
    EXPECT_FALSE(list[i].source.empty()) << list[i].material.name;
  }
}

// Impedances from handbook density and sound speed: steel 7850 kg/m^3 x 5900 m/s in water 1026 x 1500 gives
// R = 0.9357 and R^2 / pi = 0.2787; concrete R = 0.705, PVC R = 0.362.
TEST(ShippedMaterials, hard_ones_are_bounded_by_their_reflectivity) {
  const double water = 1026 * 1500, steel = 7850 * 5900;
  const double r = (steel - water) / (steel + water);
  EXPECT_NEAR(db_from_power(shipped("steel").lambert_mu), db_from_power(r * r / pi), 0.02);
  EXPECT_NEAR(shipped("concrete").lambert_mu, 0.705 * 0.705 / pi, 3e-4);
  EXPECT_NEAR(shipped("pvc").lambert_mu, 0.362 * 0.362 / pi, 3e-4);
}

TEST(ShippedMaterials, sea_beds_get_quieter_from_rock_to_clay) {
  const char* order[] = {"rough-rock", "rock",      "gravel",      "sandy-gravel", "coarse-sand",
                         "sand",       "fine-sand", "coarse-silt", "silt",         "clay"};
  for (std::size_t i = 1; i < std::size(order); ++i)
    EXPECT_LE(shipped(order[i]).lambert_mu, shipped(order[i - 1]).lambert_mu) << order[i];
  EXPECT_EQ(shipped("rough-rock").lambert_mu, 1 / pi);
}
