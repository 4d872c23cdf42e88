// SPDX-License-Identifier: BSD-3-Clause
// Compares the effect of bending on echoes by two surfaces with rays that are integrated.
#include "acoustics/double_echoes.hpp"
#include "acoustics/refracted_bench.hpp"
#include "core/random.hpp"
#include "core/text.hpp"
#include "scene/surface_rays.hpp"

namespace insonify::bent_pairs_checks {

using bent_bounces::Bench;
using bent_bounces::thermoclines;
using Eigen::Vector3d;

/// Adds a square of 6 m of `cells` x `cells` surfels.
void add_plate(SceneCloud& scene, const Vector3d& middle, const Vector3d& normal, int cells) {
  const Vector3d along = normal.unitOrthogonal(), across = normal.cross(along);
  for (int i = 0; i < cells * cells; ++i)
    add_surfel(scene,
               middle + 6 * ((i % cells + 0.5) / cells - 0.5) * along + 6 * ((i / cells + 0.5) / cells - 0.5) * across,
               normal, 36.0 / (cells * cells));
}

/// A ray between two positions [m from the head]: time, unit vectors along it at both ends, and intensity.
struct TracedLeg {
  double time, intensity;
  Vector3d leaves, arrives;
  TracedLeg(const Bench& b, const Vector3d& from, const Vector3d& to) {
    const Vector3d way = to - from;
    const auto ray =
        traced::fastest_arrival(b.water(), b.head_depth - from.z(), b.head_depth - to.z(), std::hypot(way.x(), way.y()))
            .value();
    const Vector3d level = Vector3d(way.x(), way.y(), 0).normalized();
    leaves = std::cos(ray.launch) * level + std::sin(ray.launch) * Vector3d::UnitZ();
    arrives = std::cos(ray.arrival) * level + std::sin(ray.arrival) * Vector3d::UnitZ();
    time = ray.time, intensity = ray.intensity;
  }
};

/// Returns two plates that face each other and the head, about places far apart.
SceneCloud facing_plates(const Vector3d& head, const Vector3d& first, const Vector3d& last) {
  SceneCloud scene;
  scene.origin = head;
  scene.materials = {{"m", 0.1}};
  add_plate(scene, head + first, ((last - first).normalized() - first.normalized()).normalized(), 60);
  add_plate(scene, head + last, ((first - last).normalized() - last.normalized()).normalized(), 60);
  return scene;
}

DoubleEchoes doubles_of(const Bench& b, const PreparedScene& scene, bool bent) {
  std::vector<std::uint32_t> all(scene.scene().size());
  std::iota(all.begin(), all.end(), 0);
  Transmission sent = b.sent;
  sent.echo_options.amplitude = SurfaceAmplitude::mean_power;
  return double_echoes(scene, all, b.view, sent, {4, bent ? &b.environment : nullptr});
}

TEST(BentPairs, of_surfaces_on_both_sides_of_a_thermocline_have_the_delays_directions_and_levels_of_rays) {
  if (!SurfaceRays::available()) GTEST_SKIP() << "built without Embree";
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> unit(0, 1);
  double farthest = 0, loudest = 0;
  for (const SoundSpeedProfile& profile : thermoclines)
    for (int k = 0; k < 6; ++k) {
      const Bench b(profile, 3 + 4 * unit(random), 6 * unit(random), 0.3 * unit(random) - 0.15,
                    0.6 * unit(random) - 0.3);
      const Vector3d ahead = b.view.world_from_head.linear().col(0);
      const auto somewhere = [&](double depth, double nearest) -> Vector3d {
        const double to = std::atan2(ahead.y(), ahead.x()) + 0.8 * unit(random) - 0.4, out = nearest + 4 * unit(random);
        return {out * std::cos(to), out * std::sin(to), b.head_depth - depth};
      };
      const Vector3d high = somewhere(1 + 4 * unit(random), 14), low = somewhere(10 + 5 * unit(random), 24);
      const PreparedScene scene(facing_plates(b.head(), high, low));
      const DoubleEchoes straight = doubles_of(b, scene, false), bent = doubles_of(b, scene, true);
      const std::string what = printed("head %.3g m deep, plates %.3g m apart", b.head_depth, (low - high).norm());
      ASSERT_EQ(bent.first, straight.first) << what;
      ASSERT_EQ(bent.last, straight.last) << what;
      ASSERT_GT(bent.echoes.size(), 5u) << what;
      EXPECT_EQ(bent.unreached, 0u);
      const std::size_t step = std::max<std::size_t>(1, bent.echoes.size() / 8);
      for (std::size_t e = 0; e < bent.echoes.size(); e += step) {
        const SceneCloud& s = scene.scene();
        const Vector3d first = s.point[bent.first[e]].cast<double>(), last = s.point[bent.last[e]].cast<double>();
        const TracedLeg out(b, Vector3d::Zero(), first), between(b, first, last), back(b, last, Vector3d::Zero());
        const double longer =
            b.speed * (out.time + between.time + back.time) - (first.norm() + (last - first).norm() + last.norm());
        // Surfels are 10 cm wide, and an image shows half of the path.
        EXPECT_NEAR(0.5 * b.speed * (bent.echoes.delay[e] - straight.echoes.delay[e]), 0.5 * longer, 0.01) << what;
        const Vector3d turned = b.view.world_from_head.linear().transpose() * (-back.arrives - last.normalized());
        EXPECT_NEAR(bent.echoes.u[e] - straight.echoes.u[e], turned.y(), radians(0.1)) << what;
        EXPECT_NEAR(bent.echoes.v[e] - straight.echoes.v[e], turned.z(), radians(0.1)) << what;
        const auto cosines = [&](const Vector3d& in, const Vector3d& on, const Vector3d& home) {
          const Vector3d n = s.normal[bent.first[e]].cast<double>(), m = s.normal[bent.last[e]].cast<double>();
          return n.dot(in) * n.dot(on) * m.dot(on) * m.dot(home);
        };
        const double level = out.intensity * between.intensity * back.intensity *
                             cosines(out.arrives, between.leaves, back.leaves) /
                             cosines(first.normalized(), (last - first).normalized(), -last.normalized());
        const double spread = first.squaredNorm() * (last - first).squaredNorm() * last.squaredNorm();
        const double arrives = between.arrives.dot(s.normal[bent.last[e]].cast<double>()) /
                               between.leaves.dot(s.normal[bent.last[e]].cast<double>());
        const double change = db_from_amplitude(std::abs(bent.echoes.amplitude[e] / straight.echoes.amplitude[e]));
        EXPECT_NEAR(change, db_from_power(level * spread * arrives), 0.2) << what;
        farthest = std::max(farthest, std::abs(0.5 * longer)), loudest = std::max(loudest, std::abs(change));
      }
    }
  EXPECT_GT(farthest, 0.1);  // so straight legs would fail
  EXPECT_GT(loudest, 2);
}

// Where sound speed falls with depth, rays that set out downwards leave a shadow below the surface.
TEST(BentPairs, that_no_ray_has_are_left_out_and_counted) {
  if (!SurfaceRays::available()) GTEST_SKIP() << "built without Embree";
  const Bench b({{0, 40}, {1540, 1420}}, 0.5, 0.4, 0, 0);
  const Vector3d ahead = b.view.world_from_head.linear().col(0);
  const PreparedScene scene(facing_plates(b.head(), 60 * ahead + Vector3d(0, 0, -1), 64 * ahead + Vector3d(5, 3, -12)));
  const DoubleEchoes straight = doubles_of(b, scene, false), bent = doubles_of(b, scene, true);
  EXPECT_EQ(straight.unreached, 0u);
  EXPECT_GT(bent.unreached, 10u);
  EXPECT_EQ(bent.echoes.size() + bent.unreached, straight.echoes.size());
}

TEST(BentPairs, of_water_of_one_sound_speed_are_straight) {
  if (!SurfaceRays::available()) GTEST_SKIP() << "built without Embree";
  const Bench b({{0, 30}, {1500, 1500}}, 5, 0.4, 0.1, 0.2);
  const Vector3d ahead = b.view.world_from_head.linear().col(0);
  const PreparedScene scene(facing_plates(b.head(), 20 * ahead + Vector3d(0, 0, 3), 24 * ahead - Vector3d(1, 2, 8)));
  const DoubleEchoes straight = doubles_of(b, scene, false), bent = doubles_of(b, scene, true);
  ASSERT_EQ(bent.echoes.size(), straight.echoes.size());
  ASSERT_GT(bent.echoes.size(), 5u);
  for (std::size_t e = 0; e < bent.echoes.size(); ++e) {
    EXPECT_NEAR(1500 * (bent.echoes.delay[e] - straight.echoes.delay[e]), 0, 1e-6);
    EXPECT_NEAR(std::abs(bent.echoes.amplitude[e] / straight.echoes.amplitude[e]), 1, 1e-6);
  }
}

}  // namespace insonify::bent_pairs_checks
