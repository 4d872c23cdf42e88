// SPDX-License-Identifier: BSD-3-Clause
// Compares echoes by two surfaces with form factors and closed forms.
#include "acoustics/double_echoes.hpp"

#include "core/random.hpp"
#include "scene/surface_rays.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

using Eigen::Vector3d;

namespace {

/// Adds the surfels of a square of 1 m with one corner at the origin, jittered within their cells.
void add_unit_square(SceneCloud& scene, const Vector3d& along, const Vector3d& across, int per_side,
                     const Vector3d& corner = Vector3d::Zero()) {
  for (int i = 0; i < per_side * per_side; ++i) {
    const auto u = random_uniform(3, RandomStage::scene_points, {scene.size(), 0, 0});
    add_surfel(scene, corner + (i % per_side + u[0]) / per_side * along + (i / per_side + u[1]) / per_side * across,
               along.cross(across), 1.0 / (per_side * per_side));
  }
}

/// Returns a bed and a wall of 1 m that meet along y, both turned to +x +z.
SceneCloud corner_of(double lambert_mu, int per_side) {
  SceneCloud scene;
  scene.materials = {{"m", lambert_mu}};
  add_unit_square(scene, Vector3d::UnitX(), Vector3d::UnitY(), per_side);
  add_unit_square(scene, Vector3d::UnitY(), Vector3d::UnitZ(), per_side);
  return scene;
}

struct Room {
  PreparedScene scene;
  View view{Pose::Identity(), make_fan(3, radians(90), radians(1), radians(90)), {0.1, 1000, 0.1}, {}};
  Transmission sent{pulse_900k, {1500, {0, 0, 0}}, {.amplitude = SurfaceAmplitude::mean_power}};
  double rays = 1;  ///< about this number in all

  Room(SceneCloud&& cloud, const Vector3d& head, double rays_in_all) : scene(std::move(cloud)) {
    view.world_from_head.translation() = head;
    double cells = 0;  // cells of one ray each
    for (std::size_t i = 0; i < scene.scene().size(); ++i)
      cells += scene.scene().area[i] / (scene.scene().point[i].cast<double>() - head).norm();
    rays = rays_in_all / (cells / (view.fan.beam_width * range_resolution(sent.pulse, 1500)));
  }
  DoubleEchoes doubles(std::uint64_t seed = 1, int threads = 0) const {
    Transmission seeded = sent;
    seeded.echo_options.seed = seed, seeded.echo_options.threads = threads;
    std::vector<std::uint32_t> all(scene.scene().size());
    std::iota(all.begin(), all.end(), 0);
    return double_echoes(scene, all, view, seeded, {rays});
  }
  /// Returns the expected power of the direct echoes.
  double direct_power() const {
    const SceneCloud& s = scene.scene();
    double sum = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Vector3d from_head = s.point[i].cast<double>() - view.world_from_head.translation();
      const double r = from_head.norm(), cosine = -s.normal[i].cast<double>().dot(from_head) / r;
      sum += s.materials[0].lambert_mu * cosine * cosine * s.area[i] / (r * r * r * r);
    }
    return source_pressure(sent.pulse) * source_pressure(sent.pulse) * sum;
  }
};

/// Returns the expected power where one beam holds both senses of each pair, which add coherently.
double power_in_one_beam(const Echoes& e) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < e.size(); i += 2) sum += std::norm(e.amplitude[i] + e.amplitude[i + 1]);
  return sum;
}

class DoubleEchoesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!SurfaceRays::available()) GTEST_SKIP() << "built without Embree";
  }
};

}  // namespace

// Power that rays by the cosine carry from a unit square to another: .200043776 and .199824896 by the closed forms of
// the form factor (Howell, Catalog of radiation heat transfer configuration factors, C-14 and C-11).
TEST_F(DoubleEchoesTest, rays_have_the_form_factors_of_unit_squares) {
  SceneCloud parallel;
  add_unit_square(parallel, Vector3d::UnitX(), Vector3d::UnitY(), 100);
  add_unit_square(parallel, Vector3d::UnitY(), Vector3d::UnitX(), 100, Vector3d::UnitZ());
  const struct {
    SceneCloud scene;
    double factor;
  } pairs[] = {{corner_of(1 / pi, 100), .200043776}, {parallel, .199824896}};
  for (const auto& [scene, factor] : pairs) {
    const SurfaceRays rays(scene, 1.2);
    const auto sent = scene.size() / 2;
    constexpr std::uint64_t each = 150;
    double carried = 0;
    for (std::uint32_t i = 0; i < sent; ++i)
      for (std::uint64_t k = 0; k < each; ++k) {
        const auto u = random_uniform(5, RandomStage::surface_ray, {i, k, 0});
        const double sine = std::sqrt((static_cast<double>(k) + u[0]) / each), turn = 2 * pi * u[1];
        const Vector3d direction(sine * std::cos(turn), sine * std::sin(turn), std::sqrt(1 - sine * sine));
        carried += rays.first_hit({i, scene.point[i], direction.cast<float>()}).density;
      }
    EXPECT_NEAR(carried / static_cast<double>(sent * each), factor, 1e-3);
  }
}

// A corner of Lambert's law, mu of both plates, seen from afar at 45 degrees: 2 pi mu F over that of the plates alone.
TEST_F(DoubleEchoesTest, of_a_corner_have_the_level_of_its_form_factor) {
  const struct {
    double coefficient, level_db;
  } rows[] = {{1 / pi, -3.98}, {0.1, -9.01}, {0.0219, -15.61}, {0.01, -19.01}, {0.002, -26.01}};
  for (const auto& [coefficient, level_db] : rows) {
    const Room room(corner_of(coefficient, 60), Vector3d(300, 0.5, 300), 400000);
    const DoubleEchoes doubles = room.doubles();
    EXPECT_NEAR(db_from_power(power_in_one_beam(doubles.echoes) / room.direct_power()), level_db, 0.1) << coefficient;
    EXPECT_NEAR(static_cast<double>(doubles.rays), 400000, 4000);
  }
}

// A bed and a wall of different mu near the head: the sum of all pairs of patches, by the definition.
TEST_F(DoubleEchoesTest, are_those_of_the_sum_over_all_pairs) {
  constexpr int per_side = 40;
  const double of_bed = 0.1, of_wall = 0.02;
  SceneCloud cloud = corner_of(of_bed, per_side);
  cloud.materials.push_back({"wall", of_wall});
  std::fill(cloud.material.begin() + per_side * per_side, cloud.material.end(), std::uint16_t{1});
  const Vector3d head(1.6, 0.3, 0.7);
  double sum = 0;
  for (int i = 0; i < per_side * per_side; ++i)
    for (int j = per_side * per_side; j < 2 * per_side * per_side; ++j) {
      const Vector3d bed = cloud.point[static_cast<std::size_t>(i)].cast<double>(),
                     wall = cloud.point[static_cast<std::size_t>(j)].cast<double>();
      const double ri = (head - bed).norm(), rj = (head - wall).norm(), rij = (wall - bed).norm(),
                   area = 1.0 / (per_side * per_side);
      const double sigmas =
          of_bed * (head - bed).z() / ri * wall.z() / rij * of_wall * (head - wall).x() / rj * bed.x() / rij;
      sum += 2 * sigmas * area * area / (ri * ri * rj * rj * (rij * rij + area / pi));  // both senses
    }
  const Room room(std::move(cloud), head, 400000);
  double power = 0;
  for (const std::complex<double>& a : room.doubles().echoes.amplitude) power += std::norm(a);
  const double source = source_pressure(room.sent.pulse);
  EXPECT_NEAR(db_from_power(power / (source * source * sum)), 0, 0.1);
}

// Half paths lie at the corner's edge or behind it: shares within 1, 2.5, 5, 10 cm, of the integral over both plates.
TEST_F(DoubleEchoesTest, of_a_corner_lie_behind_its_edge) {
  const Room room(corner_of(0.1, 80), Vector3d(3000, 0.5, 3000), 400000);
  Room far = room;
  far.view.gate = {1, 10000, 1};
  const Echoes echoes = far.doubles().echoes;
  const double edge = 3000 * std::sqrt(2.0);
  double all = 0, within[4] = {};
  const double reach[] = {0.01, 0.025, 0.05, 0.1};
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const double behind = 750 * echoes.delay[i] - edge, power = std::norm(echoes.amplitude[i]);
    EXPECT_GT(behind, -1e-3);
    all += power;
    for (int k = 0; k < 4; ++k) within[k] += behind < reach[k] ? power : 0;
  }
  const double shares[] = {0.31, 0.54, 0.75, 0.92};
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(within[k] / all, shares[k], 0.01) << reach[k];
}

// Two plates that no beam resolves: their senses add coherently, to twice the power of the same echoes with independent
// phases; resolved by direction, each beam receives one sense.
TEST_F(DoubleEchoesTest, of_both_senses_add_coherently) {
  Room room(corner_of(0.1, 10), Vector3d(300, 0.5, 300), 300);
  room.sent.echo_options.amplitude = SurfaceAmplitude::complex_normal;
  double together = 0, resolved = 0, apart = 0;
  constexpr int draws = 2000;
  for (int seed = 1; seed <= draws; ++seed) {
    const DoubleEchoes doubles = room.doubles(static_cast<std::uint64_t>(seed));
    const Echoes& e = doubles.echoes;
    std::complex<double> sum = 0, bed = 0, wall = 0;
    for (std::size_t i = 0; i < e.size(); ++i) {
      ASSERT_NEAR(std::abs(e.amplitude[i] / e.amplitude[i ^ 1] - 1.0), 0, 1e-9) << "both senses of a pair";
      sum += e.amplitude[i];
      (doubles.last[i] < 100 ? bed : wall) += e.amplitude[i];
      apart += std::norm(e.amplitude[i]);
    }
    together += std::norm(sum), resolved += std::norm(bed) + std::norm(wall);
  }
  EXPECT_NEAR(together / apart, 2, 0.15);
  EXPECT_NEAR(resolved / apart, 1, 0.06);
}

// Inside a sphere of Lambert's law, at its centre: double over single 2 pi mu; shares 2 (x - R) / R^2 of half paths x
// from R to 2 R, so their mean is 5 R / 3.
TEST_F(DoubleEchoesTest, of_a_sphere_seen_from_its_centre) {
  constexpr double radius = 2;
  constexpr int surfels = 40000;
  SceneCloud sphere;
  sphere.materials = {{"m", 0.01}};
  for (int i = 0; i < surfels; ++i) {
    const double z = 1 - (2 * i + 1.0) / surfels, turn = i * pi * (3 - std::sqrt(5.0)), across = std::sqrt(1 - z * z);
    const Vector3d direction(across * std::cos(turn), across * std::sin(turn), z);
    add_surfel(sphere, radius * direction, -direction, 4 * pi * radius * radius / surfels);
  }
  const Room room(std::move(sphere), Vector3d::Zero(), 400000);
  const Echoes e = room.doubles().echoes;
  EXPECT_NEAR(db_from_power(power_in_one_beam(e) / room.direct_power()), -12.02, 0.03);
  double all = 0, mean = 0, half = 0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double power = std::norm(e.amplitude[i]), x = 750 * e.delay[i];
    all += power, mean += power * x, half += x < 1.5 * radius ? power : 0;
  }
  EXPECT_NEAR(mean / all, 5 * radius / 3, 0.003 * radius);
  EXPECT_NEAR(half / all, 0.25, 0.005);
}

namespace {

/// Lambert's law and a lobe of facets, whose slope the sampler knows or not.
class WithLobe final : public SurfaceScattering {
 public:
  explicit WithLobe(double known_slope) : known_slope_(known_slope) {}
  double cross_section(const PathAngles& p) const override {
    if (!(p.cos_in > 0 && p.cos_out > 0)) return 0;
    const double cos_tilt = (p.cos_in + p.cos_out) / std::sqrt(2 * (1 + p.cos_between));
    return 0.01 * p.cos_in * p.cos_out + 0.3 * std::exp(-(1 / (cos_tilt * cos_tilt) - 1) / 0.04);
  }
  double back(double cosine) const override { return cross_section({cosine, cosine, 1}) / cosine; }
  double lobe_slope() const override { return known_slope_; }

 private:
  double known_slope_;
};

}  // namespace

TEST_F(DoubleEchoesTest, have_one_level_whatever_directions_are_drawn) {
  Room room(corner_of(0.1, 40), Vector3d(20, 0.5, 12), 1000000);
  double level[2];
  for (const bool known : {false, true}) {
    room.sent.surfaces = {std::make_shared<const WithLobe>(known ? 0.2 : 0)};
    level[known] = db_from_power(power_in_one_beam(room.doubles().echoes));
  }
  EXPECT_NEAR(level[0], level[1], 0.1);
}

TEST_F(DoubleEchoesTest, need_both_surfaces_in_view_and_nothing_between_them) {
  const Room room(corner_of(0.1, 30), Vector3d(20, 0.5, 20), 20000);
  ASSERT_GT(room.doubles().echoes.size(), 1000u);
  // Without the wall among those seen there is no echo.
  std::vector<std::uint32_t> bed(900);
  std::iota(bed.begin(), bed.end(), 0);
  EXPECT_EQ(double_echoes(room.scene, bed, room.view, room.sent, {room.rays}).echoes.size(), 0u);
  // Nor behind a screen between the two, which returns nothing itself.
  SceneCloud screened = corner_of(0.1, 30);
  for (int i = 0; i < 40000; ++i)  // along the diagonal, both faces
    for (const double side : {-1.0, 1.0})
      add_surfel(screened, Vector3d(0.0075 * (i % 200) + 2e-4 * side, 0.0075 * (i / 200) - 0.25, 0.0075 * (i % 200)),
                 Vector3d(side, 0, -side).normalized(), 8e-5);
  const Room behind(std::move(screened), Vector3d(20, 0.5, 20), 20000);
  std::vector<std::uint32_t> plates(1800);
  std::iota(plates.begin(), plates.end(), 0);
  EXPECT_LT(double_echoes(behind.scene, plates, room.view, room.sent, {room.rays}).echoes.size(),
            room.doubles().echoes.size() / 50);
}

TEST_F(DoubleEchoesTest, of_a_plane_and_of_surfels_in_one_place_are_none) {
  SceneCloud plane;
  add_unit_square(plane, Vector3d::UnitX(), Vector3d::UnitY(), 60);
  const Room above(std::move(plane), Vector3d(0.5, 0.5, 2), 100000);
  EXPECT_EQ(above.doubles().rays, 0u);
  SceneCloud heap;
  for (int i = 0; i < 200; ++i)
    add_surfel(heap, Vector3d::Zero(), Vector3d(std::cos(i), std::sin(i), 0.5).normalized(), 1e-4);
  const Room beside(std::move(heap), Vector3d(2, 0, 1), 10000);
  for (const std::complex<double>& a : beside.doubles().echoes.amplitude) EXPECT_TRUE(std::isfinite(std::abs(a)));
}

// Speckle stands still: as the head moves by a millimetre, nearly all pairs keep their surfels, and their amplitudes
// turn by the phase of the longer path alone.
TEST_F(DoubleEchoesTest, of_one_pair_stay_as_the_head_moves) {
  Room room(corner_of(0.1, 40), Vector3d(20, 0.5, 20), 20000);
  room.sent.echo_options.amplitude = SurfaceAmplitude::complex_normal;
  const DoubleEchoes before = room.doubles();
  room.view.world_from_head.translation().x() += 1e-3;
  const DoubleEchoes after = room.doubles();
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::complex<double>> amplitude;
  for (std::size_t i = 0; i < after.echoes.size(); ++i)
    amplitude[{after.first[i], after.last[i]}] =
        after.echoes.amplitude[i] * std::polar(1.0, -2 * pi * pulse_900k.centre_frequency * after.echoes.delay[i]);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < before.echoes.size(); ++i) {
    const auto found = amplitude.find({before.first[i], before.last[i]});
    if (found == amplitude.end()) continue;
    const std::complex<double> was =
        before.echoes.amplitude[i] * std::polar(1.0, -2 * pi * pulse_900k.centre_frequency * before.echoes.delay[i]);
    kept += std::abs(found->second / was - 1.0) < 0.01;
  }
  ASSERT_GT(before.echoes.size(), 1000u);
  EXPECT_GT(kept, 0.95 * static_cast<double>(before.echoes.size()));
}

TEST_F(DoubleEchoesTest, do_not_depend_on_threads_and_name_their_surfels) {
  const Room room(corner_of(0.1, 60), Vector3d(20, 0.5, 20), 50000);
  const DoubleEchoes one = room.doubles(3, 1), four = room.doubles(3, 4);
  EXPECT_EQ(one.echoes.amplitude, four.echoes.amplitude);
  EXPECT_EQ(one.echoes.delay, four.echoes.delay);
  EXPECT_EQ(one.first, four.first);
  const SceneCloud& scene = room.scene.scene();
  for (std::size_t i = 0; i + 1 < one.echoes.size(); i += 2) {
    EXPECT_EQ(one.first[i], one.last[i + 1]);
    EXPECT_EQ(one.last[i], one.first[i + 1]);
    EXPECT_NE(one.first[i] < 3600, one.last[i] < 3600) << "one on the bed, one on the wall";
    const Vector3d from_head = scene.point[one.last[i]].cast<double>() - room.view.world_from_head.translation();
    EXPECT_NEAR(one.echoes.u[i], from_head.y() / from_head.norm(), 0.002);
  }
}

TEST_F(DoubleEchoesTest, have_the_patterns_of_both_legs) {
  Room room(corner_of(0.1, 20), Vector3d(20, 0.5, 0.1), 20000);
  const Echoes plain = room.doubles().echoes;
  room.sent.echo_options.elevation_width = radians(20), room.sent.echo_options.elevation_centre = radians(8);
  const Echoes formed = room.doubles().echoes;
  ASSERT_EQ(formed.size(), plain.size());
  ASSERT_GT(plain.size(), 100u);
  for (std::size_t i = 0; i + 1 < plain.size(); i += 2) {
    const auto one_way = [&](double v) { return std::sqrt(elevation_pattern(room.sent.echo_options, std::asin(v))); };
    const double expected = one_way(plain.v[i]) * one_way(plain.v[i + 1]);
    EXPECT_NEAR(std::abs(formed.amplitude[i] / plain.amplitude[i]), expected, 1e-9);
  }
}

TEST(DoubleEchoes, refuse_wrong_arguments) {
  if (!SurfaceRays::available()) GTEST_SKIP() << "built without Embree";
  const Room room(corner_of(0.1, 4), Vector3d(20, 0.5, 20), 10);
  const std::uint32_t beyond[] = {99};
  EXPECT_THAT(error_of([&] { double_echoes(room.scene, beyond, room.view, room.sent, {1}); }),
              HasSubstr("seen holds 99"));
  EXPECT_THAT(error_of([&] { double_echoes(room.scene, {}, room.view, room.sent, {0}); }),
              HasSubstr("rays_per_cell = 0"));
}
