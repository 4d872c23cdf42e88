// SPDX-License-Identifier: BSD-3-Clause
#include "store/materials_file.hpp"

#include <tuple>

#include "acoustics/surface_laws.hpp"
#include "store/material_library.hpp"
#include "support/errors.hpp"
#include "support/test.hpp"

namespace {

std::string error_of_materials(const std::string& text) { return error_of_file(load_materials, "m.toml", text); }

void refuses_materials(const std::string& text, const std::string& what) {
  EXPECT_EQ(error_of_materials(text), "content: m.toml:" + what);
}

Material shipped(const std::string& name) {
  for (const auto& m : load_materials(INSONIFY_DATA "/materials.toml").materials)
    if (m.material.name == name) return m.material;
  ADD_FAILURE() << "no material " << name;
  return {};
}

}  // namespace

TEST(Materials, are_read_with_their_origin) {
  const auto list = load_materials(own_file("m.toml",
                                            "schema = 1\n[[material]]\nname = \"mud\"\nlambert_mu_db = -20\nstatus = "
                                            "\"sourced\"\nsource = \"a paper\"\n"
                                            "[[material]]\nname = \"weed\"\nlabel = 5\nlambert_mu_db = -30.0\n"
                                            "coherent_fraction = 0.25\nrelief_slope = 0.1\n"))
                        .materials;
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].material.name, "mud");
  EXPECT_DOUBLE_EQ(list[0].material.lambert_mu, 0.01);
  EXPECT_EQ(list[0].label, 0);
  EXPECT_EQ(list[0].status, "sourced");
  EXPECT_EQ(list[0].source, "a paper");
  EXPECT_EQ(list[1].label, 5);
  EXPECT_EQ(list[1].status, "user");
  for (const MaterialNumber& n : material_numbers) {
    if (n.required) continue;
    EXPECT_EQ(list[0].material.*n.member, Material{}.*n.member) << n.key;
  }
  EXPECT_EQ(list[1].material.coherent_fraction, 0.25);
  EXPECT_EQ(list[1].material.relief_slope, 0.1);
}

TEST(Materials, may_be_mirrors_and_targets) {
  const std::string head = "schema = 1\n[[material]]\nname = \"quay\"\nlambert_mu_db = -20\n";
  const Material quay =
      load_materials(own_file("m.toml", head + "mirror = true\nmirror_reflection = 0.7\nrms_height_m = 0.01\n"
                                               "coherent = \"fit\"\n"))
          .materials[0]
          .material;
  EXPECT_EQ(quay.mirror, 1);
  EXPECT_EQ(quay.coherent, 1);
  EXPECT_EQ(quay.reflection, 0.7);
  EXPECT_EQ(quay.rms_height, 0.01);
  EXPECT_FALSE(is_smooth(load_materials(own_file("n.toml", head + "mirror = false\n")).materials[0].material));
  expect_error(ErrorKind::content, {"m.toml:5", "mirror", "true or false"},
               [&] { load_materials(own_file("m.toml", head + "mirror = 1\n")); });
  expect_error(ErrorKind::content, {"coherent", "must be \"fit\""},
               [&] { load_materials(own_file("m.toml", head + "coherent = \"fitted\"\n")); });
  expect_error(ErrorKind::content, {"did you mean 'material.mirror'?"},
               [&] { load_materials(own_file("m.toml", head + "miror = true\n")); });
}

TEST(Materials, may_be_intervals_of_any_scalar_field) {
  const MaterialTable table =
      load_materials(own_file("m.toml",
                              "schema = 1\nfield = \"Intensity\"\n"
                              "[[material]]\nname = \"mud\"\nlambert_mu_db = -20\nto = 80\n"
                              "[[material]]\nname = \"weed\"\nlambert_mu_db = -30\nlabel = 7\nfrom = 80\nto = 120.5\n"
                              "[[material]]\nname = \"rock\"\nlambert_mu_db = -10\nfrom = 200\n"
                              "[[material]]\nname = \"unused\"\nlambert_mu_db = -10\n"));
  EXPECT_EQ(table.field.name, "Intensity");
  ASSERT_EQ(table.field.intervals.size(), 3u);
  const double infinity = std::numeric_limits<double>::infinity();
  const double from[] = {-infinity, 80, 200}, to[] = {80, 120.5, infinity};
  const std::uint16_t label[] = {0, 7, 2};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(table.field.intervals[i].from, from[i]);
    EXPECT_EQ(table.field.intervals[i].to, to[i]);
    EXPECT_EQ(materials_by_label(table)[table.field.intervals[i].material].name, table.materials[i].material.name);
    EXPECT_EQ(table.field.intervals[i].material, label[i]);
  }
  const MaterialTable shipped_table = load_materials(INSONIFY_DATA "/materials.toml");
  EXPECT_EQ(shipped_table.field.name, "");
  EXPECT_TRUE(shipped_table.field.intervals.empty());
}

TEST(Materials, refuse_intervals_that_overlap_or_hold_nothing) {
  const auto two = [](const std::string& first, const std::string& second) {
    return "schema = 1\n[[material]]\nname = \"x\"\nlambert_mu_db = -20\n" + first +
           "\n[[material]]\nname = \"y\"\nlambert_mu_db = -20\n" + second + "\n";
  };
  refuses_materials(
      two("to = 10", "from = 9.5"),
      "9: interval 9.5 .. inf of 'y' overlaps -inf .. 10, listed before; each value must belong to one material");
  refuses_materials(two("from = 4", "from = 3\nto = 3"), "9: from = 3 of 'y', must be below to = 3");
  refuses_materials(two("from = nan", ""), "5: from = nan of 'x', must be below to = inf");
  refuses_materials(two("from = \"a\"", ""), "5: material.from = \"a\", must be a number");
  EXPECT_EQ(load_materials(own_file("touching.toml", two("to = 10", "from = 10"))).field.intervals.size(), 2u);
}

TEST(Materials, refuse_fractions_and_slopes_that_no_surface_has) {
  const std::string start = "schema = 1\n[[material]]\nname = \"x\"\nlambert_mu_db = -20\n";
  refuses_materials(start + "coherent_fraction = 1.5\n",
                    "5: material.coherent_fraction = 1.5, must be a number within 0 and 1");
  refuses_materials(start + "coherent_fraction = -0.1\n",
                    "5: material.coherent_fraction = -0.1, must be a number within 0 and 1");
  refuses_materials(start + "relief_slope = 20\n",
                    "5: material.relief_slope = 20, must be a number within 0 and 1 (rise over run, rms: 45 degrees)");
  refuses_materials(start + "relief_slop = 0.1\n",
                    "5: unknown key 'material.relief_slop'; did you mean 'material.relief_slope'?");
}

TEST(Materials, may_be_silent_but_not_louder_than_what_arrives) {
  const auto with = [](const std::string& db) {
    return "schema = 1\n[[material]]\nname = \"x\"\nlambert_mu_db = " + db + "\n";
  };
  EXPECT_EQ(load_materials(own_file("m.toml", with("-inf"))).materials[0].material.lambert_mu, 0);
  EXPECT_EQ(load_materials(own_file("m.toml", with("-4.97"))).materials[0].material.lambert_mu, 1 / pi);
  refuses_materials(with("-4.9"),
                    "4: material.lambert_mu_db = -4.9 dB, must be a number at most -4.97 (1/pi: no surface sends back "
                    "more than it receives)");
  EXPECT_THAT(error_of_materials(with("nan")), HasSubstr("m.toml:4: material.lambert_mu_db = nan dB, must be"));
}

TEST(Materials, by_label_have_their_label_as_index_and_gaps_are_filled) {
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
  refuses_materials(start + "lambert_mu = -20\n",
                    "4: unknown key 'material.lambert_mu'; did you mean 'material.lambert_mu_db'?");
  refuses_materials(start, "2: missing key 'material.lambert_mu_db'");
  refuses_materials(start + "lambert_mu_db = \"loud\"\n",
                    "4: material.lambert_mu_db = \"loud\", must be a number at most -4.97 (1/pi: no surface sends back "
                    "more than it receives)");
  refuses_materials("schema = 1\n[[material]]\nname = 7\nlambert_mu_db = -20\n",
                    "3: material.name = 7, must be text in quotes");
  refuses_materials(start + "lambert_mu_db = -20\nlabel = 1.5\n",
                    "5: material.label = 1.5, must be a whole number within 0 and 65535");
  refuses_materials(start + "lambert_mu_db = -20\nlabel = 65536\n",
                    "5: material.label = 65536, must be a whole number within 0 and 65535");
  refuses_materials("schema = 1\nmaterials = []\n", "2: unknown key 'materials'; did you mean 'material'?");
  refuses_materials("schema = 1\n", "1: missing key 'material'");
  refuses_materials("schema = 1\nmaterial = [1]\n", "2: material = [1], must be a list of tables [[...]]");
  refuses_materials("schema = 2\n", "1: schema = 2, this version reads schema 1; the file is of a newer insonify");
  refuses_materials("[[material]]\n", "1: missing key 'schema'");
}

TEST(Materials, refuse_a_label_or_name_given_twice) {
  const std::string two =
      "schema = 1\n[[material]]\nname = \"x\"\nlambert_mu_db = -20\n"
      "[[material]]\nname = \"y\"\nlabel = 0\nlambert_mu_db = -20\n";
  refuses_materials(two, "5: label 0 of 'y' belongs to 'x' already");
  refuses_materials(replaced(replaced(two, "\"y\"", "\"x\""), "= 0", "= 4"), "5: material 'x' is listed twice");
}

TEST(ShippedMaterials, start_with_the_default_and_have_a_source_each) {
  const auto list = load_materials(INSONIFY_DATA "/materials.toml").materials;
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
  for (const auto& [name, density, speed] : {std::tuple("titanium", 4500, 6070), std::tuple("aluminium", 2700, 6320),
                                             std::tuple("polyethylene", 950, 2400)}) {
    const double z = 1.0 * density * speed, ratio = (z - water) / (z + water);
    EXPECT_NEAR(db_from_power(shipped(name).lambert_mu), db_from_power(ratio * ratio / pi), 0.03) << name;
  }
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

// Numbers of files are in their own units, and a material that is like another has all of its numbers but those given.
TEST(MaterialLaws, are_read_with_units_and_defaults_of_others) {
  const auto list =
      load_materials(
          own_file(
              "m.toml",
              "schema = 1\n[[material]]\nname = \"a\"\nlaw = \"rough\"\nslope = 0.25\nmicro_roughness_mm = "
              "0.5\ndiffuse_mu_db = -20\n"
              "density = 2300\ncompression_speed = 4000\nshear_speed = 2400\n"
              "[[material]]\nname = \"b\"\nlike = \"coarse-sand@small_slope\"\nloss = 0.02\ncoherent_fraction = 0.5\n"
              "[[material]]\nname = \"c\"\nlike = \"fine-sand\"\nlambert_mu_db = -20\n"
              "[[material]]\nname = \"d\"\nlaw = \"table\"\nincidence_deg = [0, 45, 80]\nfrequency_khz = [100, 300]\n"
              "sigma_db = [-10, -20, -30, -11, -21, -31]\nbistatic = \"half_vector\"\n"))
          .materials;
  const auto& rough = std::get<RoughLaw>(list[0].material.law);
  EXPECT_EQ(rough, (RoughLaw{0.25, 0.5e-3, 0.01, 1, 2300, 4000, 2400}));
  const auto& sand = std::get<SmallSlopeLaw>(list[1].material.law);
  EXPECT_EQ(sand.loss, 0.02);
  EXPECT_EQ(sand.speed_ratio, 1.2503);
  EXPECT_DOUBLE_EQ(sand.grain_size, 0.707e-3);
  EXPECT_EQ(list[1].material.coherent_fraction, 0.5);
  EXPECT_EQ(list[2].material.law, SurfaceLaw{});
  EXPECT_DOUBLE_EQ(list[2].material.lambert_mu, 0.01);
  EXPECT_EQ(list[3].material.law,
            SurfaceLaw(TableLaw{{0, radians(45), radians(80)}, {1e5, 3e5}, {-10, -20, -30, -11, -21, -31}, true}));
}

TEST(MaterialLibrary, has_sources_and_names_that_lead_back) {
  const std::vector<MaterialFile> all = list_materials();
  EXPECT_GE(all.size(), 2 * 11 + 13U);
  for (const MaterialFile& file : all) {
    EXPECT_EQ(find_material(file.material.name), file.material);
    EXPECT_FALSE(file.description.empty());
    for (const SourcedNumber& n : file.numbers) EXPECT_FALSE(n.source.empty()) << file.path << ": " << n.key;
    EXPECT_EQ(error_of([&] { require_energy(file.material, "here"); }), "no error") << file.material.name;
  }
  EXPECT_EQ(find_material("medium-sand"), find_material("medium-sand@seabed"));
  EXPECT_EQ(find_material("steel").law, SurfaceLaw{});  // of Lambert's table
  EXPECT_THAT(error_of([] { find_material("medium-snad"); }), HasSubstr("did you mean 'medium-sand'"));
}
