// SPDX-License-Identifier: BSD-3-Clause
// Calibrated targets: shapes fitted to surfels, and their echoes against published benchmarks and exact series.
#include "acoustics/glints.hpp"
#include "support/errors.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace {

using Eigen::Vector3d;
using complex = std::complex<double>;

Material coherent_material() {
  Material m{"steel"};
  m.coherent = 1;
  return m;
}

/// Adds a closed cylinder about the z axis.
void add_cylinder(SceneCloud& scene, const Vector3d& centre, double radius, double length, double spacing) {
  const auto around = std::lround(2 * pi * radius / spacing), along = std::lround(length / spacing);
  for (long j = 0; j < around; ++j)
    for (long k = 0; k < along; ++k) {
      const double angle = 2 * pi * static_cast<double>(j) / static_cast<double>(around);
      const Vector3d out(std::cos(angle), std::sin(angle), 0);
      const double z = length * ((static_cast<double>(k) + 0.5) / static_cast<double>(along) - 0.5);
      add_surfel(scene, centre + radius * out + z * Vector3d::UnitZ(), out,
                 2 * pi * radius * length / static_cast<double>(around * along));
    }
  for (const double end : {-0.5, 0.5})
    for (double x = -radius; x <= radius; x += spacing)
      for (double y = -radius; y <= radius; y += spacing)
        if (std::hypot(x, y) < radius - spacing / 2)
          add_surfel(scene, centre + Vector3d(x, y, end * length), Vector3d(0, 0, 2 * end), spacing * spacing);
}

SceneCloud sphere_scene(double radius, int count = 4000) {
  SceneCloud scene;
  scene.materials = {coherent_material()};
  add_sphere(scene, Vector3d::Zero(), radius, count);
  return scene;
}

/// The echoes of shapes fitted to a scene, for a head `range` m from the origin along -x.
struct TargetBench {
  SceneCloud scene;
  double frequency = 400e3, range = 20;
  Vector3d from = Vector3d(-1, 0, 0);
  double fan = 2 * pi;  ///< about +x

  Echoes echoes() const {
    View view{Pose::Identity(), make_fan(181, fan, radians(2), radians(180)), {0.01, 3000, 1}, {}};
    view.world_from_head.translation() = range * from;
    Pulse pulse = pulse_900k;
    pulse.centre_frequency = frequency;
    return glint_echoes(scene, fit_shapes(scene, Vector3d::Zero(), 1000), {}, false, view, {pulse, {1500, {}}, {}});
  }
  double target_strength() const {
    const Echoes e = echoes();
    complex sum = 0;
    for (const complex& amplitude : e.amplitude) sum += amplitude;
    return db_from_amplitude(std::abs(sum) / source_pressure(pulse_900k) * range * range);
  }
};

/// Returns the target strength of a rigid sphere [dB] (Anderson 1950): partial waves with the slope zero at the
/// surface.
double rigid_sphere(double radius, double wavenumber) {
  const double x = wavenumber * radius;
  complex sum = 0;
  for (unsigned n = 0; n < 1.5 * x + 20; ++n) {
    const auto slope = [&](auto f) { return (n / x) * f(n, x) - f(n + 1, x); };
    const double j = slope([](unsigned m, double y) { return std::sph_bessel(m, y); }),
                 y = slope([](unsigned m, double z) { return std::sph_neumann(m, z); });
    if (!std::isfinite(y) || std::abs(y) > 1e100) break;
    sum += (n % 2 ? -1.0 : 1.0) * (2.0 * n + 1) * j / complex(j, y);
  }
  return db_from_amplitude(std::abs(sum) / wavenumber);
}

}  // namespace

TEST(FitShapes, finds_sphere_cylinder_and_plate) {
  SceneCloud scene = sphere_scene(0.3);
  add_cylinder(scene, {3, 1, 0}, 0.2, 0.8, 0.02);
  add_rectangle(scene, {-3, 0, 0}, {1, 0, 0}, {0, 0.5, 0}, {0, 0, 1}, 0.025);
  const SmoothShapes shapes = fit_shapes(scene, Vector3d::Zero(), 100);
  ASSERT_EQ(shapes.targets.size(), 5u);  // sphere, cylinder and both ends, plate
  EXPECT_TRUE(shapes.mirrors.empty());
  const SmoothTarget &sphere = shapes.targets[0], &cylinder = shapes.targets[1], &plate = shapes.targets[4];
  EXPECT_NEAR(sphere.radius, 0.3, 1e-6);
  EXPECT_LT(sphere.surface.position.norm(), 1e-6);
  EXPECT_NEAR(cylinder.radius, 0.2, 1e-6);
  EXPECT_NEAR(cylinder.length, 0.8, 1e-3);
  EXPECT_LT((cylinder.surface.position - Vector3d(3, 1, 0)).norm(), 1e-4);
  ASSERT_EQ(plate.surface.corners.size(), 4u);
  EXPECT_LT((plate.surface.position - Vector3d(-2.5, 0.25, 0)).norm(), 1e-5);
  for (const Vector3d& corner : plate.surface.corners)
    EXPECT_NEAR((corner - plate.surface.position).norm(), std::hypot(0.5, 0.25), 1e-4);
  EXPECT_GT(plate.surface.normal.z(), 0.999);
}

TEST(FitShapes, makes_mirrors_of_flat_parts_with_noise) {
  SceneCloud scene;
  scene.materials = {Material{"quay"}};
  scene.materials[0].mirror = 1, scene.materials[0].reflection = 0.7, scene.materials[0].rms_height = 1e-3;
  add_rectangle(scene, {0, 0, -4}, {10, 0, 0}, {0, 0, 4}, {0, 1, 0}, 0.1);
  add_rectangle(scene, {0, 0, -4}, {0, 6, 0}, {0, 0, 4}, {1, 0, 0}, 0.1);
  for (std::size_t i = 0; i < scene.size(); ++i)
    scene.point[i] += 0.004f * std::sin(12.9898f * static_cast<float>(i * i % 1000)) * scene.normal[i];
  const SmoothShapes shapes = fit_shapes(scene, Vector3d(5, 5, -2), 100);
  ASSERT_EQ(shapes.mirrors.size(), 2u);
  EXPECT_TRUE(shapes.targets.empty());
  for (const Mirror& wall : shapes.mirrors) {
    EXPECT_EQ(wall.reflection, 0.7);
    EXPECT_EQ(wall.rms_height, 1e-3);
    EXPECT_GT(std::max(wall.normal.x(), wall.normal.y()), 0.99999);
    Eigen::AlignedBox3d box;
    for (const Vector3d& corner : wall.corners) box.extend(corner);
    EXPECT_LT((box.sizes() - (wall.normal.y() > 0.9 ? Vector3d(10, 0, 4) : Vector3d(0, 6, 4))).norm(), 0.03);
  }
  // Only what is within reach counts, and cuts the plane off.
  EXPECT_EQ(fit_shapes(scene, Vector3d(5, 5, -2), 2).mirrors.size(), 0u);
}

TEST(FitShapes, refuses_what_is_no_shape) {
  SceneCloud scene;
  scene.materials = {coherent_material()};
  for (int k = 0; k < 200; ++k)
    add_surfel(scene, {0.01 * k, 0.2 * std::sin(k), 0.2 * std::cos(3 * k)},
               Vector3d(std::sin(5 * k), std::cos(7 * k), std::sin(k)).normalized(), 1e-3);
  expect_error(ErrorKind::content, {"steel", "fit no plate, sphere or cylinder"},
               [&] { fit_shapes(scene, Vector3d::Zero(), 100); });
  scene = sphere_scene(0.3);
  scene.normals_oriented = false;
  expect_error(ErrorKind::content, {"steel", "no side"}, [&] { fit_shapes(scene, Vector3d::Zero(), 100); });
  scene.normals_oriented = true;
  scene.materials[0].coherent = 0, scene.materials[0].mirror = 1;
  SceneCloud ring;
  ring.materials = scene.materials;
  for (double x = -2; x <= 2; x += 0.05)
    for (double y = -2; y <= 2; y += 0.05)
      if (std::max(std::abs(x), std::abs(y)) > 1.5) add_surfel(ring, {x, y, 0}, {0, 0, 1}, 0.0025);
  expect_error(ErrorKind::content, {"steel", "of its outline"}, [&] { fit_shapes(ring, Vector3d::Zero(), 100); });
}

// Jech et al. 2015 (J. Acoust. Soc. Am. 138, 3742): rigid sphere of 10 mm radius at 400 kHz. Without the wave that
// creeps round it, a sphere has radius / 2.
TEST(SmoothTargets, sphere_is_the_benchmark_to_a_fifth_of_a_decibel) {
  const TargetBench b{sphere_scene(0.01)};
  EXPECT_NEAR(b.target_strength(), -45.84, 0.2);
  EXPECT_NEAR(b.target_strength(), db_from_amplitude(0.005), 0.01);
}

TEST(SmoothTargets, sphere_is_within_0_6_dB_of_the_exact_series_from_ka_10_on) {
  EXPECT_NEAR(rigid_sphere(0.01, 2 * pi * 400e3 / 1477.4), -45.84, 0.02);
  double worst_10 = 0, worst_50 = 0;
  for (double ka = 10; ka < 80; ka += 0.37) {
    const double off = std::abs(rigid_sphere(1, ka) - db_from_amplitude(0.5));
    (ka < 50 ? worst_10 : worst_50) = std::max(ka < 50 ? worst_10 : worst_50, off);
  }
  EXPECT_LT(worst_10, 0.6);
  EXPECT_LT(worst_50, 0.2);
}

// Jech et al. 2015: rigid cylinder of 10 mm radius and 70 mm length, broadside.
TEST(SmoothTargets, cylinder_is_the_benchmark_to_a_quarter_of_a_decibel) {
  SceneCloud scene;
  scene.materials = {coherent_material()};
  add_cylinder(scene, Vector3d::Zero(), 0.01, 0.07, 0.001);
  const double benchmark[][2] = {{100e3, -27.69}, {200e3, -24.99}, {400e3, -21.65}};
  for (const auto& [frequency, db] : benchmark) {
    const TargetBench b{scene, frequency, 100};
    EXPECT_NEAR(b.target_strength(), db, 0.25) << frequency;
    EXPECT_NEAR(b.target_strength(), db_from_power(0.01 * 0.07 * 0.07 * frequency / 3000), 0.02) << frequency;
  }
  // Off broadside by an angle t it has the pattern of its length, sin(x) / x, x = k L sin(t).
  TargetBench off{scene, 400e3, 100};
  const double broadside = off.target_strength(), t = 0.02;
  off.from = Vector3d(-std::cos(t), 0, std::sin(t));
  const double x = 2 * pi * 400e3 / 1500 * 0.07 * std::sin(t);
  EXPECT_NEAR(off.target_strength() - broadside, db_from_amplitude(std::abs(std::sin(x) / x)), 0.15);
}

// 10 cm at 900 kHz: the rows of a plate from near to far, and 20 log10(area / wavelength).
TEST(SmoothTargets, plate_is_that_of_its_edges_at_all_ranges) {
  SceneCloud scene;
  scene.materials = {coherent_material()};
  add_rectangle(scene, {0, -0.05, -0.05}, {0, 0.1, 0}, {0, 0, 0.1}, {-1, 0, 0}, 0.005);
  const double rows[][2] = {{1, -3.70}, {2, -2.60}, {5, 12.76}, {10, 14.87}, {50, 15.54}, {1000, 15.56}};
  for (const auto& [range, db] : rows) {
    const TargetBench b{scene, 900e3, range};
    EXPECT_NEAR(b.target_strength(), db, 0.01) << range;
  }
}

TEST(SmoothTargets, have_the_spreading_of_their_curvature_near_by) {
  TargetBench b{sphere_scene(1, 40000), 400e3, 2};
  const Echoes e = b.echoes();
  ASSERT_EQ(e.size(), 1u);
  EXPECT_NEAR(1500 * e.delay[0], 2, 1e-6);
  EXPECT_NEAR(std::abs(e.amplitude[0]) / source_pressure(pulse_900k), 1 / (2.0 * 1 * (1 + 1)), 1e-6);
  b.scene.materials[0].reflection = 0.5, b.scene.materials[0].rms_height = 1e-4;
  const double k = 2 * pi * 400e3 / 1500;
  EXPECT_NEAR(std::abs(b.echoes().amplitude[0]) / std::abs(e.amplitude[0]), 0.5 * std::exp(-2 * std::pow(k * 1e-4, 2)),
              1e-6);
}

TEST(SmoothTargets, are_silent_where_they_were_not_captured_and_when_hidden) {
  TargetBench b{sphere_scene(0.3), 400e3, 5};
  EXPECT_EQ(b.echoes().size(), 1u);
  SceneCloud half = b.scene;
  std::vector<std::uint32_t> keep;
  for (std::uint32_t s = 0; s < half.size(); ++s)
    if (half.point[s].x() > 0) keep.push_back(s);
  b.scene = subset(half, keep);
  EXPECT_EQ(b.echoes().size(), 0u);
  b.from = Vector3d(1, 0, 0);
  EXPECT_EQ(b.echoes().size(), 1u);
  b.scene.materials.push_back({"weed", 0.1});
  add_surfel(b.scene, {3, 0, 0}, {1, 0, 0}, 0.04, 1);
  EXPECT_EQ(b.echoes().size(), 0u);
}

TEST(SmoothTargets, behind_the_head_are_absent) {
  TargetBench b{sphere_scene(0.3), 400e3, 5};
  b.fan = radians(120);
  EXPECT_EQ(b.echoes().size(), 1u);
  b.from = Vector3d(1, 0, 0);
  EXPECT_EQ(b.echoes().size(), 0u);
  b.from = Vector3d(-0.1, 1, 0).normalized();  // 84 degrees to starboard
  EXPECT_EQ(b.echoes().size(), 0u);
}
