// SPDX-License-Identifier: BSD-3-Clause
// Fits random scanned bodies: the result is the right shape with its position and size, or a refusal.
#include "acoustics/fit_shapes.hpp"

#include "acoustics/sampled_bodies.hpp"
#include "core/text.hpp"
#include "support/errors.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace {

using namespace sampled;

double polygon_area(const std::vector<Vector3d>& corners) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
  return 0.5 * sum.norm();
}

/// Returns a random number between two limits, uniform in its logarithm.
double between(std::mt19937& random, double low, double high) {
  return low * std::pow(high / low, std::uniform_real_distribution<double>()(random));
}

Scan scan_of(std::mt19937& random, double most_noise) {
  std::uniform_int_distribution<int> coin(0, 1);
  Scan scan;
  scan.lattice = coin(random), scan.rounded = coin(random);
  scan.points = static_cast<int>(between(random, 300, 6000));
  scan.noise = coin(random) ? between(random, 1e-5, most_noise) : 0;
  scan.range = between(random, 3, 30);
  return scan;
}

std::string name_of(const Scan& s) {
  return printed("%d points, %s, noise %.2g mm, at %.3g m, float of %s", s.points, s.lattice ? "lattice" : "random",
                 1e3 * s.noise, s.range, s.rounded ? "the world" : "its own origin");
}

SmoothShapes shapes_of(const Scanned& body) { return fit_shapes(body.cloud, Vector3d::Zero(), 100); }

}  // namespace

TEST(FittedBodies, plates_are_plates_where_they_are_and_as_large_as_they_are) {
  std::mt19937 random(5);
  struct OffLevels {
    double sum = 0, squares = 0, count = 0;  // [dB]
  } off[2][2];
  for (unsigned k = 0; k < 200; ++k) {
    const double width = between(random, 0.05, 2), height = width * between(random, 0.5, 1);
    Scan scan = scan_of(random, 1e-3);
    scan.estimated = k % 2;
    scan.jitter = k % 3 == 0 ? 0.45 : 0;
    const Scanned body = scanned({rectangle(width, height)}, scan, k);
    const SmoothShapes found = shapes_of(body);
    ASSERT_EQ(found.targets.size(), 1u) << k << ": " << width << " x " << height << " m, " << name_of(scan);
    const SmoothTarget& plate = found.targets[0];
    EXPECT_EQ(plate.radius, 0) << k << ": " << width << " x " << height << " m, " << name_of(scan);
    const Vector3d normal = body.world_from_body.linear().col(2);
    EXPECT_LT((plate.surface.normal.normalized() - normal).norm(),
              1e-5 + 16 * scan.noise / height / std::sqrt(scan.points))
        << k << ": " << name_of(scan);
    EXPECT_LT(std::abs(normal.dot(plate.surface.position - body.world_from_body.translation())),
              1e-5 + 4 * scan.noise / std::sqrt(scan.points));
    // Face on and far away its level is that of its area.
    const double off_db = db_from_amplitude(polygon_area(plate.surface.corners) / (width * height));
    EXPECT_LT(std::abs(off_db), 0.4) << k << ": " << name_of(scan);
    OffLevels& those = off[scan.estimated][scan.lattice];
    those.sum += off_db, those.squares += off_db * off_db, those.count += 1;
  }
  for (const auto& by_areas : off)
    for (const OffLevels& those : by_areas) {
      EXPECT_LT(std::abs(those.sum / those.count), 0.03);
      EXPECT_LT(std::sqrt(those.squares / those.count), 0.1);
    }
}

TEST(FittedBodies, cylinders_are_cylinders) {
  std::mt19937 random(6);
  for (unsigned k = 0; k < 100; ++k) {
    const double radius = between(random, 0.03, 0.6), length = radius * between(random, 1.5, 8);
    const Scan scan = scan_of(random, 1e-3);
    std::vector<Patch> patches = cylinder(radius, length, k % 3 == 0 ? pi : 2 * pi);
    if (k % 3 == 0) patches.resize(1);  // half of its side
    const Scanned body = scanned(patches, scan, k);
    const SmoothShapes found = shapes_of(body);
    const std::string what = printed("%u: radius %.3g m, length %.3g m, ", k, radius, length) + name_of(scan);
    ASSERT_EQ(found.targets.size(), patches.size()) << what;
    const SmoothTarget& side = found.targets[0];
    const double off_by_noise = 8 * scan.noise / std::sqrt(scan.points);
    EXPECT_NEAR(side.radius, radius, 1e-5 + 0.003 * radius + off_by_noise) << what;
    EXPECT_NEAR(side.length, length, 0.01 * length + 0.2 * std::sqrt(total_area(body.cloud) / scan.points)) << what;
    const Vector3d axis = body.world_from_body.linear().col(2),
                   off = side.surface.position - body.world_from_body.translation();
    EXPECT_LT(side.axis.cross(axis).norm(), 1e-5 + 0.003) << what;
    EXPECT_LT((off - axis * axis.dot(off)).norm(), 1e-5 + 0.003 * radius + off_by_noise) << what;
    EXPECT_LT(std::abs(axis.dot(off)), 0.01 * length) << what;
  }
}

TEST(FittedBodies, spheres_are_spheres) {
  std::mt19937 random(7);
  for (unsigned k = 0; k < 100; ++k) {
    const double radius = between(random, 0.02, 1);
    Scan scan = scan_of(random, std::min(4e-3, 0.03 * radius));
    const Scanned body = scanned({sphere(radius, k % 3 == 0 ? 0 : -0.999)}, scan, k);
    const std::string what = printed("%u: radius %.3g m, ", k, radius) + name_of(scan);
    const SmoothShapes found = shapes_of(body);
    ASSERT_EQ(found.targets.size(), 1u) << what;
    EXPECT_EQ(found.targets[0].length, 0) << what;
    EXPECT_NEAR(found.targets[0].radius, radius, 1e-5 + 0.003 * radius + 4 * scan.noise / std::sqrt(scan.points))
        << what;
    EXPECT_LT((found.targets[0].surface.position - body.world_from_body.translation()).norm(), 1e-5 + 0.005 * radius)
        << what;
  }
}

// A mesh has facets: of a cylinder they are no plates, and of a cone no plates either, however many surfels they have.
TEST(FittedBodies, of_facets_are_what_the_facets_are_of) {
  for (const int points : {1000, 5000, 30000}) {
    Scan scan;
    scan.points = points, scan.jitter = 0.2;
    std::vector<Patch> round = cylinder(0.3, 1);
    round[0] = faceted(round[0], 32);
    const SmoothShapes found = shapes_of(scanned(round, scan, 1));
    ASSERT_EQ(found.targets.size(), 3u) << points;
    EXPECT_NEAR(found.targets[0].radius, 0.3, 0.002) << points;
    EXPECT_NEAR(found.targets[0].length, 1, 0.01) << points;
    const Patch cone = revolved([](double v) { return 0.4 - 0.25 * v; }, [](double v) { return 0.5 * v; });
    const Scanned facets = scanned({faceted(cone, 32)}, scan, 2);
    EXPECT_THAT(error_of([&] { shapes_of(facets); }, ErrorKind::content), testing::HasSubstr("surfels about ("))
        << points;
  }
  // A box has plates: six, or the five that were seen.
  std::vector<Patch> box;
  for (const double turn : {0.0, 0.5, 1.0, 1.5})
    box.push_back([=](double u, double v) -> Vector3d {
      return Eigen::AngleAxisd(turn * pi, Vector3d::UnitZ()) * Vector3d(0.25, 0.5 * (u - 0.5), 0.4 * (v - 0.5));
    });
  box.push_back([](double u, double v) { return Vector3d(0.5 * (u - 0.5), 0.5 * (v - 0.5), 0.2); });
  Scan scan;
  scan.noise = 1e-3;
  EXPECT_EQ(shapes_of(scanned(box, scan, 3)).targets.size(), 5u);
}

TEST(FittedBodies, that_are_none_of_these_are_refused) {
  const auto cone = [](double r, double top, double h) {
    return std::vector<Patch>{revolved([=](double v) { return r + (top - r) * v; }, [=](double v) { return h * v; }),
                              disc(r, -1e-9), disc(top, h)};
  };
  const auto scaled = [](Patch patch, Vector3d by) -> Patch {
    return [=](double u, double v) -> Vector3d { return by.cwiseProduct(patch(u, v)); };
  };
  const auto raised = [](double size, std::function<double(double, double)> height) -> Patch {
    return [=](double u, double v) {
      return Vector3d(size * (u - 0.5), size * (v - 0.5), height(size * (u - 0.5), size * (v - 0.5)));
    };
  };
  const auto ring = [](double big, double small) -> Patch {
    return [=](double u, double v) {
      const double a = 2 * pi * u, b = 2 * pi * v;
      return Vector3d((big + small * std::cos(b)) * std::cos(a), (big + small * std::cos(b)) * std::sin(a),
                      small * std::sin(b));
    };
  };
  const std::pair<const char*, std::vector<Patch>> bodies[] = {
      {"cone", cone(0.3, 1e-3, 0.4)},
      {"frustum", cone(0.3, 0.15, 0.4)},
      {"nearly a cylinder", cone(0.2, 0.17, 0.8)},
      {"ellipsoid", {scaled(sphere(1, -0.999), {0.4, 0.15, 0.15})}},
      {"flat ellipsoid", {scaled(sphere(1, -0.999), {0.3, 0.3, 0.25})}},
      {"ring", {ring(0.4, 0.1)}},
      {"saddle", {raised(0.5, [](double x, double y) { return 0.6 * (x * x - y * y); })}},
      {"wavy plate", {raised(0.5, [](double x, double) { return 0.02 * std::sin(25 * x); })}},
      {"dish", {revolved([](double v) { return 0.4 * v; }, [](double v) { return -0.3 * v * v; })}},
      {"egg",
       {revolved([](double v) { return 0.2 * std::sqrt(v * (1 - v)) * (1 + 0.5 * v); },
                 [](double v) { return 0.5 * v; })}}};
  std::mt19937 random(8);
  for (unsigned k = 0; k < 30; ++k) {
    const auto& [name, patches] = bodies[k % 10];
    Scan scan = scan_of(random, 3e-3);
    scan.points = k < 10 ? 20000 : scan.points;
    const Scanned body = scanned(patches, scan, k);
    const std::string what = printed("%u: %s, ", k, name) + name_of(scan);
    try {
      const SmoothShapes found = shapes_of(body);
      ADD_FAILURE() << what << ": " << found.targets.size() << " shapes, radius " << found.targets[0].radius;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::content) << what;
      EXPECT_THAT(error.what(), testing::HasSubstr("'body'")) << what;
      EXPECT_THAT(error.what(), testing::HasSubstr("surfels about (")) << what;
    }
  }
}
