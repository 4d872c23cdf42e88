// SPDX-License-Identifier: BSD-3-Clause
#include "scene/objects.hpp"

#include "support/test.hpp"

using Eigen::Vector3d, Eigen::Vector3f;

namespace {

double surface_of(const SceneMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) sum += insonify::area_of(corners_of(mesh, t));
  return sum;
}

double volume_of(const SceneMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
    const auto [a, b, c] = corners_of(mesh, t);
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

Eigen::AlignedBox3d box_of(const SceneMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector3f& p : mesh.point) box.extend(p.cast<double>());
  return box;
}

std::string refusal_of(const std::string& name, const ObjectSettings& settings) {
  return error_of([&] { make_object(name, settings); });
}

/// Checks points in every triangle, its corners, middle and edges among them.
template <typename Check>
void at_points(const SceneMesh& mesh, Check check) {
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
    const auto [a, b, c] = corners_of(mesh, t);
    for (int i = 0; i <= 6; ++i)
      for (int j = 0; i + j <= 6; ++j) check((i * a + j * b + (6 - i - j) * c) / 6, t);
  }
}

/// Returns the largest distance from a surface whose signed distance is `off`.
template <typename Off>
double farthest(const SceneMesh& mesh, Off off) {
  double most = 0;
  at_points(mesh, [&](const Vector3d& p, std::size_t) { most = std::max(most, std::abs(off(p))); });
  return most;
}

const ObjectSettings torus = {{"diameter_m", 1.0}, {"rim_m", 0.6}, {"width_m", 0.2}, {"tread_m", 0.0}, {"wall_m", 0.0}};

}  // namespace

// An option without a tread needs 0 there, which is below the least size of others.
TEST(Objects, have_names_sources_and_defaults_that_obey_their_rules) {
  std::set<std::string> names;
  for (const ObjectKind& kind : object_kinds()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_GT(std::string(kind.source).size(), 5u) << kind.name;
    EXPECT_EQ(find_object(kind.name), &kind);
    std::set<std::string> keys;
    for (const ObjectOption& option : options_of(kind)) {
      EXPECT_TRUE(keys.insert(option.key).second) << kind.name << option.key;
      EXPECT_LE(option.least, option.standard) << kind.name << option.key;
      EXPECT_GE(option.most, option.standard) << kind.name << option.key;
      const std::string unit = option.unit, ending = unit.empty() ? "" : "_" + unit;
      EXPECT_TRUE(std::string(option.key).ends_with(ending)) << kind.name << option.key;
    }
  }
  EXPECT_EQ(names.size(), 12u);
}

TEST(Objects, are_valid_and_made_of_the_materials_they_name) {
  for (const ObjectKind& kind : object_kinds()) {
    const SceneMesh mesh = make_object(kind.name);
    EXPECT_NO_THROW(require_valid(mesh, kind.name));
    std::vector<std::string> names;
    for (const Material& material : mesh.materials) names.push_back(material.name);
    EXPECT_EQ(names, std::vector<std::string>(kind.materials.begin(), kind.materials.end())) << kind.name;
    EXPECT_EQ(std::set(mesh.material.begin(), mesh.material.end()).size(), names.size()) << kind.name;
  }
}

TEST(Objects, stand_at_zero_in_the_middle_of_their_box) {
  for (const ObjectKind& kind : object_kinds()) {
    const Eigen::AlignedBox3d box = box_of(make_object(kind.name));
    EXPECT_EQ(box.min().z(), 0) << kind.name;
    EXPECT_NEAR(box.center().x(), 0, 1e-6) << kind.name;
    EXPECT_NEAR(box.center().y(), 0, 1e-6) << kind.name;
  }
}

// Every edge is walked as often one way as the other; in one solid once each way.
TEST(Objects, are_closed) {
  for (const ObjectKind& kind : object_kinds()) {
    const SceneMesh mesh = make_object(kind.name);
    std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> walked;
    const auto key = [&](std::uint32_t corner) {
      const Vector3f p = mesh.point[corner] + Vector3f::Zero();
      return std::array{p.x() + 0.0f, p.y() + 0.0f, p.z() + 0.0f};
    };
    for (const auto& t : mesh.triangle)
      for (std::size_t e = 0; e < 3; ++e) ++walked[{key(t[e]), key(t[(e + 1) % 3])}];
    std::size_t open = 0, again = 0;
    for (const auto& [edge, times] : walked) {
      const auto back = walked.find({edge.second, edge.first});
      open += back == walked.end() || back->second != times;
      again += times > 1;
    }
    EXPECT_EQ(open, 0u) << kind.name << " of " << walked.size();
    if (kind.one_solid) {
      EXPECT_EQ(again, 0u) << kind.name;
    }
    EXPECT_GT(volume_of(mesh), 0) << kind.name;
  }
}

TEST(Objects, have_normals_on_the_side_of_their_faces) {
  for (const ObjectKind& kind : object_kinds()) {
    const SceneMesh mesh = make_object(kind.name);
    ASSERT_EQ(mesh.normal.size(), mesh.point.size()) << kind.name;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
      const auto [a, b, c] = corners_of(mesh, t);
      const Vector3d face = (b - a).cross(c - a).normalized();
      for (const std::uint32_t corner : mesh.triangle[t]) {
        ASSERT_NEAR(mesh.normal[corner].norm(), 1, 1e-5) << kind.name;
        ASSERT_GT(mesh.normal[corner].cast<double>().dot(face), 0.5) << kind.name << " triangle " << t;
      }
    }
  }
}

// Chords whose middle is s below a circle of radius r leave out s / 3 r of its length and 4 s / 3 r of its disc.
TEST(Objects, have_the_areas_and_volumes_of_closed_forms) {
  struct Case {
    const char* name;
    ObjectSettings settings;
    double area, volume, radius;
  };
  const double r = 0.25, a = 0.1, slant = std::hypot(0.3, 0.2);
  const Case cases[] = {
      {"sphere", {{"diameter_m", 2 * r}}, 4 * pi * r * r, 4 * pi * r * r * r / 3, r},
      {"cylinder-mine", {{"length_m", 2}, {"diameter_m", 0.5}}, 2 * pi * r * 2 + 2 * pi * r * r, pi * r * r * 2, r},
      {"cylinder-mine",
       {{"length_m", 1}, {"diameter_m", 0.5}, {"nose_m", 0.25}},
       pi * r * r + 2 * pi * r * 0.75 + 2 * pi * r * r,
       pi * r * r * 0.75 + 2 * pi * r * r * r / 3,
       r},
      {"cone-mine",
       {{"base_m", 0.6}, {"top_m", 0}, {"height_m", 0.2}},
       pi * 0.3 * (0.3 + slant),
       pi * 0.09 * 0.2 / 3,
       0.3},
      {"cone-mine",
       {{"base_m", 1}, {"top_m", 0.5}, {"height_m", 0.25}},
       pi * (0.25 + 0.0625 + 0.75 * std::sqrt(0.125)),
       pi * 0.25 / 3 * (0.25 + 0.125 + 0.0625),
       0.25},
      {"tyre", torus, 4 * pi * pi * 0.4 * a, 2 * pi * pi * 0.4 * a * a, a},
      {"pipe",
       {{"length_m", 2}, {"diameter_m", 0.4}, {"wall_m", 0.05}},
       2 * pi * 2 * (0.2 + 0.15) + 2 * pi * (0.04 - 0.0225),
       2 * pi * (0.04 - 0.0225),
       0.15}};
  for (const Case& c : cases)
    for (const double tolerance_mm : {1.0, 0.1}) {
      ObjectSettings settings = c.settings;
      settings.emplace_back("tolerance_mm", tolerance_mm);
      const SceneMesh mesh = make_object(c.name, settings);
      const double share = 4e-3 / 3 * tolerance_mm / c.radius;
      EXPECT_NEAR(surface_of(mesh) / c.area, 1, share) << c.name << " " << tolerance_mm;
      EXPECT_NEAR(volume_of(mesh) / c.volume, 1, 1.5 * share) << c.name << " " << tolerance_mm;
    }
}

TEST(Objects, of_flat_faces_are_exact) {
  const SceneMesh block = make_object(
      "cinder-block", {{"length_m", 0.4}, {"width_m", 0.2}, {"height_m", 0.3}, {"shell_m", 0.03}, {"web_m", 0.02}});
  const double core = 0.17 * 0.14, around = 2 * (0.17 + 0.14);
  EXPECT_NEAR(volume_of(block), (0.4 * 0.2 - 2 * core) * 0.3, 1e-7);
  EXPECT_NEAR(surface_of(block), 2 * (0.08 - 2 * core) + 0.3 * (1.2 + 2 * around), 1e-6);
  const SceneMesh wedge =
      make_object("wedge-mine",
                  {{"length_m", 1}, {"width_m", 0.8}, {"height_m", 0.3}, {"top_length_m", 0.5}, {"top_width_m", 0.4}});
  EXPECT_NEAR(volume_of(wedge), 0.3 / 3 * (0.8 + 0.2 + 0.4), 1e-6);
}

// Pappus: areas turn about the axis at their centroids.
TEST(Objects, of_revolution_have_the_volume_of_their_sections) {
  const double w = 0.02, t = 0.08, a = 0.03, outer = 0.32, rim = 0.2, mid = 0.26, h = 0.06;
  const SceneMesh tyre = make_object("tyre", {{"diameter_m", 2 * outer},
                                              {"rim_m", 2 * rim},
                                              {"width_m", 2 * (t + a)},
                                              {"tread_m", 2 * t},
                                              {"wall_m", w},
                                              {"tolerance_mm", 0.05}});
  const double whole = 2 * pi * mid * (4 * t * h + pi * a * h);
  const double hollow = 2 * pi * (mid * pi * (a - w) * (h - w) + t * ((outer - w) * (outer - w) - rim * rim));
  EXPECT_NEAR(volume_of(tyre), whole - hollow, 3e-3 * (whole - hollow));

  const double body = 0.28, hoop = 0.01, half = 0.03;
  const SceneMesh drum = make_object("drum", {{"length_m", 0.9},
                                              {"diameter_m", 2 * (body + hoop)},
                                              {"hoop_m", hoop},
                                              {"hoop_width_m", 2 * half},
                                              {"rim_m", 0.03},
                                              {"recess_m", 0.05},
                                              {"tolerance_mm", 0.05}});
  const double hoops = 2 * 2 * pi * (body + 4 * hoop / (3 * pi)) * pi * half * hoop / 2;
  const double expected = pi * body * body * 0.9 - 2 * pi * 0.25 * 0.25 * 0.05 + hoops;
  EXPECT_NEAR(volume_of(drum), expected, 5e-4 * expected);
}

// Half of the tolerance along, half around: some triangle of each uses at least a third of what it may.
TEST(Objects, are_within_their_tolerance_of_curved_surfaces) {
  for (const double tolerance_mm : {5.0, 1.0, 0.2}) {
    const double most = 1.001e-3 * tolerance_mm, least = 0.33e-3 * tolerance_mm;
    const auto expect = [&](const char* what, double off) {
      EXPECT_LE(off, most) << what << " " << tolerance_mm;
      EXPECT_GE(off, least) << what << " " << tolerance_mm;
    };
    const auto made = [&](const char* name, ObjectSettings settings) {
      settings.emplace_back("tolerance_mm", tolerance_mm);
      return make_object(name, settings);
    };
    expect("sphere", farthest(made("sphere", {{"diameter_m", 1}}),
                              [](const Vector3d& p) { return (p - Vector3d(0, 0, 0.5)).norm() - 0.5; }));
    expect("torus", farthest(made("tyre", torus), [](const Vector3d& p) {
             return std::hypot(std::hypot(p.x(), p.y()) - 0.4, p.z() - 0.1) - 0.1;
           }));
    expect("pipe",
           farthest(made("pipe", {{"length_m", 1}, {"diameter_m", 1}, {"wall_m", 1e-3}}), [](const Vector3d& p) {
             const double r = std::hypot(p.y(), p.z() - 0.5);
             return std::abs(p.x()) > 0.4999 ? 0 : r > 0.4995 ? r - 0.5 : r - 0.499;
           }));
  }
}

TEST(Objects, have_the_normals_of_their_true_surfaces) {
  const SceneMesh sphere = make_object("sphere"), ring = make_object("tyre", torus);
  for (std::size_t i = 0; i < sphere.point.size(); ++i)
    ASSERT_GT(sphere.normal[i].dot((sphere.point[i] - Vector3f(0, 0, 0.25f)).normalized()), 0.99999f);
  for (std::size_t i = 0; i < ring.point.size(); ++i) {
    const Vector3f p = ring.point[i];
    const Vector3f axis = 0.4f * Vector3f(p.x(), p.y(), 0).normalized() + Vector3f(0, 0, 0.1f);
    ASSERT_GT(ring.normal[i].dot((p - axis).normalized()), 0.9999f);
  }
}

TEST(Objects, have_the_sizes_of_their_options) {
  struct Case {
    const char* name;
    ObjectSettings settings;
    Vector3d size;
  };
  const Case cases[] = {{"cylinder-mine", {}, {2, 0.533, 0.533}},
                        {"cylinder-mine", {{"upright", 1}, {"length_m", 1.5}}, {0.533, 0.533, 1.5}},
                        {"cone-mine", {}, {0.98, 0.98, 0.44}},
                        {"wedge-mine", {}, {1.015, 0.8, 0.385}},
                        {"tyre", {}, {0.632, 0.632, 0.205}},
                        {"tyre", {{"upright", 1}, {"diameter_m", 1}}, {1, 0.205, 1}},
                        {"drum", {}, {0.88, 0.585, 0.585}},
                        {"pipe", {{"length_m", 6}}, {6, 0.3239, 0.3239}},
                        {"crab-pot", {}, {1, 1, 0.33}},
                        {"cinder-block", {}, {0.397, 0.194, 0.194}},
                        {"ladder", {}, {3, 0.42, 0.06}},
                        {"sphere", {{"diameter_m", 0.076}}, {0.076, 0.076, 0.076}}};
  for (const Case& c : cases) {
    const Vector3d size = box_of(make_object(c.name, c.settings)).sizes();
    // Bars are polygons with the perimeter of the circle, whose corners stand out.
    EXPECT_LT((size - c.size).cwiseAbs().maxCoeff(), std::string(c.name) == "crab-pot" ? 1e-3 : 1e-6)
        << c.name << " " << size.transpose();
  }
  const Vector3d diver = box_of(make_object("diver")).sizes();
  EXPECT_NEAR(diver.x(), 2.3, 0.1);
  const Vector3d anchor = box_of(make_object("anchor")).sizes();
  EXPECT_NEAR(anchor.y(), 1.2, 0.1);
}

// The pot has six uprights of 16 mm, two rings and two bars below: what its wires add goes with their length.
TEST(Objects, of_bars_have_the_area_of_their_bars) {
  const double ring = 2 * pi * 0.492, upright = 0.33 - 0.016, bars = 2 * ring + 6 * upright + 4 * 0.492;
  const double ends = 2 * 8 * pi * 0.008 * 0.008;
  EXPECT_NEAR(surface_of(make_object("crab-pot", {{"mesh_m", 0}})), pi * 0.016 * bars + ends, 0.01 * pi * 0.016 * bars);
  EXPECT_GT(surface_of(make_object("crab-pot")), surface_of(make_object("crab-pot", {{"mesh_m", 0.16}})));
}

TEST(Objects, anchor_lies_on_its_stock_and_an_arm) {
  const SceneMesh anchor = make_object("anchor");
  bool stock_left = false, stock_right = false, arm = false;
  for (const Vector3f& p : anchor.point) {
    if (p.z() > 2e-3f) continue;
    (p.y() > 0.5f ? stock_left : p.y() < -0.5f ? stock_right : arm) = true;
  }
  EXPECT_TRUE(stock_left && stock_right && arm);
}

TEST(Objects, refuse_what_is_no_object) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal_of("tire", {}), HasSubstr("no object 'tire', must be one of: cylinder-mine, cone-mine"));
  EXPECT_THAT(refusal_of("tyre", {{"radius_m", 1}}),
              HasSubstr("tyre has no option 'radius_m', must be one of: diameter_m"));
  for (const double value : {nan, infinity, -1.0, 0.0, 1000.0})
    EXPECT_THAT(refusal_of("sphere", {{"diameter_m", value}}), HasSubstr("must be a number from 0.001 to 100"))
        << value;
  EXPECT_THAT(refusal_of("drum", {{"upright", 0.5}}), HasSubstr("upright = 0.5, must be a whole number from 0 to 1"));
  EXPECT_THAT(refusal_of("pipe", {{"wall_m", 0.2}}),
              HasSubstr("wall_m = 0.2 m, must be below half of diameter_m, 0.16195 m"));
  EXPECT_THAT(refusal_of("tyre", {{"rim_m", 0.7}}), HasSubstr("rim_m = 0.7 m, must be below diameter_m, 0.632 m"));
  EXPECT_THAT(refusal_of("tyre", {{"wall_m", 0.2}}),
              HasSubstr("wall_m = 0.2 m, must be below half of width_m - tread_m"));
  EXPECT_THAT(refusal_of("tyre", {{"tread_m", 0}}), HasSubstr("wall_m"));
  EXPECT_THAT(refusal_of("cinder-block", {{"web_m", 0.2}}),
              HasSubstr("web_m = 0.2 m, must be below a third of length_m"));
  EXPECT_THAT(refusal_of("cylinder-mine", {{"nose_m", 2}}), HasSubstr("nose_m = 2 m, must be below length_m, 2 m"));
  EXPECT_THAT(refusal_of("sphere", {{"diameter_m", 100}, {"tolerance_mm", 0.01}}),
              HasSubstr("give a larger tolerance_mm"));
}

// Extremes of every option by itself give a closed, valid object or a message that names the option.
TEST(Objects, stay_whole_at_the_ends_of_their_options) {
  for (const ObjectKind& kind : object_kinds())
    for (const ObjectOption& option : options_of(kind))
      for (const double value : {option.least, 0.3 * option.standard, 3 * option.standard}) {
        if (value < option.least || value > option.most || (option.whole && value != std::floor(value))) continue;
        const ObjectSettings settings = {{"tolerance_mm", 5}, {option.key, value}};
        const std::string message = refusal_of(kind.name, settings);
        if (message != "no error") {
          EXPECT_THAT(message, HasSubstr("_m = ")) << kind.name << " " << option.key << " " << value;
          continue;
        }
        const SceneMesh mesh = make_object(kind.name, settings);
        EXPECT_NO_THROW(require_valid(mesh, kind.name)) << option.key << " " << value;
        EXPECT_GT(volume_of(mesh), 0) << kind.name << " " << option.key << " " << value;
      }
}
