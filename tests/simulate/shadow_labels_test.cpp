// SPDX-License-Identifier: BSD-3-Clause
// Compares shadows on a level bed with closed forms, in labels and in levels (E16, E125).
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace {

constexpr double head_height = 2;

/// A head 2 m above the bed z = 0 at the origin, nose down.
class ShadowOnABed : public testing::Test {
 protected:
  const SonarHead head = small_head({.beams = 48,
                                     .field_of_view_deg = 40,
                                     .beam_width_deg = 1.5,
                                     .elevation_width_deg = 50,
                                     .min_range = 5,
                                     .max_range = 9.5});
  const Pose pose = pose_from_yaw_pitch_roll({0, 0, head_height}, 0, radians(17), 0);
  SceneCloud scene;

  void SetUp() override {
    scene.materials = {{"sand", 0.01}, {"steel", 0.01}};
    add_rectangle(scene, {4, -5, 0}, {6.5, 0, 0}, {0, 10, 0}, {0, 0, 1}, spacing);
    for (auto& material : scene.material) material = 0;
    bed = scene.size();
  }
  void make_steel() { std::fill(scene.material.begin() + static_cast<std::ptrdiff_t>(bed), scene.material.end(), 1); }

  SimulatedPing beam_azimuth(SynthesisMethod method) const {
    SimulationOptions options;
    options.synthesis.method = method;
    options.outputs.contributors = 1;
    options.sampling.scatterers_per_cell = 10;  // parts narrower than the edges of what is counted
    return simulate_ping(scene, head, pose, {}, options);
  }
  /// Returns the point where the cone of a beam meets the bed at a range.
  static std::optional<Eigen::Vector3d> on_bed(double range, double u) {
    const double y = range * u, x2 = range * range - head_height * head_height - y * y;
    if (x2 <= 0) return {};
    return Eigen::Vector3d(std::sqrt(x2), y, 0);
  }
  double u_of(std::size_t beam) const { return std::sin(head.fan.azimuth[beam]); }

  /// Counts of pixels, and of those that differ from the closed form although all within a cell of theirs agrees.
  struct Counted {
    std::size_t shadow = 0, shadow_amiss = 0, lit = 0, lit_amiss = 0;
  };
  Counted count(const PixelLabels& labels, const std::function<bool(const Eigen::Vector3d&)>& hidden,
                const std::function<bool(double, double)>& left_out) const {
    Counted c;
    const double cell_u = head.fan.beam_width + spacing / 5, cell_r = 0.03 + spacing;
    for (std::size_t b = 1; b + 1 < head.fan.beams(); ++b)
      for (std::size_t n = 0; n < head.gate.bins(); ++n) {
        const double range = head.gate.centre(n), u = u_of(b);
        if (range < 5.2 || range > 9.3 || left_out(range, u)) continue;
        int dark = 0;
        for (int i = -2; i <= 2; ++i)
          for (int j = -2; j <= 2; ++j) dark += hidden(*on_bed(range + 0.5 * i * cell_r, u + 0.5 * j * cell_u));
        const std::uint16_t label = labels.material(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(n));
        if (dark == 25) ++c.shadow, c.shadow_amiss += label != PixelLabels::shadow;
        if (dark == 0) ++c.lit, c.lit_amiss += label != 0;
      }
    return c;
  }
  /// Returns the mean level of the shadow less that of the lit bed at the same ranges [dB].
  double shadow_level(const SimulatedPing& ping, const std::function<bool(const Eigen::Vector3d&)>& hidden, double from,
                      double to) const {
    double dark = 0, bright = 0, darks = 0, brights = 0;
    for (std::size_t b = 0; b < head.fan.beams(); ++b)
      for (std::size_t n = 0; n < head.gate.bins(); ++n) {
        if (head.gate.centre(n) < from || head.gate.centre(n) > to) continue;
        const auto row = static_cast<Eigen::Index>(b), column = static_cast<Eigen::Index>(n);
        const double power = std::norm(std::complex<double>(ping.ping.pressure(row, column)));
        if (ping.ping.labels.material(row, column) == PixelLabels::shadow)
          dark += power, ++darks;
        else if (!hidden(*on_bed(head.gate.centre(n), u_of(b))) && std::abs(u_of(b)) > 0.22)
          bright += power, ++brights;
      }
    EXPECT_GT(darks, 300);
    EXPECT_GT(brights, 300);
    return db_from_power(dark / darks / (bright / brights));
  }

  static constexpr double spacing = 0.03;
  std::size_t bed = 0;
};

}  // namespace

// A wall of height H along an arc of radius d hides the bed behind it up to d h / (h - H).
TEST_F(ShadowOnABed, of_a_wall_is_as_long_as_its_height_says) {
  const double d = 6, height = 0.5, half = radians(8), end = d * head_height / (head_height - height);
  for (double turn = -half; turn <= half; turn += 0.02 / d)
    for (double z = 0.01; z < height; z += 0.02)
      add_surfel(scene, {d * std::cos(turn), d * std::sin(turn), z}, {-std::cos(turn), -std::sin(turn), 0}, 4e-4, 1);
  const auto hidden = [&](const Eigen::Vector3d& p) {
    const double away = p.head<2>().norm();
    return away > d && away < end && std::abs(std::atan2(p.y(), p.x())) < half;
  };
  const double top = std::hypot(d, head_height - height), base = std::hypot(d, head_height);
  const auto wall = [&](double range, double u) {
    return range > top - 0.05 && range < base + 0.05 && std::abs(u) < 0.2;
  };
  const SimulatedPing expected = beam_azimuth(SynthesisMethod::incoherent);
  const Counted c = count(expected.ping.labels, hidden, wall);
  EXPECT_GT(c.shadow, 1000U);
  EXPECT_EQ(c.shadow_amiss, 0U);
  EXPECT_GT(c.lit, 3000U);
  EXPECT_EQ(c.lit_amiss, 0U);
  // The wall is steel, and nothing behind it is, although its side lobes are received there.
  for (std::size_t n = 0; n < head.gate.bins(); ++n) {
    const double range = head.gate.centre(n);
    if (range < base + 0.1) continue;
    for (Eigen::Index b = 0; b < 48; ++b) ASSERT_NE(expected.ping.labels.material(b, static_cast<Eigen::Index>(n)), 1);
  }
  EXPECT_EQ(expected.ping.labels.material(24, static_cast<Eigen::Index>((top + 0.05 - 5) / head.gate.bin_size)), 1);
  EXPECT_LT(shadow_level(expected, hidden, base + 0.2, std::hypot(end, head_height) - 0.1), -20);
  EXPECT_LT(
      shadow_level(beam_azimuth(SynthesisMethod::gridded), hidden, base + 0.2, std::hypot(end, head_height) - 0.1),
      -18);
}

// A sphere hides what lies beyond it on the lines that meet it.
TEST_F(ShadowOnABed, of_a_sphere_is_where_lines_of_sight_meet_it) {
  const Eigen::Vector3d centre(6, 0.1, 0.6), eye(0, 0, head_height);
  const double radius = 0.35;
  add_sphere(scene, centre, radius, 6000);
  make_steel();
  const auto hidden = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d line = (p - eye).normalized(), to = centre - eye;
    const double along = to.dot(line);
    return along > 0 && along < (p - eye).norm() && to.squaredNorm() - along * along < radius * radius;
  };
  const double far = (centre - eye).norm();
  const auto sphere = [&](double range, double u) {
    return range > far - radius - 0.05 && range < far + radius + 0.05 && std::abs(u - 0.1 / far) < 0.1;
  };
  const SimulatedPing expected = beam_azimuth(SynthesisMethod::incoherent);
  const Counted c = count(expected.ping.labels, hidden, sphere);
  EXPECT_GT(c.shadow, 300U);
  EXPECT_EQ(c.shadow_amiss, 0U);
  EXPECT_GT(c.lit, 3000U);
  EXPECT_EQ(c.lit_amiss, 0U);
  EXPECT_LT(shadow_level(expected, hidden, 7, 8.5), -15);
}

// Rays that miss a surfel do not hide it.
TEST_F(ShadowOnABed, of_rays_is_that_of_surfels) {
  const Eigen::Vector3d centre(6, 0.1, 0.6);
  add_sphere(scene, centre, 0.35, 6000);
  make_steel();
  const PixelLabels surfels = beam_azimuth(SynthesisMethod::incoherent).ping.labels;
  SimulationOptions options;
  options.outputs.contributors = 1;
  options.sampling.kind = SamplingKind::rays, options.sampling.rays_per_beam = 64;
  const PixelLabels rays = simulate_ping(scene, head, pose, {}, options).ping.labels;
  std::size_t dark = 0, both = 0, dark_of_rays = 0;
  for (Eigen::Index i = 0; i < rays.material.size(); ++i) {
    dark += surfels.material(i) == PixelLabels::shadow, dark_of_rays += rays.material(i) == PixelLabels::shadow;
    both += surfels.material(i) == PixelLabels::shadow && rays.material(i) == PixelLabels::shadow;
  }
  EXPECT_GT(dark, 500U);
  EXPECT_GT(both, 95 * dark / 100);
  EXPECT_LT(dark_of_rays, 11 * dark / 10);
}
