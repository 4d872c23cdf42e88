// SPDX-License-Identifier: BSD-3-Clause
// Tests ghosts: echoes of surfels by way of mirrors.
#include "acoustics/aperture.hpp"
#include "acoustics/multipath_echoes.hpp"
#include "acoustics/reflection.hpp"
#include "support/errors.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

using Eigen::Vector3d;
using complex = std::complex<double>;

/// A head with equal response in all directions, and a small patch. The cosine of each leg at the patch is divided out,
/// so that its turn does not matter.
struct GhostBench {
  SceneCloud scene;
  Environment environment;
  std::vector<Mirror> mirrors;
  bool with_levels = false;
  View view{Pose::Identity(), make_fan(181, radians(360), radians(2), radians(180)), {0.1, 60, 0.01}, {}};
  Transmission sent{pulse_900k, {1500, {}}, {.amplitude = SurfaceAmplitude::coherent}};

  GhostBench(const Vector3d& head, const Vector3d& target, const Vector3d& normal) {
    view.world_from_head.translation() = head;
    view.sampling.scatterers_per_cell = 0;
    view.sampling.elevation_half_extent = pi / 2;
    scene.materials = {{"m", 0.1}};
    scene.normals_oriented = false;
    add_surfel(scene, target, normal.normalized(), 1e-4);
  }
  Scatterers direct() const {
    return find_scatterers(scene, view.world_from_head, view.fan, view.gate, view.sampling).scatterers;
  }
  Multipath compute() const { return mirror_echoes(scene, direct(), environment, mirrors, with_levels, view, sent); }
  /// Returns the cosine at the patch of a leg to the image of the head in `mirror`, or of the direct leg.
  double cosine(const Mirror* mirror) const {
    Vector3d from = view.world_from_head.translation();
    if (mirror) from -= 2 * mirror->normal.dot(from - mirror->position) * mirror->normal;
    const Vector3d p = scene.origin + scene.point[0].cast<double>();
    return std::abs((from - p).normalized().dot(scene.normal[0].cast<double>()));
  }
  /// Returns the sum of the echoes with these legs (0: direct, k: by mirror k, either sense) re the direct echo,
  /// without cosines.
  complex relative(const Multipath& m, std::size_t a, std::size_t b) const {
    const Echoes d = direct_echoes(direct(), scene.materials, sent.pulse, sent.medium, sent.echo_options);
    const auto at = [&](std::size_t k) { return cosine(k ? &mirrors[k - 1] : nullptr); };
    complex sum = 0;
    for (std::size_t i = 0; i < m.echoes.size(); ++i) {
      const LegPair legs = m.legs[i];
      if (std::minmax<std::size_t>(legs.out, legs.back) != std::minmax(a, b)) continue;
      sum +=
          m.echoes.amplitude[i] / d.amplitude[0] * std::polar(1.0, -2 * pi * 900e3 * (m.echoes.delay[i] - d.delay[0]));
    }
    return sum / std::sqrt(at(a) * at(b)) * at(0);
  }
  double range(const Multipath& m, std::size_t a, std::size_t b) const {
    for (std::size_t i = 0; i < m.echoes.size(); ++i)
      if (std::minmax<std::size_t>(m.legs[i].out, m.legs[i].back) == std::minmax(a, b)) return 750 * m.echoes.delay[i];
    return 0;
  }
};

}  // namespace

// A wall beside the line of sight: one ghost at its position behind the wall, two halfway, one in the direction of each
// leg.
TEST(MirrorEchoes, of_a_wall_are_three_ghosts) {
  GhostBench b({0, 0, 0}, {10, 1, 0}, {-1, 0.3, 0});
  b.mirrors = {{"wall", {0, 3, 0}, {0, -1, 0}}};
  const Multipath m = b.compute();
  ASSERT_EQ(m.echoes.size(), 3u);
  EXPECT_NEAR(b.range(m, 0, 1), 10.6151, 5e-5);
  EXPECT_NEAR(b.range(m, 1, 1), 11.1803, 5e-5);
  std::vector<double> bearings;
  for (const double u : m.echoes.u) bearings.push_back(degrees(std::asin(u)));
  EXPECT_THAT(bearings,
              testing::UnorderedElementsAre(testing::DoubleNear(5.711, 1e-3), testing::DoubleNear(26.565, 1e-3),
                                            testing::DoubleNear(26.565, 1e-3)));
  EXPECT_NEAR(db_from_amplitude(std::abs(b.relative(m, 0, 1))), 5.09, 0.006);
  EXPECT_NEAR(db_from_amplitude(std::abs(b.relative(m, 0, 1)) / 2), -0.93, 0.006);
  EXPECT_NEAR(db_from_amplitude(std::abs(b.relative(m, 1, 1))), -1.85, 0.006);
  EXPECT_LT(std::abs(std::arg(b.relative(m, 0, 1))), 1e-5);
}

// Apparent ranges and amplitudes re the direct echo come from an independent evaluation of a boxed tank: head at (1.1,
// 1.7, 1.3), target at (4.2, 2.6, 0.9), walls of 0.7 and a free surface.
TEST(MirrorEchoes, of_a_tank_are_the_tabulated_ones) {
  GhostBench b({1.1, 1.7, 1.3}, {4.2, 2.6, 0.9}, {-1, 0.17, 0.23});
  b.mirrors = mirrors_of(Tank{{6, 4, 3}, {0, 0, 0}, 0.7});
  const Multipath m = b.compute();
  const Echoes d = direct_echoes(b.direct(), b.scene.materials, b.sent.pulse, b.sent.medium, b.sent.echo_options);
  EXPECT_NEAR(750 * d.delay[0], 3.25269, 1e-5);
  const struct {
    std::size_t a, b;
    double range, amplitude, db;
  } rows[] = {{0, 1, 3.57955, 1.1657, 1.33},  {1, 1, 3.90640, 0.3397, -9.38}, {0, 5, 4.04812, 0.9402, -0.54},
              {0, 6, 4.11934, -1.3047, 2.31}, {0, 4, 4.28435, 0.8566, -1.34}, {0, 2, 4.32171, 0.8447, -1.47}};
  for (const auto& row : rows) {
    EXPECT_NEAR(b.range(m, row.a, row.b), row.range, 1e-5);
    const complex relative = b.relative(m, row.a, row.b);
    EXPECT_LT(std::abs(relative - row.amplitude), 2e-4) << row.range << " " << relative;
    EXPECT_NEAR(db_from_amplitude(std::abs(relative)), row.db, 0.01);
  }
  EXPECT_EQ(m.echoes.size(), 48u);
}

// Uncoupled phases: the mean energy of the direct echo and its ghosts by a wall nearby is 1 + 4 R^2 + R^4.
TEST(MirrorEchoes, add_their_energies_where_phases_are_random) {
  for (const double reflection : {1.0, 0.5}) {
    GhostBench b({0, 0, 0}, {10, 1e-3, 0}, {-1, 0, 0});
    b.mirrors = {{"wall", {0, 2e-3, 0}, {0, -1, 0}, {}, reflection, {}, 0, 0}};
    const Multipath m = b.compute();
    // Both senses are one delay: their amplitudes add.
    const double energy = 1 + std::norm(b.relative(m, 0, 1)) + std::norm(b.relative(m, 1, 1));
    EXPECT_NEAR(energy, 1 + 4 * std::pow(reflection, 2) + std::pow(reflection, 4), 1e-3);
  }
  EXPECT_NEAR(db_from_power(6), 7.78, 0.005);
}

// A plate as wide as half a zone of Fresnel, and one whose edge stands where sound would bounce: both from the
// integral.
TEST(MirrorEchoes, of_a_small_plate_are_those_of_its_edges) {
  GhostBench b({0, 0, 0}, {10, 0, 0}, {-1, 0.2, 0});
  const Mirror wall{"plate", {5, 3, 0}, {0, -1, 0}};
  const double leg = std::hypot(10, 6), scale = std::sqrt(2 / (wavelength_900k * leg * 0.25)), slant = 6 / leg;
  const auto edge = [](double v1, double v2) { return (fresnel_integral(v2) - fresnel_integral(v1)) / complex(1, 1); };
  const auto expect = [&](const Mirror& plate, complex factor) {
    b.mirrors = {plate};
    const Multipath m = b.compute();
    EXPECT_LT(std::abs(b.relative(m, 0, 1) - 2.0 * factor * 10.0 / leg), 1e-4 * 2 * 10 / leg);
  };
  expect(with_size(wall, 0.05, 0.03),
         edge(-0.025 * slant * scale, 0.025 * slant * scale) * edge(-.015 * scale, .015 * scale));
  Mirror half = wall;
  half.position.x() = 5005;
  expect(with_size(half, 1e4, 1e4), 0.5);
  half.position.x() = 5005.05;  // the bounce lies beyond the edge: what is bent round it
  expect(with_size(half, 1e4, 1e4), edge(0.05 * slant * scale, 1e6));
}

TEST(MirrorEchoes, lose_what_reflection_and_roughness_take) {
  GhostBench b({0, 0, 0}, {10, 1, 0}, {-1, 0.3, 0});
  b.mirrors = {{"wall", {0, 3, 0}, {0, -1, 0}}};
  const complex rigid = b.relative(b.compute(), 1, 1);
  const double cosine = 5 / std::hypot(10, 5);
  b.mirrors[0].rms_height = 2e-4;
  const double left = coherent_reflection_loss(2 * pi * 600, 2e-4, std::asin(cosine));
  EXPECT_LT(std::abs(b.relative(b.compute(), 1, 1) / rigid - left * left), 1e-6);
  EXPECT_LT(left, 0.95);
  b.mirrors[0].rms_height = 0;
  b.mirrors[0].solid = ElasticSolid{2300, 4000, 2400};
  const complex concrete = reflection_coefficient(*b.mirrors[0].solid, cosine, sea_water_density, 1500);
  EXPECT_LT(std::abs(b.relative(b.compute(), 1, 1) / rigid - concrete * concrete), 1e-6);
}

TEST(MirrorEchoes, leave_out_the_surfels_of_the_mirror_and_what_stands_behind_it) {
  GhostBench b({0, 0, 0}, {10, 2.97, 0}, {0, -1, 0});
  b.mirrors = {{"wall", {0, 3, 0}, {0, -1, 0}}};
  EXPECT_EQ(b.compute().echoes.size(), 0u);
  b.mirrors[0].thickness = 0.01;
  EXPECT_GT(b.compute().echoes.size(), 0u);
  b.mirrors[0].position.y() = 2.9;
  EXPECT_EQ(b.compute().echoes.size(), 0u);
}

TEST(MirrorEchoes, pair_with_the_legs_by_surface_and_bottom_if_these_are_in) {
  GhostBench b({0, 0, -2}, {10, 1, -3}, {-1, 0.3, 0.1});
  b.environment.surface = SeaSurface{};
  b.mirrors = {{"wall", {0, 3, 0}, {0, -1, 0}}};
  EXPECT_EQ(b.compute().echoes.size(), 3u);
  b.with_levels = true;
  const Multipath m = b.compute();
  EXPECT_EQ(m.echoes.size(), 5u);  // out and back by the wall (2), one of them direct or by the surface
  EXPECT_EQ(m.planes.size(), 2u);
  for (const LegPair legs : m.legs) EXPECT_EQ(std::max(legs.out, legs.back), 2);
}

TEST(MirrorEchoes, refuse_a_head_that_does_not_face_a_wall) {
  GhostBench b({0, 0, 0}, {10, 1, 0}, {-1, 0, 0});
  b.mirrors = {{"wall", {0, 3, 0}, {0, 1, 0}}};
  expect_error(ErrorKind::argument, {"wall", "3 m behind"}, [&] { b.compute(); });
  b.mirrors.assign(64, {"wall", {0, 3, 0}, {0, -1, 0}});
  expect_error(ErrorKind::argument, {"64 mirrors face the head", "at most 63"}, [&] { b.compute(); });
}

// Along an edge that is longer, doubles do not resolve the phase: its integral would never end.
TEST(MirrorEchoes, refuse_edges_whose_phase_doubles_do_not_resolve) {
  GhostBench b({0, 0, 0}, {10, 1, 0}, {-1, 0, 0});
  b.mirrors = {with_size({"wall", {0, 3, 0}, {0, -1, 0}}, 1e9, 4)};
  expect_error(ErrorKind::argument, {"wall", "distance of a corner from the middle", "at most 1e7 m"},
               [&] { b.compute(); });
  b.mirrors = {{"wall", {0, 3e9, 0}, {0, -1, 0}}};
  expect_error(ErrorKind::argument, {"wall", "within 1e9 m of the origin"}, [&] { b.compute(); });
  b.mirrors = {with_size({"wall", {0, 3, 0}, {0, -1, 0}}, 1e6, 4)};
  EXPECT_EQ(b.compute().echoes.size(), 3u);
}

// A wall behind the head shows nothing to a fan ahead; one beside the head does.
TEST(MirrorEchoes, have_no_legs_outside_of_the_fan) {
  GhostBench b({0, 0, 0}, {10, 1, 0}, {-1, 0.3, 0});
  b.mirrors = {{"astern", {-2, 0, 0}, {1, 0, 0}}};
  EXPECT_EQ(b.compute().echoes.size(), 3u);
  b.view.fan = make_fan(121, radians(120), radians(2), radians(180));
  EXPECT_EQ(b.compute().echoes.size(), 0u);
  b.mirrors = {{"beside", {0, 3, 0}, {0, -1, 0}}};
  EXPECT_EQ(b.compute().echoes.size(), 3u);
}
