// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/profiles.hpp"
#include "support/point_targets.hpp"
#include "support/ray_tube.hpp"

namespace insonify::bent {

Scatterers random_scatterers(std::mt19937_64& random, std::size_t n, double range) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < n; ++i)
    points.push_back((0.02 + 0.98 * unit(random)) * range * unit_vector({2 * unit(random) - 1, unit(random) - 0.7}));
  return scatterers_at(points, 0.01F);
}

Eigen::Vector3d point_of(const Scatterers& s, std::size_t i) {
  return s.range[i] * unit_vector({s.azimuth[i], s.elevation[i]});
}

TEST(BendPaths, leaves_scatterers_alone_where_sound_speed_is_the_same) {
  std::mt19937_64 random(6);
  Scatterers s = random_scatterers(random, 100, 50);
  const Scatterers before = s;
  EXPECT_EQ(refract_paths({{0, 100}, {1500, 1500}}, 10, Pose::Identity(), s).silenced, 0u);
  EXPECT_EQ(s.range, before.range);
  EXPECT_EQ(s.azimuth, before.azimuth);
  EXPECT_EQ(s.elevation, before.elevation);
  EXPECT_EQ(refraction_bound({{0, 100}, {1500, 1500}}, 10, Pose::Identity(), s).range, 0);
  // Sound speed may change below all rays.
  EXPECT_EQ(refraction_bound({{0, 5000, 6000}, {1500, 1500, 1550}}, 10, Pose::Identity(), s).elevation, 0);
}

TEST(BendPaths, puts_a_scatterer_where_its_eigenray_says) {
  const Pose pose = pose_from_yaw_pitch_roll({100, -50, -12}, 0.7, 0.3, -0.2);
  Scatterers s = scatterers_at({{20, 5, -3}, {40, -10, 2}, {15, 0, -10}});
  const Scatterers before = s;
  EXPECT_EQ(refract_paths(layers, 12, pose, s).silenced, 0u);
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Eigen::Vector3d way = pose.linear() * point_of(before, i), seen = pose.linear() * point_of(s, i);
    const Eigenray ray = find_eigenray(layers, 12, 12 - way.z(), std::hypot(way.x(), way.y()));
    EXPECT_NEAR(s.range[i], sound_speed_at(layers, 12) * ray.travel_time, 1e-12);
    EXPECT_NEAR(std::asin(seen.z() / seen.norm()), ray.elevation, 1e-13);
    EXPECT_NEAR(std::atan2(seen.y(), seen.x()), std::atan2(way.y(), way.x()), 1e-13);
  }
}

TEST(BendPaths, keeps_a_scatterer_right_above_on_its_vertical) {
  const Pose pose = pose_from_yaw_pitch_roll({0, 0, -12}, 0, -pi / 2, 0);  // looks up
  Scatterers s = scatterers_at({{10, 0, 0}});
  refract_paths(layers, 12, pose, s);
  EXPECT_NEAR(s.range[0], sound_speed_at(layers, 12) * find_eigenray(layers, 12, 2, 0).travel_time, 1e-13);
  EXPECT_NEAR((point_of(s, 0).normalized() - Eigen::Vector3d::UnitX()).norm(), 0, 1e-9);
}

namespace {

/// Returns a wall of one surfel at each position, with normals roughly towards the head.
SceneCloud surfels_at(const std::vector<Eigen::Vector3d>& positions, const Eigen::Vector3d& head,
                      std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  SceneCloud scene;
  scene.origin = head;
  scene.materials = {Material{}};
  for (const Eigen::Vector3d& position : positions) {
    const Eigen::Vector3d to_head = (head - position).normalized();
    const Eigen::Vector3d tilted = to_head + 0.3 * Eigen::Vector3d(normal(random), normal(random), normal(random));
    add_surfel(scene, position, tilted.dot(to_head) > 0.1 ? tilted.normalized() : to_head, 0.01);
  }
  return scene;
}

// Thermoclines of 53 and 10 m/s, layers, a duct, a channel near the surface.
const SoundSpeedProfile refereed[] = {{{0, 6, 10, 30}, {1530, 1530, 1477, 1477}},
                                      {{0, 8, 12, 40}, {1500, 1500, 1490, 1490}},
                                      layers,
                                      duct,
                                      {{0, 5, 30}, {1490, 1500, 1470}}};

}  // namespace

// Compares place, bearing, level and incidence of scatterers with rays traced over distance and tubes of two rays.
TEST(BendPaths, has_the_levels_of_traced_ray_tubes) {
  std::mt19937_64 random(20);
  std::uniform_real_distribution<double> unit(0, 1);
  double most_db = 0;
  for (const SoundSpeedProfile& profile : refereed) {
    const traced::Water water{profile.depth, profile.sound_speed};
    int judged = 0;
    for (int k = 0; judged < 20 && k < 60; ++k) {
      const double head_depth = 2 + 20 * unit(random), depth = 1 + 25 * unit(random), out = 3 + 45 * unit(random);
      const Pose pose = pose_from_yaw_pitch_roll({1e3 * unit(random), 7, -head_depth}, 6 * unit(random),
                                                 unit(random) - 0.5, unit(random) - 0.5);
      const double to = 6 * unit(random);
      const Eigen::Vector3d head = pose.translation(),
                            position =
                                head + Eigen::Vector3d(out * std::cos(to), out * std::sin(to), head_depth - depth);
      const auto ray = traced::fastest_arrival(water, head_depth, depth, out);
      const double c = sound_speed_at(profile, head_depth);
      if (!ray) continue;
      const double focusing = ray->intensity * std::pow(c * ray->time, 2);
      if (focusing > 4 || focusing < 0.1) continue;  // close to a caustic or to a shadow
      ++judged;

      const SceneCloud scene = surfels_at({position}, head, random);
      Scatterers s = scatterers_at({pose.inverse() * position}, 0.01F);
      const Eigen::Vector3d normal = scene.normal[0].cast<double>();
      s.cos_incidence[0] = static_cast<float>(normal.dot((head - position).normalized()));
      const RefractedPaths paths = refract_paths(profile, head_depth, pose, s, {.scene = &scene});
      ASSERT_EQ(paths.silenced + paths.focused, 0U);

      const std::string what = "from " + std::to_string(head_depth) + " to " + std::to_string(depth) +
                               " m depth over " + std::to_string(out) + " m";
      EXPECT_NEAR(s.range[0], c * ray->time, 1e-3) << what;
      const Eigen::Vector3d seen = pose.linear() * unit_vector({s.azimuth[0], s.elevation[0]});
      EXPECT_NEAR(std::asin(seen.z()), ray->launch, radians(0.01)) << what;
      EXPECT_NEAR(std::remainder(std::atan2(seen.y(), seen.x()) - to, 2 * pi), 0, radians(0.01)) << what;
      const Eigen::Vector3d along(std::cos(ray->arrival) * std::cos(to), std::cos(ray->arrival) * std::sin(to),
                                  std::sin(ray->arrival));
      EXPECT_NEAR(s.cos_incidence[0], std::max(0.0, -normal.dot(along)), 1e-4) << what;
      const double straight = normal.dot((head - position).normalized());
      const double level_db = db_from_power(s.projected_area[0] / std::pow(s.range[0], 4)),
                   traced_db = db_from_power(0.01 * -normal.dot(along) / straight * std::pow(ray->intensity, 2));
      EXPECT_NEAR(level_db, traced_db, 0.02) << what;
      most_db = std::max(most_db, std::abs(db_from_power(focusing)));
    }
    EXPECT_EQ(judged, 20) << profile.sound_speed[0];
  }
  EXPECT_GT(most_db, 1.5);  // one way: spreading does differ
}

TEST(BendPaths, limits_and_counts_what_caustics_focus) {
  // Rays from the slow water below a thermocline cross far off.
  std::vector<Eigen::Vector3d> positions;
  for (double depth = 15; depth <= 28; depth += 0.25)
    for (double x = 60; x < 130; x += 2.5) positions.emplace_back(x, 0, 8.5 - depth);
  Scatterers s = scatterers_at(positions, 0.01F);
  const RefractedPaths paths = refract_paths(refereed[0], 8.5, Pose::Identity(), s);
  EXPECT_GT(paths.focused, 0U);
  EXPECT_LT(paths.focused, s.size() / 10);
  float most = 0;
  for (std::size_t i = 0; i < s.size(); ++i) most = std::max(most, s.projected_area[i]);
  EXPECT_NEAR(most, 0.01F * most_focusing * most_focusing, 1e-4);
}

TEST(BendPaths, silences_and_counts_the_shadow) {
  const SoundSpeedProfile split{{0, 20, 40}, {1480, 1520, 1480}};
  Scatterers s = scatterers_at({{180, 0, -10}, {20, 0, -10}, {179, 20, -10}}, 0.01F);
  EXPECT_EQ(refract_paths(split, 15, Pose::Identity(), s).silenced, 2u);
  EXPECT_EQ(s.projected_area[0], 0);
  EXPECT_GT(s.projected_area[1], 0.009F);
  EXPECT_EQ(s.projected_area[2], 0);
}

// Scatterers are interpolated among many, and solved one by one when alone.
TEST(BendPaths, keeps_its_accuracy_when_it_interpolates) {
  std::mt19937_64 random(7);
  for (const auto& [profile, head_depth] :
       {std::pair{layers, 12.0}, {duct, 19.0}, {duct, 20.0}, {random_profile(random, 40, 0.5), 30.0}}) {
    Scatterers many = random_scatterers(random, 20000, 60);
    const Scatterers before = many;
    const Pose pose = pose_from_yaw_pitch_roll({0, 0, 0}, 0, 0.2, 0.1);
    refract_paths(profile, head_depth, pose, many);
    double worst_range = 0, worst_angle = 0, worst_db = 0;
    for (std::size_t i = 0; i < many.size(); i += 7) {
      Scatterers one = scatterers_at({point_of(before, i)}, 0.01F);
      if (refract_paths(profile, head_depth, pose, one).silenced > 0) {
        EXPECT_EQ(many.projected_area[i], 0);
        continue;
      }
      worst_range = std::max(worst_range, std::abs(many.range[i] - one.range[0]));
      worst_db = std::max(worst_db, std::abs(db_from_power(many.projected_area[i] / one.projected_area[0])));
      worst_angle = std::max(worst_angle, (point_of(many, i).normalized() - point_of(one, 0).normalized()).norm());
    }
    EXPECT_LT(worst_db, 0.05);
    RecordProperty("worst_range", std::to_string(worst_range * 1e9) + " nm");
    EXPECT_LT(worst_range, 1e-6);
    EXPECT_LT(worst_angle, 1e-5);
  }
}

TEST(BendPaths, gives_the_same_bytes_for_any_number_of_threads) {
  std::mt19937_64 random(8);
  const Scatterers before = random_scatterers(random, 20000, 60);
  Scatterers one = before;
  refract_paths(layers, 12, Pose::Identity(), one, {.threads = 1});
  for (const int threads : {2, 7}) {
    Scatterers other = before;
    refract_paths(layers, 12, Pose::Identity(), other, {.threads = threads});
    EXPECT_EQ(one.range, other.range);
    EXPECT_EQ(one.azimuth, other.azimuth);
    EXPECT_EQ(one.elevation, other.elevation);
    EXPECT_EQ(one.projected_area, other.projected_area);
  }
}

TEST(BendPaths, does_not_change_when_world_and_head_move_sideways_and_turn_together) {
  std::mt19937_64 random(9);
  Scatterers a = random_scatterers(random, 50, 60), b = a;
  refract_paths(layers, 12, pose_from_yaw_pitch_roll({0, 0, -12}, 0, 0.1, 0), a);
  refract_paths(layers, 12, pose_from_yaw_pitch_roll({5e5, -3e6, 77}, 2, 0.1, 0), b);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR((point_of(a, i) - point_of(b, i)).norm(), 0, 1e-11);
}

TEST(RefractionBound, is_an_upper_bound) {
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> unit(0, 1);
  double closest = 0;
  for (int i = 0; i < 300; ++i) {
    const SoundSpeedProfile p = random_profile(random, 2 + i % 12, i % 3 == 0 ? 0.05 : i % 3 == 1 ? 0.5 : 5);
    const double head_depth = p.depth.back() * unit(random);
    const Pose pose = pose_from_yaw_pitch_roll({0, 0, 0}, unit(random), unit(random) - 0.5, unit(random));
    Scatterers s = random_scatterers(random, 60, 100 * unit(random) + 1);
    const Scatterers before = s;
    const RefractionBound bound = refraction_bound(p, head_depth, pose, s);
    refract_paths(p, head_depth, pose, s);
    for (std::size_t k = 0; k < s.size(); ++k) {
      const Eigen::Vector3d a = pose.linear() * point_of(before, k), b = pose.linear() * point_of(s, k);
      const double range = std::abs(b.norm() - a.norm()),
                   angle = std::abs(std::asin(b.z() / b.norm()) - std::asin(a.z() / a.norm()));
      EXPECT_LE(range, bound.range * (1 + 1e-9) + 1e-12);
      EXPECT_LE(angle, bound.elevation * (1 + 1e-9) + 1e-9);
      if (bound.range > 0) closest = std::max(closest, range / bound.range);
    }
  }
  EXPECT_GT(closest, 0.2);  // nor is it idle
}

TEST(BendPaths, refuses_bad_values) {
  Scatterers s = scatterers_at({{10, 0, 0}});
  EXPECT_THROW(refract_paths(layers, NAN, Pose::Identity(), s), Error);
  EXPECT_THROW(refraction_bound({}, 1, Pose::Identity(), s), Error);
  s.range[0] = 0;
  EXPECT_THROW(refract_paths(layers, 1, Pose::Identity(), s), Error);
  Scatterers none;
  EXPECT_EQ(refract_paths(layers, 1, Pose::Identity(), none).silenced, 0u);
  EXPECT_EQ(refraction_bound(layers, 1, Pose::Identity(), none).range, 0);
}

}  // namespace insonify::bent
