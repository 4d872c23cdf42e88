// SPDX-License-Identifier: BSD-3-Clause
#include "core/units.hpp"
#include "returns/coverage.hpp"
#include "sampling/find_scatterers.hpp"
#include "sonar/response_table.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace insonify::insonification_tests {

constexpr double alpha_db = 0.3;  ///< [dB/m]
const Medium medium{1500, {alpha_db * nepers_per_db, 0, 0}};
constexpr double mu = 0.05, area = 1e-4;

/// Returns a head at 600 kHz, 21 beams over 40 degrees, 1 m to 30 m.
SonarHead insonifying_head() {
  SonarHead head;
  head.pulse = {600e3, 30e3, 210};
  head.array = array_for_beam_width(radians(3), 1500 / 600e3, Shading::taylor, -30);
  head.fan = make_fan(21, radians(40), radians(3), radians(30));
  head.gate = {1, 30, 0.01};
  return head;
}

SceneCloud empty_scene() {
  SceneCloud scene;
  scene.materials = {{"m", mu}};
  return scene;
}

/// Returns one surfel facing a head at the origin.
SceneCloud target_at(double range, double azimuth = 0, double elevation = 0) {
  SceneCloud scene = empty_scene();
  const Eigen::Vector3d direction = unit_vector({azimuth, elevation});
  add_surfel(scene, range * direction, -direction, area);
  return scene;
}

Scatterers seen(const SceneCloud& scene, const SonarHead& head, const Pose& pose, double per_cell = 0) {
  SamplingOptions options;
  options.scatterers_per_cell = per_cell;
  options.elevation_half_extent = radians(40);
  options.azimuth_margin = radians(6);
  return find_scatterers(scene, pose, head.fan, head.gate, options).scatterers;
}

std::vector<CoveredSurfel> map_of(const SceneCloud& scene, const SonarHead& head = insonifying_head(),
                                  const Pose& pose = Pose::Identity(), double per_cell = 0) {
  return coverage_of(scene, seen(scene, head, pose, per_cell), head, medium);
}

/// Returns SL - 2 TL + TS of `target_at`.
double sonar_equation(double range) {
  return 210 - 2 * (20 * std::log10(range) + alpha_db * range) + 10 * std::log10(mu * area);
}

TEST(Insonification, level_of_one_surfel_on_axis_is_the_sonar_equation) {
  const std::vector<CoveredSurfel> map = map_of(target_at(7));
  ASSERT_EQ(map.size(), 1U);
  EXPECT_EQ(map[0].pings, 1U);
  EXPECT_NEAR(map[0].level_db, sonar_equation(7), 1e-4);
  EXPECT_NEAR(map[0].grazing_angle, pi / 2, 1e-3);
  EXPECT_FLOAT_EQ(map[0].range, 7);
}

TEST(Insonification, twice_the_range_costs_12_db_and_absorption) {
  const double near = map_of(target_at(6))[0].level_db, far = map_of(target_at(12))[0].level_db;
  EXPECT_NEAR(near - far, 40 * std::log10(2) + 2 * alpha_db * 6, 1e-4);
}

// The parts of a surfel share its area, whatever their number.
TEST(Insonification, level_does_not_depend_on_the_splitting) {
  SceneCloud scene = target_at(7);
  scene.area[0] = 0.0025F;
  const Scatterers parts = seen(scene, insonifying_head(), Pose::Identity(), 5000);
  ASSERT_GT(parts.size(), 10U);
  EXPECT_NEAR(map_of(scene, insonifying_head(), Pose::Identity(), 5000)[0].level_db, map_of(scene)[0].level_db, 0.02);
}

// Half a beam spacing and 15 degrees of elevation off: the fan's pattern, the cone's, and -3 dB of the elevation
// pattern.
TEST(Insonification, level_off_the_axes_includes_the_patterns) {
  const SonarHead head = insonifying_head();
  const double azimuth = radians(20.0 / 21), elevation = radians(15);
  const double u = std::cos(elevation) * std::sin(azimuth), u_beam = std::sin(radians(40.0 / 21));
  const double nearest = std::min(std::abs(u), std::abs(u - u_beam));
  const double beam_db = db_from_amplitude(array_response(head.array, 1500 / 600e3, nearest, 0).real());
  const double level = map_of(target_at(7, azimuth, elevation))[0].level_db;
  EXPECT_NEAR(level, sonar_equation(7) + beam_db + 10 * std::log10(0.5), 1e-3);
  EXPECT_LT(beam_db, -0.2);
}

TEST(Insonification, of_a_planar_array_includes_the_response_of_the_best_row) {
  SonarHead head = insonifying_head();
  head.fan = {{0, 0}, {radians(-5), radians(5)}, radians(3), radians(30), radians(6)};
  head.column = array_for_beam_width(radians(6), 1500 / 600e3, Shading::uniform, 0);
  const double v = std::sin(radians(4));
  const double row_db = db_from_amplitude(array_response(*head.column, 1500 / 600e3, v, std::sin(radians(5))).real());
  const double sent_db = db_from_amplitude(elevation_response(head.elevation_shape, radians(30), radians(4)));
  EXPECT_NEAR(map_of(target_at(7, 0, radians(4)), head)[0].level_db, sonar_equation(7) + row_db + sent_db, 1e-3);
}

// Inclined by 60 degrees, cos^2 of incidence is -6.02 dB.
TEST(Insonification, reports_the_grazing_angle) {
  SceneCloud scene = target_at(7);
  scene.normal[0] = Eigen::Vector3f(-0.5F, 0, std::sqrt(0.75F));
  const std::vector<CoveredSurfel> map = map_of(scene);
  EXPECT_NEAR(map[0].grazing_angle, radians(30), 1e-6);
  EXPECT_NEAR(map[0].level_db, sonar_equation(7) + 20 * std::log10(0.5), 1e-4);
}

// A flat bottom of Lambert's law: mu sin^2 of the grazing angle per square metre, and per cell the sonar equation with
// a cell of the equivalent widths: whatever the density of the cloud.
TEST(Insonification, scattering_and_cell_level_of_a_flat_bottom_are_closed_forms) {
  const SonarHead head = insonifying_head();
  const double depth = 3, wavelength = 1500 / 600e3;
  double width = 0;  // of the beam's intensity, in direction cosine
  for (double u = -0.5; u < 0.5; u += 1e-4)
    width += 1e-4 * std::pow(std::abs(array_response(head.array, wavelength, u, 0)), 2);
  const double length = 750 * std::sqrt(std::log(2) / pi) / 30e3;  // of exp(-pi^2 B^2 t^2 / ln 2)
  for (const double side : {0.02, 0.05}) {
    SceneCloud scene = empty_scene();
    for (const double x : {5.0, 8.0})
      for (const double y : {0.0, 1.5}) add_surfel(scene, {x, y, -depth}, {0, 0, 1}, side * side);
    const std::vector<CoveredSurfel> map = map_of(scene, head);
    ASSERT_EQ(map.size(), scene.size());
    for (std::size_t i = 0; i < scene.size(); ++i) {
      const Eigen::Vector3d p = scene.point[i].cast<double>();
      const double range = p.norm(), sine = depth / range, elevation = std::asin(sine);
      const double cell = length / std::cos(elevation) * range * width * p.head<2>().norm() / p.x();
      const double pattern = db_from_power(elevation_response(head.elevation_shape, radians(30), elevation) *
                                           elevation_response(head.elevation_shape, radians(30), elevation));
      EXPECT_NEAR(map[i].scattering_db, 10 * std::log10(mu * sine * sine), 1e-3);
      EXPECT_NEAR(map[i].cell_level_db, sonar_equation(range) + 10 * std::log10(sine * sine * cell / area) + pattern,
                  0.02)
          << p.transpose();
    }
  }
}

// A plate hides the one behind it; a third is beside the fan, a fourth beyond the gate.
TEST(Insonification, hidden_or_outside_surfels_have_no_hits) {
  SceneCloud scene = empty_scene();
  const auto add_plate = [&](double x, double y, double half) {
    for (double b = -half; b < half + 0.01; b += 0.05)
      for (double c = -half; c < half + 0.01; c += 0.05) add_surfel(scene, {x, y + b, c}, {-1, 0, 0}, 0.0025);
    return scene.size();
  };
  const std::size_t front = add_plate(5, 0, 0.6), behind = add_plate(6, 0, 0.3), beside = add_plate(5, 4, 0.3);
  const std::size_t beyond = add_plate(40, 10, 0.3);
  const std::vector<CoveredSurfel> map = map_of(scene);
  ASSERT_EQ(map.size(), front);
  for (std::size_t i = 0; i < front; ++i) ASSERT_EQ(map[i].id, i);
  EXPECT_GT(beyond, beside);
  EXPECT_GT(behind, front);
  EXPECT_GT(beside, behind);
}

TEST(Insonification, surfels_just_beside_the_fan_are_no_hits) {
  const SonarHead head = insonifying_head();
  const double edge = head.fan.azimuth.back() > 0 ? head.fan.azimuth.back() : head.fan.azimuth.front();
  EXPECT_EQ(map_of(target_at(7, edge + radians(0.5))).size(), 1U);
  EXPECT_EQ(map_of(target_at(7, edge + radians(3.9))).size(), 0U);  // between main and side lobe
}

TEST(Insonification, pings_accumulate_hits_and_the_best) {
  const SceneCloud scene = target_at(12);
  const SonarHead head = insonifying_head();
  Pose near = Pose::Identity(), away = Pose::Identity();
  near.translation() = Eigen::Vector3d(6, 0, 0);
  away.translation() = Eigen::Vector3d(20, 0, 0);  // looks the other way
  std::vector<CoveredSurfel> map;
  for (const Pose& pose : {Pose::Identity(), near, away}) add(map, map_of(scene, head, pose));
  ASSERT_EQ(map.size(), 1U);
  EXPECT_EQ(map[0].pings, 2U);
  EXPECT_NEAR(map[0].level_db, sonar_equation(6), 1e-4);
  EXPECT_FLOAT_EQ(map[0].range, 6);
}

TEST(Insonification, of_another_scene_is_refused) {
  SceneCloud other = target_at(7);
  add_surfel(other, {5, 0, 0}, {-1, 0, 0}, area);
  const SonarHead head = insonifying_head();
  const Scatterers two = seen(other, head, Pose::Identity());
  EXPECT_EQ(error_of([&] { coverage_of(target_at(7), two, head, medium); }),
            "coverage_of: a scatterer is of surfel 1, but the scene has 1");
  EXPECT_EQ(error_of([&] { coverage_of(target_at(7), {}, head, medium, {.min_response_db = 3}); }),
            "coverage_of: min_response_db = 3 dB, must be <= 0");
}

namespace {

/// Returns the coverage of a strip of level bed at z = -4 by a head that looks to port, tilted by 30 degrees, from
/// `pings` places `spacing` apart along x, the middle one at the origin.
std::vector<CoveredSurfel> line_over_bed(int pings, double spacing, SceneCloud& bed) {
  bed = empty_scene();
  for (double y = 1.5; y < 12; y += 0.5) add_surfel(bed, {0, y, -4}, Eigen::Vector3d::UnitZ(), area);
  SonarHead head = insonifying_head();
  head.fan = make_fan(1, 0, radians(3), radians(120));
  std::vector<CoveredSurfel> covered;
  for (int k = -pings / 2; k <= pings / 2; ++k) {
    const Pose pose = pose_from_yaw_pitch_roll({k * spacing, 0, 0}, pi / 2, radians(30), 0);
    add(covered, coverage_of(bed, seen(bed, head, pose), head, medium));
  }
  return covered;
}

/// Returns the direction cosine at which a beam's intensity is down by 20 dB.
double edge_of_beam() {
  const SonarHead head = insonifying_head();
  const ResponseTable table(head.array, 1500 / head.pulse.centre_frequency);
  double u = 0;
  while (table.intensity(u) > 0.01) u += 1e-5;
  return u;
}

}  // namespace

// From a way abeam at height h, a surfel y to the side is h / sin(grazing) = hypot(y, h) away, and within the beam for
// as many pings as their spacing goes into twice r u / sqrt(1 - u^2).
TEST(Coverage, of_a_level_bed_beside_a_straight_way_is_the_closed_form) {
  const double spacing = 0.02, u = edge_of_beam(), half_way = u / std::sqrt(1 - u * u);
  SceneCloud bed;
  const auto covered = line_over_bed(201, spacing, bed);
  ASSERT_EQ(covered.size(), bed.size());
  for (const CoveredSurfel& s : covered) {
    const double range = std::hypot(s.position.y(), 4);
    EXPECT_NEAR(s.grazing_angle, std::asin(4 / range), 1e-5);
    EXPECT_NEAR(s.range, range, 1e-5);
    EXPECT_NEAR(s.pings, 2 * range * half_way / spacing, 1.001) << s.position.y();
    EXPECT_EQ(s.position, world(bed, s.id));
  }
}

TEST(Coverage, of_twice_as_many_pings_is_3_db_more_insonification) {
  SceneCloud bed;
  const auto sparse = line_over_bed(101, 0.04, bed), dense = line_over_bed(201, 0.02, bed);
  for (std::size_t i = 0; i < dense.size(); ++i) {
    EXPECT_NEAR(dense[i].intensity / sparse[i].intensity, 2, 0.1) << i;
    EXPECT_GT(dense[i].pings, sparse[i].pings);
  }
}

TEST(Coverage, of_one_ping_is_its_insonification) {
  const SceneCloud scene = target_at(7);
  const auto covered =
      coverage_of(scene, seen(scene, insonifying_head(), Pose::Identity()), insonifying_head(), medium);
  ASSERT_EQ(covered.size(), 1U);
  EXPECT_EQ(covered[0].pings, 1U);
  EXPECT_NEAR(10 * std::log10(covered[0].intensity / (micropascal * micropascal)), sonar_equation(7), 1e-4);
}

TEST(Coverage, adds_up_by_id_in_any_grouping) {
  const auto one = [](std::uint32_t id, float angle, double intensity) {
    return CoveredSurfel{id, 1, {1.0 * id, 2, 3}, angle, 10 - angle, intensity};
  };
  std::vector<CoveredSurfel> sum = {one(2, 0.5F, 1), one(7, 0.1F, 2)};
  add(sum, {one(1, 0.2F, 4), one(7, 0.3F, 8), one(9, 0.4F, 16)});
  ASSERT_EQ(sum.size(), 4U);
  EXPECT_EQ(sum[0].id, 1U);
  EXPECT_EQ(sum[2].pings, 2U);
  EXPECT_EQ(sum[2].grazing_angle, 0.3F);
  EXPECT_EQ(sum[2].range, 9.7F);
  EXPECT_EQ(sum[2].intensity, 10);
}

}  // namespace insonify::insonification_tests
