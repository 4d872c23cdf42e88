// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/tilt_by_relief_internal.hpp"
#include "sampling_scenes.hpp"
#include "support/test.hpp"

using Eigen::Vector3d;

namespace {

const BeamFan tilt_fan = make_fan(64, radians(60), radians(1), radians(40));

/// Returns a plate with micro-relief whose normal is `incidence` [rad] off the direction to a distant head.
SceneCloud rough_plate(double incidence, double relief_slope, bool oriented = true) {
  SceneCloud scene;
  scene.materials = {{"smooth"}, {"rough", 0.01, 0, relief_slope}};
  scene.normals_oriented = oriented;
  const Vector3d normal(-std::cos(incidence), 0, std::sin(incidence)), up(std::sin(incidence), 0, std::cos(incidence));
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      add_surfel(scene, Vector3d(1000, 0, 0) + 0.1 * ((i - 9.5) * up + (j - 9.5) * Vector3d(0, 1, 0)), normal, 0.01, 1);
  return scene;
}

Scatterers seen(const SceneCloud& scene, const SamplingOptions& options, const Pose& pose = at(0, 0, 0)) {
  return find_scatterers(scene, pose, tilt_fan, {0.1, 2000, 0.01}, options).scatterers;
}

double cross_section(const Scatterers& s) {
  double sum = 0;
  for (std::size_t i = 0; i < s.size(); ++i) sum += s.projected_area[i] * s.cos_incidence[i];
  return sum;
}

/// Returns the mean of max(0, cosine)^2 over facets whose slopes are normal with variance slope^2 / 2 along each
/// direction, by the midpoint rule over +-6 standard deviations.
double mean_square_cosine(double incidence, double slope) {
  const double sd = slope / std::sqrt(2.0);
  const int n = 200;
  double sum = 0, weights = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double a = 12 * ((i + 0.5) / n - 0.5), b = 12 * ((j + 0.5) / n - 0.5);
      const double weight = std::exp(-(a * a + b * b) / 2), p = sd * a, q = sd * b;
      const double cosine = (std::cos(incidence) + p * std::sin(incidence)) / std::sqrt(1 + p * p + q * q);
      sum += weight * std::pow(std::max(0.0, cosine), 2);
      weights += weight;
    }
  return sum / weights;
}

SamplingOptions split_into(double parts) {
  // A cell at 1000 m is 17 m wide and, at normal incidence, 28 m long: many parts per cell are a few per surfel.
  SamplingOptions options;
  options.scatterers_per_cell = parts;
  options.range_resolution = 0.1;
  options.occlusion = false;
  return options;
}

}  // namespace

// 400 surfels of 200 parts and more, over a plate 20 outer scales wide: the mean holds within 3 %.
TEST(TiltByRelief, mean_cross_section_is_the_quadrature_over_the_tilts) {
  for (const double incidence : {0.0, 30.0, 60.0, 80.0})
    for (const double slope : {0.1, 0.3}) {
      double sum = 0;
      std::size_t parts = 0;
      for (const std::uint64_t seed : {1, 2, 3}) {
        SamplingOptions options = split_into(incidence == 0 ? 1e7 : 1e5);
        options.seed = seed;
        const Scatterers s = seen(rough_plate(radians(incidence), slope), options);
        sum += cross_section(s) / 4 / 3;
        parts += s.size();
      }
      EXPECT_GT(parts, 3u * 400u * 200u);
      const double expected = mean_square_cosine(radians(incidence), slope);
      EXPECT_NEAR(sum, expected, 0.03 * expected) << incidence << " degrees, slope " << slope;
    }
}

TEST(TiltByRelief, leaves_smooth_materials_to_the_last_bit) {
  SceneCloud scene = rough_plate(0.5, 0.3);
  const Scatterers rough = seen(scene, split_into(1e5));
  scene.materials[1].relief_slope = 0;
  const Scatterers smooth = seen(scene, split_into(1e5));
  for (auto& m : scene.material) m = 0;
  scene.materials[1].relief_slope = 0.3;  // in the table, on no surfel
  const Scatterers unused = seen(scene, split_into(1e5));
  EXPECT_EQ(smooth.cos_incidence, unused.cos_incidence);
  EXPECT_EQ(smooth.projected_area, unused.projected_area);
  EXPECT_NE(smooth.cos_incidence, rough.cos_incidence);
  EXPECT_EQ(smooth.range, rough.range);
  EXPECT_EQ(smooth.azimuth, rough.azimuth);
  EXPECT_EQ(smooth.id, rough.id);
}

// Relief is fixed in the world: a part common to two splittings has the same facet, seen from any pose.
TEST(TiltByRelief, gives_a_position_the_same_facet_for_every_splitting) {
  const SceneCloud scene = rough_plate(0.5, 0.3);
  const Scatterers coarse = seen(scene, split_into(0)), fine = seen(scene, split_into(1e5));
  ASSERT_EQ(coarse.size(), scene.size());
  ASSERT_GT(fine.size(), 2 * scene.size());
  std::size_t shared = 0;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    if (static_cast<std::uint32_t>(fine.id[i]) != 0) continue;  // part 0 is the surfel's centre
    EXPECT_EQ(fine.cos_incidence[i], coarse.cos_incidence[fine.surfel[i]]);
    ++shared;
  }
  EXPECT_EQ(shared, scene.size());
}

TEST(TiltByRelief, belongs_to_the_world_and_not_to_the_head) {
  const SceneCloud scene = rough_plate(0.5, 0.3);
  const Scatterers here = seen(scene, split_into(0)), rolled = seen(scene, split_into(0), at(0, 0, 0, 3, -2));
  ASSERT_EQ(here.size(), rolled.size());
  for (std::size_t i = 0; i < here.size(); ++i) EXPECT_NEAR(rolled.cos_incidence[i], here.cos_incidence[i], 1e-5);
}

TEST(TiltByRelief, turns_unoriented_surfaces_towards_the_head) {
  const Scatterers front = seen(rough_plate(0.5, 0.3), split_into(0));
  SceneCloud turned = rough_plate(0.5, 0.3, false);
  for (auto& n : turned.normal) n = -n;
  const Scatterers back = seen(turned, split_into(0));
  const double expected = cross_section(front);
  EXPECT_NEAR(cross_section(back), expected, 0.1 * expected);
  for (const float cosine : back.cos_incidence) ASSERT_GE(cosine, 0.0f);
}

TEST(TiltByRelief, gives_no_area_where_a_facet_faces_away) {
  const Scatterers s = seen(rough_plate(radians(85), 0.5), split_into(0));
  std::size_t silent = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    ASSERT_EQ(s.cos_incidence[i] == 0, s.projected_area[i] == 0);
    silent += s.cos_incidence[i] == 0;
  }
  // Slope along the view of standard deviation 0.35 against tan 5 degrees = 0.087: 40 % face away.
  EXPECT_NEAR(static_cast<double>(silent), 0.4 * static_cast<double>(s.size()), 0.12 * static_cast<double>(s.size()));
}

TEST(TiltByRelief, rays_see_the_mean_cross_section_of_surfels) {
  SceneCloud scene;
  scene.materials[0].relief_slope = 0.2;
  add_rectangle(scene, {2, -8, -2}, {14, 0, 0}, {0, 16, 0}, {0, 0, 1}, 0.06, 0.5);
  const BeamFan narrow = make_fan(64, radians(40), radians(1), radians(15));
  const auto sigma = [&](const SamplingOptions& options) {
    return cross_section(find_scatterers(scene, at(0, 0, 0, 0, 15), narrow, {0.1, 12, 0.05}, options).scatterers);
  };
  const double surfels = sigma({});
  EXPECT_NEAR(sigma({.kind = SamplingKind::rays, .rays_per_beam = 512}), surfels, 0.03 * surfels);
}

TEST(TiltByRelief, does_not_depend_on_the_number_of_threads) {
  const SceneCloud scene = rough_plate(0.5, 0.3);
  SamplingOptions options = split_into(1e5);
  options.threads = 1;
  const Scatterers one = seen(scene, options);
  for (const int threads : {2, 7}) {
    options.threads = threads;
    const Scatterers many = seen(scene, options);
    EXPECT_EQ(many.cos_incidence, one.cos_incidence);
    EXPECT_EQ(many.projected_area, one.projected_area);
  }
}

TEST(TiltByRelief, refuses_an_outer_scale_below_zero) {
  SamplingOptions options;
  options.relief_outer_scale = -1;
  EXPECT_EQ(error_of([&] { seen(rough_plate(0.5, 0.3), options); }),
            "find_scatterers: options.relief_outer_scale = -1, must be >= 0 m");
}
