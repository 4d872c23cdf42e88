// SPDX-License-Identifier: BSD-3-Clause
// Objects from the command line: lists, meshes with their materials, what a ping receives of them.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "scene/objects.hpp"
#include "scene_io/load_scene.hpp"
#include "store/contributor_file.hpp"
#include "store/material_library.hpp"
#include "support/page.hpp"
#include "tool/scene/object_list.hpp"
#include "tool/tool_runner.hpp"

using namespace insonify;

namespace {

class MakeObject : public ToolTest {
 protected:
  /// The sum of the intensities of all beams and bins of a run [dB].
  double energy_db(const std::string& run) const {
    return db_from_power(ping_of(run).pressure.abs2().cast<double>().sum());
  }
};

std::vector<std::string> names_of(const std::vector<Material>& materials) {
  std::vector<std::string> names;
  for (const Material& material : materials) names.push_back(material.name);
  return names;
}

}  // namespace

TEST_F(MakeObject, lists_objects_and_their_options) {
  const std::string all = succeed("make-object");
  EXPECT_EQ(succeed("make-object --list"), all);
  const nlohmann::json json = json_of("make-object");
  ASSERT_EQ(json.size(), object_kinds().size());
  for (const ObjectKind& kind : object_kinds()) {
    EXPECT_THAT(all, HasSubstr(std::string("\n") + kind.name + " "));
    const std::string one = succeed(std::string("make-object ") + kind.name + " --list");
    EXPECT_THAT(one, HasSubstr(kind.source));
    for (const ObjectOption& option : options_of(kind))
      EXPECT_THAT(one, HasSubstr(std::string("\n") + option.key + " "));
  }
  EXPECT_EQ(json[3]["name"], "tyre");
  EXPECT_NEAR(json[3]["size_m"][0], 0.632, 1e-6);
  EXPECT_EQ(json_of("make-object tyre --list")["options"][0]["default"], 0.632);
}

TEST_F(MakeObject, writes_meshes_that_read_back_with_their_materials) {
  for (const ObjectKind& kind : object_kinds()) {
    const std::string file = std::string(kind.name) + ".ply";
    const nlohmann::json said = json_of("make-object " + std::string(kind.name) + " -o " + file);
    const SceneMesh made = make_object(kind.name);
    const LoadedScene loaded = load_scene(path(file));
    ASSERT_TRUE(loaded.mesh) << kind.name;
    EXPECT_EQ(loaded.mesh->point, made.point) << kind.name;
    EXPECT_EQ(loaded.mesh->normal, made.normal) << kind.name;
    EXPECT_EQ(loaded.mesh->triangle, made.triangle) << kind.name;
    EXPECT_EQ(loaded.mesh->material, made.material) << kind.name;
    EXPECT_TRUE(loaded.mesh->normals_oriented) << kind.name;
    EXPECT_TRUE(loaded.report.notes.empty()) << kind.name << ": " << loaded.report.notes.front();
    ASSERT_EQ(loaded.mesh->materials.size(), kind.materials.size()) << kind.name;
    for (std::size_t m = 0; m < kind.materials.size(); ++m)
      EXPECT_EQ(loaded.mesh->materials[m], find_material(kind.materials[m])) << kind.name;
    EXPECT_EQ(said["triangles"], made.triangle.size());
    EXPECT_EQ(said["materials"], kind.materials.size() == 1 ? nlohmann::json{kind.materials[0]} : said["materials"]);
    EXPECT_THAT(succeed("info " + file), HasSubstr(kind.materials[0]));
  }
}

TEST_F(MakeObject, takes_sizes_and_materials) {
  succeed("make-object cylinder-mine -o mine.ply --set length_m=1.5 --set upright=1 --material steel@rough");
  const LoadedScene mine = load_scene(path("mine.ply"));
  EXPECT_NEAR(bounds(mine.scene).max.z(), 1.5, 0.01);
  EXPECT_EQ(mine.mesh->materials, std::vector<Material>{find_material("steel@rough")});

  succeed("make-object diver -o diver.ply --material wet-suit=gum-rubber --material aluminium=steel");
  EXPECT_EQ(names_of(load_scene(path("diver.ply")).mesh->materials),
            (std::vector<std::string>{"gum-rubber@rough", "rubber", "steel"}));
  succeed("make-object diver -o one.ply --material steel");
  EXPECT_EQ(names_of(load_scene(path("one.ply")).mesh->materials), std::vector<std::string>{"steel"});
}

TEST_F(MakeObject, is_prepared_and_pinged_by_material) {
  succeed("make-object diver -o diver.ply");
  succeed("prepare diver.ply --mesh-spacing 0.02 -o surfels.ply");
  const LoadedScene surfels = load_scene(path("surfels.ply"));
  EXPECT_FALSE(surfels.mesh);
  EXPECT_EQ(names_of(surfels.scene.materials), (std::vector<std::string>{"wet-suit", "rubber", "aluminium"}));
  EXPECT_EQ(std::set(surfels.scene.material.begin(), surfels.scene.material.end()).size(), 3u);
  succeed(
      "ping diver.ply --sonar p900-45 --pose=-6,0,0.3,0,0,0 --range 3:9 --keep contributors --no-picture -q -o out");
  const NamedContributors named = read_contributor_file(path("out/contributors.h5"));
  EXPECT_EQ(named.materials, (std::vector<std::string>{"wet-suit", "rubber", "aluminium"}));
  std::set<int> beam_azimuth(named.contributors.material.begin(), named.contributors.material.end());
  EXPECT_TRUE(beam_azimuth.contains(0) && beam_azimuth.contains(2));  // fins are behind the legs
}

// A Lambert sphere has mu cos^2 over its half that faces the head: sigma = 2/3 pi mu a^2, here of a = 5 cm and steel.
// Its energy is that of one scatterer of this strength at the mean range of its echo, 3/4 a before the middle.
TEST_F(MakeObject, sphere_has_the_target_strength_of_lambert) {
  succeed("make-object sphere -o ball.ply --set diameter_m=0.1 --set tolerance_mm=0.1");
  const double mu = find_material("steel").lambert_mu, sigma = 2.0 / 3 * pi * mu * 0.05 * 0.05;
  write("one.csv",
        "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n9.9625,0,0," + std::to_string(sigma) + ",1,0\n");
  const std::string look = " --method incoherent --sonar p900-45 --range 8:12 --no-picture -q";
  succeed("ping ball.ply --pose=-10,0,0.05,0,0,0 --scatterers-per-cell 40 -o ball" + look);
  succeed("synthesize one.csv -o one" + look);
  EXPECT_NEAR(energy_db("ball"), energy_db("one"), 0.05);
}

// Sums all facets of a diver that face the head, as if none hid another: docs/objects.md and data/materials.toml have
// these strengths.
TEST_F(MakeObject, diver_has_the_target_strength_that_is_documented) {
  succeed("make-object diver -o diver.ply");
  const SceneMesh mesh = *load_scene(path("diver.ply")).mesh;
  const auto strength_db = [&](const Eigen::Vector3d& towards, const std::string& only) {
    double sigma = 0;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
      const auto [a, b, c] = corners_of(mesh, t);
      const Eigen::Vector3d twice = (b - a).cross(c - a);
      const double cosine = twice.normalized().dot(towards);
      const Material& material = mesh.materials[mesh.material[mesh.triangle[t][0]]];
      if (cosine > 0 && (only.empty() || only == material.name))
        sigma += material.lambert_mu * cosine * cosine * twice.norm() / 2;
    }
    return db_from_power(sigma);
  };
  EXPECT_NEAR(strength_db({1, 0, 0}, "wet-suit"), -29, 0.5);
  EXPECT_NEAR(strength_db({0, 1, 0}, "wet-suit"), -24, 0.5);
  EXPECT_NEAR(strength_db({1, 0, 0}, ""), -22, 0.5);
  EXPECT_NEAR(strength_db({0, 1, 0}, ""), -16, 0.5);
}

TEST_F(MakeObject, refuses_what_is_no_object) {
  expect_refused("make-object tyer -o x.ply", 2, {"tyer", "must be one of: cylinder-mine", "did you mean 'tyre'"});
  expect_refused("make-object tyer --list", 2, {"did you mean 'tyre'"});
  expect_refused("make-object tyre --set diametr_m=1 -o x.ply", 2, {"diametr_m", "did you mean 'diameter_m'"});
  expect_refused("make-object tyre --set diameter_m=nan -o x.ply", 2, {"diameter_m", "'nan' is not a number"});
  expect_refused("make-object tyre --set diameter_m=-1 -o x.ply", 2,
                 {"diameter_m = -1 m, must be a number from 0.001"});
  expect_refused("make-object tyre --set diameter_m -o x.ply", 2, {"--set diameter_m", "KEY=VALUE"});
  expect_refused("make-object pipe --set wall_m=0.2 -o x.ply", 2, {"wall_m = 0.2 m, must be below half of diameter_m"});
  expect_refused("make-object pipe --material stel -o x.ply", 2, {"stel", "did you mean 'steel'"});
  expect_refused("make-object pipe --material rubber=steel -o x.ply", 2, {"nothing is made of 'rubber'", "steel"});
  expect_refused("make-object pipe -o x.obj", 2, {"x.obj", "must be .ply"});
  expect_refused("make-object pipe", 2, {"-o", "pipe.ply"});
  expect_refused("make-object -o x.ply", 2, {"which object?"});
  expect_refused("make-object pipe --list -o x.ply", 2, {"--list writes nothing", "-o"});
  expect_refused("make-object sphere --set diameter_m=100 --set tolerance_mm=0.01 -o x.ply", 2,
                 {"larger tolerance_mm"});
  write("old.ply", "old");
  expect_refused("make-object pipe -o old.ply", 4, {"old.ply", "--force"});
}

TEST_F(MakeObject, is_documented_as_its_table_says) {
  std::string page =
      "# Objects\n\nThe objects of `insonify make-object`; [objects.md](../objects.md) explains them. Sizes are those "
      "of the defaults. \"Typical\" is what\nsuch things commonly have, not one product.\n\n"
      "| object | what it is | length x width x height [m] | materials | outline |\n|---|---|---|---|---|\n";
  std::string options =
      "\n## Options\n\nSizes are in metres. Every object also has `tolerance_mm`, 1 by default, from 0.01 to 100: the "
      "largest distance of the triangles\nfrom a curved surface.\n\n"
      "| object | key | default | from, to | what |\n|---|---|---|---|---|\n";
  const std::string pictures = file_bytes(INSONIFY_OBJECTS_PAGE);
  for (const ObjectKind& kind : object_kinds()) {
    page += fmt::format("| `{}` | {} | {} | {} | {} |\n", kind.name, kind.description,
                        tool::size_text(make_object(kind.name)), joined(kind.materials), kind.source);
    for (const ObjectOption& o : kind.options)
      options += fmt::format("| `{}` | `{}` | {:g} | {:g} to {:g} | {} |\n", kind.name, o.key, o.standard, o.least,
                             o.most, o.help);
    EXPECT_THAT(pictures, HasSubstr(std::string("](images/objects/") + kind.name + ".png)"));
  }
  expect_reference_page("objects.md", page + options);
}
