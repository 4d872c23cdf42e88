// SPDX-License-Identifier: BSD-3-Clause
// Compares heights of the ground, and parts that rest on it, with closed forms.
#include "scene/ground.hpp"

#include <cmath>
#include <random>

#include "core/units.hpp"
#include "support/rough_field.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace {

using Eigen::Vector2d, Eigen::Vector3d;

PlacedPart captured_part(SceneCloud cloud) {
  return {"bed", "", std::make_shared<const SceneCloud>(std::move(cloud)), true};
}

PlacedPart body_at(SceneCloud cloud, const Pose& pose) {
  return {"body", "body", std::make_shared<const SceneCloud>(std::move(cloud)), false, pose};
}

Pose pose_above(double x, double y, double z = 50) {
  Pose pose = Pose::Identity();
  pose.translation() << x, y, z;
  return pose;
}

SceneCloud ball_of(double radius) {
  SceneCloud cloud;
  add_sphere(cloud, Vector3d::Zero(), radius, 4000);
  return cloud;
}

/// Returns a plane z = x tan(slope) over 10 m x 10 m about the origin; points off it by `noise`, standard deviation.
SceneCloud sloped_bed(double slope, double spacing, double noise = 0) {
  SceneCloud cloud;
  std::mt19937 generator(3);
  std::normal_distribution<double> off(0, noise > 0 ? noise : 1);
  const Vector3d normal(-std::sin(slope), 0, std::cos(slope));
  for (double u = -5; u < 5; u += spacing)
    for (double y = -5; y < 5; y += spacing)
      add_surfel(cloud,
                 Vector3d(u * std::cos(slope), y, u * std::sin(slope)) + (noise > 0 ? off(generator) : 0) * normal,
                 normal, spacing * spacing);
  if (noise > 0) cloud.noise.assign(cloud.size(), static_cast<float>(noise));
  return cloud;
}

Vector3d surfel_at(const PlacedPart& part, std::size_t i) { return part.world_from_part * world(*part.cloud, i); }

/// Returns points of a field with normals by differences.
SceneCloud bed_of(const HeightField& field, double spacing, double noise) {
  SceneCloud cloud;
  for (const Vector3d& p : draw_points(field, {.spacing = spacing, .jitter = 0.3, .noise = noise})) {
    const double h = spacing / 2;
    const auto z = [&](double x, double y) { return field.at({x, y}); };
    const Vector3d normal =
        Vector3d(z(p.x() - h, p.y()) - z(p.x() + h, p.y()), z(p.x(), p.y() - h) - z(p.x(), p.y() + h), 2 * h);
    if (normal.allFinite()) add_surfel(cloud, p, normal.normalized(), spacing * spacing * normal.norm() / normal.z());
  }
  return cloud;
}

}  // namespace

TEST(Ground, is_the_plane_of_a_level_and_of_a_sloping_bed) {
  for (const double slope : {0.0, radians(30)}) {
    Ground ground;
    ground.add(captured_part(sloped_bed(slope, 0.1)));
    for (const Vector2d& p : {Vector2d(0, 0), Vector2d(1.234, -2.345), Vector2d(-3.03, 4.01)}) {
      const auto here = ground.at(p);
      ASSERT_TRUE(here);
      EXPECT_NEAR(here->height, p.x() * std::tan(slope), 1e-5);
      EXPECT_TRUE(here->normal.isApprox(Vector3d(-std::sin(slope), 0, std::cos(slope)), 1e-5));
    }
    EXPECT_FALSE(ground.at({0, 5.3})) << "three spacings beyond its end";
    EXPECT_TRUE(ground.at({0, 5.1}));
  }
}

TEST(Ground, averages_the_noise_of_a_scan) {
  Ground ground;
  ground.add(captured_part(sloped_bed(radians(20), 0.02, 0.01)));
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> along(-4, 4);
  double worst = 0, squares = 0;
  constexpr int positions = 500;
  for (int k = 0; k < positions; ++k) {
    const Vector2d p(along(generator), along(generator));
    const double off = ground.at(p).value().height - p.x() * std::tan(radians(20));
    worst = std::max(worst, std::abs(off)), squares += off * off;
  }
  EXPECT_LT(worst, 0.02) << "a spacing, or two deviations of the noise";
  EXPECT_LT(std::sqrt(squares / positions), 0.006) << "it is a mean of several surfels";
}

TEST(Ground, is_the_topmost_sheet_and_passes_over_strays_and_holes) {
  SceneCloud cloud;
  add_floor(cloud, {-2, -2, -1}, 80, 0.05);  // the bed
  for (double x = 0; x < 1; x += 0.05)       // a slab above a part of it, seen from both sides
    for (double y = -0.5; y < 0.5; y += 0.05) {
      add_surfel(cloud, {x, y, 0.2}, Vector3d::UnitZ(), 0.0025);
      add_surfel(cloud, {x, y, 0.1}, -Vector3d::UnitZ(), 0.0025);
    }
  add_surfel(cloud, {-1, 0, 3}, Vector3d::UnitZ(), 0.0025);  // a fish
  Ground ground;
  ground.add(captured_part(cloud));
  EXPECT_NEAR(ground.at({0.5, 0.01}).value().height, 0.2, 1e-6);
  EXPECT_NEAR(ground.at({-0.5, 0.01}).value().height, -1, 1e-6);
  EXPECT_NEAR(ground.at({-1, 0}).value().height, -1, 1e-6);
  EXPECT_FALSE(ground.at({3, 0}));
}

TEST(Ground, of_a_rough_bed_is_true_to_its_spacing) {
  constexpr double spacing = 0.04;
  const HeightField field = rough_field({.half = 1.5, .spacing = 0.03});
  Ground ground;
  ground.add(captured_part(bed_of(field, spacing, 0.2)));
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> along(-1.3, 1.3);
  for (int k = 0; k < 2000; ++k) {
    const Vector2d p(along(generator), along(generator));
    // At a step of the bed, any of its heights within reach is right.
    double low = field.at(p), high = low;
    for (double x = -1.5; x <= 1.5; x += 0.25)
      for (double y = -1.5; y <= 1.5; y += 0.25) {
        const double z = field.at(p + spacing * Vector2d(x, y));
        low = std::min(low, z), high = std::max(high, z);
      }
    const auto here = ground.at(p);
    ASSERT_TRUE(here);
    EXPECT_GT(here->height, low - spacing) << p.transpose();
    EXPECT_LT(here->height, high + spacing) << p.transpose();
  }
}

TEST(Ground, beside_a_cliff_is_no_higher_than_the_cliff) {
  // A raster of 2 cm: a bed with a ridge of 1 m between two cliffs of 79 degrees, whose surfels are five cells large.
  constexpr double cell = 0.02, crest = 0.6, half_width = 0.2, rise = 1;
  const auto z = [](double x) { return rise * std::max(0.0, 1 - std::abs(x - crest) / half_width); };
  SceneCloud cloud;
  for (double x = 0; x < 1.2; x += cell)
    for (double y = 0; y < 1; y += cell) {
      const double slope = (z(x + cell / 2) - z(x - cell / 2)) / cell;
      add_surfel(cloud, {x, y, z(x)}, Vector3d(-slope, 0, 1).normalized(), cell * cell * std::hypot(slope, 1));
    }
  Ground ground;
  ground.add(captured_part(cloud));
  for (double x = 0.1; x < 1.1; x += 0.003) {
    const double here = ground.at({x, 0.503}).value().height;
    double low = z(x), high = low;
    for (double d = -2 * cell; d <= 2 * cell; d += cell / 4)
      low = std::min(low, z(x + d)), high = std::max(high, z(x + d));
    EXPECT_GT(here, low - cell) << x;
    EXPECT_LT(here, high + cell) << x;
  }
}

TEST(PlaceOnGround, lets_a_ball_touch_a_plane_at_one_point) {
  constexpr double radius = 0.5;
  for (const double slope : {0.0, radians(30)}) {
    Ground ground;
    ground.add(captured_part(sloped_bed(slope, 0.1)));
    const PlacedPart ball =
        place_on_ground(body_at(ball_of(radius), pose_above(1, 2)), ground, PartRest::ground).value();
    const Vector3d centre = ball.world_from_part.translation();
    EXPECT_EQ(centre.head<2>(), Vector2d(1, 2)) << "it goes straight down";
    // The distance of the centre from the plane is the radius; surfels stand 2 degrees apart.
    EXPECT_NEAR(centre.z(), 1 * std::tan(slope) + radius / std::cos(slope), 0.002);
    EXPECT_TRUE(ball.surfels.empty()) << "all of it is there";
    EXPECT_TRUE(ball.world_from_part.linear().isIdentity());
  }
}

TEST(PlaceOnGround, tilts_what_rests_on_the_bed) {
  const double slope = radians(30);
  Ground ground;
  ground.add(captured_part(sloped_bed(slope, 0.1)));
  SceneCloud slab;
  add_rectangle(slab, {-0.5, -0.3, 0}, {1, 0, 0}, {0, 0.6, 0}, {0, 0, 1}, 0.05);
  Pose pose = pose_from_yaw_pitch_roll({-1, 0.5, 9}, radians(40), 0, 0);
  const PlacedPart flat = place_on_ground(body_at(slab, pose), ground, PartRest::bed).value();
  for (std::size_t i = 0; i < slab.size(); ++i) {
    const Vector3d p = surfel_at(flat, i);
    EXPECT_NEAR(p.z(), p.x() * std::tan(slope), 1e-4);
  }
  EXPECT_TRUE(flat.world_from_part.linear().col(2).isApprox(Vector3d(-std::sin(slope), 0, std::cos(slope)), 1e-4));
  // Upright it stands with its lower edge on the slope: none of it is below.
  const PlacedPart upright = place_on_ground(body_at(slab, pose), ground, PartRest::ground).value();
  double gap = 1e9;
  for (std::size_t i = 0; i < slab.size(); ++i) {
    const Vector3d p = surfel_at(upright, i);
    gap = std::min(gap, p.z() - p.x() * std::tan(slope));
  }
  EXPECT_NEAR(gap, 0, 1e-4);
}

TEST(PlaceOnGround, leaves_out_what_is_buried) {
  Ground ground;
  ground.add(captured_part(sloped_bed(0, 0.1)));
  const double radius = 0.2, bury = 0.05;
  const PlacedPart ball =
      place_on_ground(body_at(ball_of(radius), pose_above(0.03, 0.07)), ground, PartRest::ground, bury).value();
  EXPECT_NEAR(ball.world_from_part.translation().z(), radius - bury, 1e-3);
  // Archimedes: the fraction of a sphere's area below a level is that of its height.
  EXPECT_NEAR(static_cast<double>(ball.surfels.size()) / 4000, 1 - bury / (2 * radius), 0.002);
  for (const std::uint32_t i : ball.surfels) EXPECT_GE(surfel_at(ball, i).z(), -1e-5);
  EXPECT_FALSE(place_on_ground(body_at(ball_of(radius), pose_above(0, 0)), ground, PartRest::ground, 0.5))
      << "wholly below the ground";
  const PlacedPart free =
      place_on_ground(body_at(ball_of(radius), pose_above(0, 0, -7)), ground, PartRest::none).value();
  EXPECT_EQ(free.world_from_part.translation().z(), -7);
}

TEST(PlaceOnGround, stands_on_parts_that_stand_there_and_refuses_holes) {
  Ground ground;
  ground.add(captured_part(sloped_bed(0, 0.1)));
  SceneCloud table;
  add_rectangle(table, {-0.5, -0.5, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.05);
  ground.add(body_at(table, pose_above(2, 2, 0.8)));
  const PlacedPart ball = place_on_ground(body_at(ball_of(0.3), pose_above(2, 2)), ground, PartRest::ground).value();
  EXPECT_NEAR(ball.world_from_part.translation().z(), 0.8 + 0.3, 1e-3);
  expect_error(ErrorKind::content, {"part 'body' at x = 7, y = 0 m: no ground beneath it", "position_m = [x, y, z]"},
               [&] { place_on_ground(body_at(ball_of(0.3), pose_above(7, 0)), ground, PartRest::ground); });
  SceneCloud bar;
  add_rectangle(bar, {-0.1, -0.1, 0}, {4, 0, 0}, {0, 0.2, 0}, {0, 0, 1}, 0.05);
  expect_error(ErrorKind::content, {"part 'body'", "no ground beneath more than half of it"},
               [&] { place_on_ground(body_at(bar, pose_above(4.8, 0)), ground, PartRest::ground); });
  EXPECT_EQ(ground.captured_box().max.z(), 0);
}

// Plates of 5 cm to 20 m at random places, and far from them: the ground is that of the highest plate alone.
TEST(Ground, of_many_parts_is_that_of_the_highest_one) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> any(-30, 30), height(-1, 1), exponent(-1.3, 1.3);
  Ground all;
  std::vector<Ground> alone(300);
  for (Ground& one : alone) {
    const double size = std::pow(10, exponent(generator)), spacing = size / 8;
    SceneCloud plate;
    for (int i = 0; i < 64; ++i)
      add_surfel(plate, {spacing * (i % 8), spacing * (i / 8), 0}, Vector3d::UnitZ(), spacing * spacing);
    const double away = any(generator) > 27 ? 1e5 : 0;
    const PlacedPart part = body_at(plate, pose_above(any(generator) + away, any(generator), height(generator)));
    one.add(part), all.add(part);
  }
  std::size_t found = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector2d position(any(generator) + (i % 20 == 0 ? 1e5 : 0), any(generator));
    std::optional<GroundPoint> expected;
    for (const Ground& one : alone)
      if (const auto here = one.at(position); here && !(expected && expected->height >= here->height)) expected = here;
    const auto here = all.at(position);
    ASSERT_EQ(here.has_value(), expected.has_value()) << position.transpose();
    if (!here) continue;
    ++found;
    ASSERT_EQ(here->height, expected->height) << position.transpose();
    ASSERT_EQ(here->normal, expected->normal) << position.transpose();
  }
  EXPECT_GT(found, 500u);
}

// Others stand beside the bed where copies do; a copy turned about its normal has other surfels there.
TEST(Ground, of_copies_in_one_place_is_that_of_one) {
  const PlacedPart bed = captured_part(sloped_bed(radians(10), 0.1, 0.05));
  PlacedPart copy = body_at(*bed.cloud, Pose::Identity()), turned = copy, above = copy;
  turned.world_from_part.rotate(Eigen::AngleAxisd(pi, Vector3d::UnitY()));
  above.world_from_part.translation().z() += 1e-3;
  Ground one, copies, others;
  one.add(bed), copies.add(bed), others.add(bed);
  for (int k = 0; k < 5; ++k) copies.add(copy);
  others.add(turned), others.add(above);
  std::size_t differ = 0;
  for (double x = -4; x < 4; x += 0.37)
    for (double y = -4; y < 4; y += 0.41) {
      const auto here = one.at({x, y}), same = copies.at({x, y}), other = others.at({x, y});
      ASSERT_TRUE(here && same && other);
      ASSERT_EQ(here->height, same->height);
      ASSERT_EQ(here->normal, same->normal);
      ASSERT_GE(other->height, here->height + 0.9e-3);
      differ += other->height > here->height + 1.1e-3;
    }
  EXPECT_GT(differ, 20U) << "where the turned bed is higher";
}
