// SPDX-License-Identifier: BSD-3-Clause
// Compares plates and cylinders off their broadside with Kirchhoff's integral over their surface, at one frequency and
// in time: levels, and the positions of edges and corners.
#include <random>

#include "acoustics/glints.hpp"
#include "acoustics/reflection.hpp"
#include "support/errors.hpp"
#include "support/heads.hpp"
#include "support/kirchhoff.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using complex = std::complex<double>;

constexpr double edge_frequency = 150e3, edge_wavenumber = 2 * pi * edge_frequency / 1500;
/// Length in range [m] of pulses with bandwidths of 5 and 15 kHz, 3.3 and 10 % of their frequency.
constexpr double edge_pulse = 0.5 * 1500 * 0.3748 / 5e3, short_edge_pulse = edge_pulse / 3;

/// A source of random numbers, places and turns.
struct Draws {
  std::mt19937 engine{20240};
  double within(double low, double high) {
    return low + (high - low) * static_cast<double>(engine()) / static_cast<double>(std::mt19937::max());
  }
  double log_within(double low, double high) { return low * std::pow(high / low, within(0, 1)); }
  Vector3d direction() {
    const double z = within(-1, 1), turn = within(0, 2 * pi), across = std::sqrt(1 - z * z);
    return {across * std::cos(turn), across * std::sin(turn), z};
  }
  Vector3d across(const Vector3d& axis) { return axis.cross(direction()).normalized(); }
};

Matrix3d turned(double angle, const Vector3d& axis) { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }

/// A head at a random place and attitude, and its echoes of smooth shapes that are given in its axes.
struct EdgeBench {
  Pose head = Pose::Identity();
  SceneCloud scene;
  SmoothShapes shapes;
  EchoOptions patterns;

  explicit EdgeBench(Draws& draw) {
    head.translation() = 20 * draw.direction();
    head.linear() = turned(draw.within(-3, 3), draw.direction());
    // This surfel is large enough to cover all of a body.
    scene.materials = {Material{"steel"}};
    add_surfel(scene, head * Vector3d(10, 0, 0), Vector3d(0, 0, 1), 1e4);
  }
  void add_plate(std::vector<Vector3d> corners, bool as_target, Mirror surface = {}) {
    for (Vector3d& corner : corners) corner = head * corner;
    surface = with_corners(std::move(surface), std::move(corners));
    if (as_target)
      shapes.targets.push_back({surface, 0});
    else
      shapes.mirrors.push_back(surface);
  }
  void add_cylinder(const Vector3d& middle, const Vector3d& axis, double length, double radius) {
    SmoothTarget target;
    target.surface.position = head * middle, target.axis = head.linear() * axis;
    target.length = length, target.radius = radius;
    shapes.targets.push_back(target);
  }
  /// Returns the echoes of a source of 1 Pa at 1 m.
  Echoes echoes(double frequency = edge_frequency) const {
    View view{head, make_fan(181, radians(360), radians(2), radians(180)), {0.1, 200, 1}, {}};
    view.sampling.occlusion = false;
    Pulse pulse = pulse_900k;
    pulse.centre_frequency = frequency;
    Echoes e = glint_echoes(scene, shapes, {}, false, view, {pulse, {1500, {}}, patterns});
    for (complex& amplitude : e.amplitude) amplitude /= source_pressure(pulse);
    return e;
  }
};

complex steady(const Echoes& e) {
  complex sum = 0;
  for (const complex& amplitude : e.amplitude) sum += amplitude;
  return sum;
}

complex at_range(const Echoes& e, double range, double pulse) {
  complex sum = 0;
  for (std::size_t k = 0; k < e.size(); ++k) {
    const double late = (range - 750 * e.delay[k]) / pulse;
    sum += e.amplitude[k] * std::exp(-0.5 * late * late);
  }
  return sum;
}

/// Largest error in time of one body's echo over its peak in time, by the level of the peak re broadside.
struct Worst {
  double pulse = edge_pulse;
  double within_20_db = 0, within_40_db = 0, steady_error = 0;
  int count_20 = 0, count_40 = 0;

  void add(const Echoes& e, const KirchhoffEcho& truth, double broadside) {
    double error = 0, peak = 0;
    for (double r = truth.nearest() - 3 * pulse; r < truth.farthest() + 3 * pulse; r += pulse / 4) {
      const complex expected = truth.at_range(r, pulse);
      error = std::max(error, std::abs(at_range(e, r, pulse) - expected)), peak = std::max(peak, std::abs(expected));
    }
    const double level = db_from_amplitude(peak / broadside);
    if (level > -20)
      within_20_db = std::max(within_20_db, error / peak), ++count_20;
    else if (level > -40)
      within_40_db = std::max(within_40_db, error / peak), ++count_40;
    if (level > -40) steady_error = std::max(steady_error, std::abs(steady(e) - truth.steady()) / peak);
  }
};

/// Returns a quadrilateral about `middle`, of a width and height, with its normal towards the head.
std::vector<Vector3d> plate_corners(const Vector3d& middle, const Vector3d& normal, double width, double height,
                                    double spin, double skew) {
  const Vector3d first = turned(spin, normal) * normal.unitOrthogonal(), second = normal.cross(first);
  const Vector3d a = 0.5 * width * first, b = 0.5 * height * second;
  return {middle - a - b, middle + a - b, middle + (1 - skew) * a + b, middle - (1 - 2 * skew) * a + b};
}

/// Returns a plate `size` wide at `range`, turned off the line of sight by `turn` degrees about the vertical, 20
/// degrees to port and 10 up.
std::vector<Vector3d> upright_plate(double size, double range, double turn) {
  const Vector3d sight = unit_vector({radians(20), radians(10)}), up = Vector3d::UnitZ().cross(sight).cross(-sight);
  const Vector3d normal = -(turned(radians(turn), up.normalized()) * sight);
  const Vector3d across = 0.5 * size * normal.cross(up).normalized(), along = across.cross(normal);
  const Vector3d p = range * sight;
  std::vector<Vector3d> corners = {p - across - along, p + across - along, p + across + along, p - across + along};
  if (with_corners({}, corners).normal.dot(p) > 0) std::reverse(corners.begin(), corners.end());
  return corners;
}

}  // namespace

// Closed forms: area / wavelength of a plate far off with the pattern of its width, and radius x length^2 / 2
// wavelength of a cylinder.
TEST(Kirchhoff, has_the_far_field_of_plate_and_cylinder) {
  const double range = 4000, side = 0.2, k = edge_wavenumber;
  const double area_db = db_from_amplitude(side * side * k / (2 * pi) / (range * range));
  for (const double turn : {0.0, 2.0, 5.0}) {
    const KirchhoffEcho plate = KirchhoffEcho::of_polygon(upright_plate(side, range, turn), k);
    const double x = k * side * std::sin(radians(turn));
    const double pattern = (x > 0 ? std::sin(x) / x : 1) * std::cos(radians(turn));
    EXPECT_NEAR(db_from_amplitude(std::abs(plate.steady())), area_db + db_from_amplitude(std::abs(pattern)), 0.01);
  }
  const Vector3d sight = Vector3d(1, 2, 3).normalized();
  const KirchhoffEcho side_on = KirchhoffEcho::of_cylinder(range * sight, sight.unitOrthogonal(), 0.5, 0.3, k);
  EXPECT_NEAR(db_from_amplitude(std::abs(side_on.steady()) * range * range), db_from_power(0.3 * 0.25 * k / (4 * pi)),
              0.03);
  // In time a pulse long against the plate has the steady level.
  const KirchhoffEcho plate = KirchhoffEcho::of_polygon(upright_plate(side, 30, 3), k);
  EXPECT_NEAR(std::abs(plate.at_range(30, 5) / plate.steady()), 1, 1e-3);
}

// 5 cm to 2 m, turned to 40 degrees, 3 to 30 m away; declared mirrors and targets in turn.
TEST(EdgeWaves, of_random_plates_are_kirchhoffs_integral_in_time) {
  Draws draw;
  Worst worst, short_pulse{short_edge_pulse};
  for (int n = 0; n < 200; ++n) {
    const double width = draw.log_within(0.05, 2), height = width * draw.within(0.3, 1), range = draw.log_within(3, 30);
    const double turn = radians(n % 3 == 0 ? draw.within(0, 40) : draw.log_within(0.1, 20)), skew = 0.15 * (n % 3);
    const Vector3d sight = draw.direction(), about = draw.across(sight);
    const double spin = draw.within(0, 2 * pi);
    const auto corners = [&](double angle) {
      return plate_corners(range * sight, -(turned(angle, about) * sight), width, height, spin, skew);
    };
    EdgeBench bench(draw);
    bench.add_plate(corners(turn), n % 2 == 0);
    const double broadside = std::abs(KirchhoffEcho::of_polygon(corners(0), edge_wavenumber).steady());
    for (Worst* of : {&worst, &short_pulse})
      of->add(bench.echoes(), KirchhoffEcho::of_polygon(corners(turn), edge_wavenumber), broadside);
  }
  EXPECT_LT(worst.within_20_db, 0.002);
  EXPECT_LT(worst.within_40_db, 0.003);
  EXPECT_LT(worst.steady_error, 1e-3);
  EXPECT_GT(worst.count_20, 60);
  EXPECT_GT(worst.count_40, 30);
  EXPECT_LT(short_pulse.within_20_db, 0.008);
  EXPECT_LT(short_pulse.within_40_db, 0.014);
  for (const Worst* of : {&worst, &short_pulse}) {
    const std::string bandwidth = of == &worst ? ", 3.3 %" : ", 10 %";
    RecordProperty("of the peak within 20 dB" + bandwidth, std::to_string(of->within_20_db));
    RecordProperty("of the peak within 40 dB" + bandwidth, std::to_string(of->within_40_db));
  }
}

// Radii of 5 to 30 cm, ka of 31 to 188.
TEST(EdgeWaves, of_random_cylinders_are_kirchhoffs_integral_in_time) {
  Draws draw;
  Worst worst, short_pulse{short_edge_pulse};
  for (int n = 0; n < 100; ++n) {
    const double length = draw.log_within(0.2, 1.5), radius = draw.within(0.05, 0.3), range = draw.log_within(3, 30);
    const double turn = radians(n % 3 == 0 ? draw.within(0, 40) : draw.log_within(0.1, 20));
    const Vector3d sight = draw.direction(), side_on = draw.across(sight);
    const Vector3d axis = turned(turn, sight.cross(side_on)) * side_on;
    EdgeBench bench(draw);
    bench.add_cylinder(range * sight, axis, length, radius);
    const auto truth = [&](const Vector3d& along) {
      return KirchhoffEcho::of_cylinder(range * sight, along, length, radius, edge_wavenumber);
    };
    for (Worst* of : {&worst, &short_pulse}) of->add(bench.echoes(), truth(axis), std::abs(truth(side_on).steady()));
  }
  EXPECT_LT(worst.within_20_db, 0.007);
  EXPECT_LT(worst.within_40_db, 0.01);
  EXPECT_LT(worst.steady_error, 0.01);
  EXPECT_GT(worst.count_20, 30);
  EXPECT_GT(worst.count_40, 20);
  EXPECT_LT(short_pulse.within_20_db, 0.013);
  EXPECT_LT(short_pulse.within_40_db, 0.03);
  for (const Worst* of : {&worst, &short_pulse}) {
    const std::string bandwidth = of == &worst ? ", 3.3 %" : ", 10 %";
    RecordProperty("of the peak within 20 dB" + bandwidth, std::to_string(of->within_20_db));
    RecordProperty("of the peak within 40 dB" + bandwidth, std::to_string(of->within_40_db));
  }
}

// Straight ahead of a head at 10 m, 20 cm wide, turned by 20 degrees: on the plate, not where its plane would mirror.
TEST(EdgeWaves, of_a_turned_plate_stand_on_the_plate) {
  Draws draw;
  for (const double turn : {-20.0, 20.0}) {
    EdgeBench bench(draw);
    const Vector3d normal = -(turned(radians(turn), Vector3d::UnitZ()) * Vector3d::UnitX());
    bench.add_plate(plate_corners({10, 0, 0}, normal, 0.2, 0.2, 0.3, 0), false);
    const Echoes e = bench.echoes(900e3);
    EXPECT_GE(e.size(), 4u);
    for (std::size_t k = 0; k < e.size(); ++k) {
      EXPECT_NEAR(degrees(std::asin(e.u[k])), 0, 0.82);  // a corner is 14 cm from the middle
      EXPECT_NEAR(750 * e.delay[k], 10, 0.05);
    }
  }
}

// Each echo has range and direction of a corner, of the foot of the perpendicular on an edge, or of that on the plate.
TEST(EdgeWaves, come_from_corners_and_the_nearest_places_of_edges) {
  Draws draw;
  int edges = 0, corners_heard = 0;
  for (int n = 0; n < 100; ++n) {
    const double width = draw.log_within(0.2, 2), range = draw.log_within(3, 30), turn = radians(draw.within(3, 40));
    const Vector3d sight = draw.direction(), normal = -(turned(turn, draw.across(sight)) * sight);
    const auto corners = plate_corners(range * sight, normal, width, 0.7 * width, draw.within(0, 6), 0.1);
    EdgeBench bench(draw);
    bench.add_plate(corners, false);
    std::vector<Vector3d> positions = corners;
    positions.push_back(normal.dot(corners[0]) * normal);
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3d along = (corners[(k + 1) % 4] - corners[k]).normalized();
      positions.push_back(corners[k] - along.dot(corners[k]) * along);
    }
    const Echoes e = bench.echoes(900e3);
    EXPECT_GE(e.size(), 1u);
    for (std::size_t s = 0; s < e.size(); ++s) {
      const double ahead = std::sqrt(std::max(0.0, 1 - e.u[s] * e.u[s] - e.v[s] * e.v[s]));
      std::size_t best = positions.size();
      for (std::size_t p = 0; p < positions.size(); ++p) {
        const Vector3d towards = positions[p].normalized();
        const Vector3d beam_azimuth(std::copysign(ahead, towards.x()), e.u[s], e.v[s]);
        if (std::abs(750 * e.delay[s] - positions[p].norm()) < 0.01 &&
            beam_azimuth.cross(towards).norm() < radians(0.1))
          best = p;
      }
      EXPECT_LT(best, positions.size()) << n << ": " << 750 * e.delay[s];
      edges += best > 4, corners_heard += best < 4;
    }
  }
  EXPECT_GT(edges, 10);
  EXPECT_GT(corners_heard, 100);
}

// From broadside on, through the angle at which the specular point leaves the plate: no step, and the level of the
// integral.
TEST(EdgeWaves, follow_the_integral_from_broadside_over_the_edge) {
  Draws draw;
  for (const double size : {0.07, 0.5}) {
    double before = 0;
    for (double turn = 0; turn < 4; turn += 0.02) {
      EdgeBench bench(draw);
      const auto corners = upright_plate(size, 6, turn);
      bench.add_plate(corners, true);
      const Echoes e = bench.echoes();
      const double level = std::abs(steady(e));
      const complex truth = KirchhoffEcho::of_polygon(corners, edge_wavenumber).steady();
      EXPECT_LT(std::abs(steady(e) - truth), 1e-3 * std::max(std::abs(truth), 0.01)) << size << " " << turn;
      EXPECT_LT(turn > 0 ? std::abs(level - before) : 0, 0.008) << size << " " << turn;
      before = level;
    }
  }
}

// A body of one phase is one echo, from its middle: beams weigh it as a whole.
TEST(EdgeWaves, of_a_small_plate_are_one_echo_from_its_middle) {
  Draws draw;
  EdgeBench bench(draw);
  const Vector3d sight = unit_vector({radians(-25), radians(15)});
  bench.add_plate(plate_corners(30 * sight, -sight, 0.06, 0.04, 1, 0), true);
  const Echoes e = bench.echoes();
  ASSERT_EQ(e.size(), 3u);  // the second and third are its rise with frequency, and nothing at the carrier
  EXPECT_LT(std::abs(e.amplitude[1] + e.amplitude[2]), 1e-9 * std::abs(e.amplitude[0]));
  EXPECT_NEAR(e.u[0], sight.y(), 1e-9);
  EXPECT_NEAR(e.v[0], sight.z(), 1e-9);
  EXPECT_NEAR(std::abs(e.amplitude[0]), 0.06 * 0.04 * edge_frequency / 1500 / 900, 1e-3 * 2.7e-4);
}

// Patterns of the head and the reflection of the wall hold at the position and the angle of each echo.
TEST(EdgeWaves, have_patterns_and_reflection_of_their_places) {
  Draws draw;
  EdgeBench bench(draw);
  const Vector3d middle(6, 1, 1),
      normal = -(turned(radians(30), Vector3d(0.2, 1, 0.4).normalized()) * middle.normalized());
  const auto corners = plate_corners(middle, normal, 2, 1.5, 0.4, 0.1);
  bench.add_plate(corners, false);
  const Echoes plain = bench.echoes();
  bench.patterns.elevation_width = radians(30), bench.patterns.transmit_width = radians(40);
  Echoes beam_azimuth = bench.echoes();
  ASSERT_EQ(beam_azimuth.size(), plain.size());
  ASSERT_GT(beam_azimuth.size(), 3u);
  for (std::size_t k = 0; k < beam_azimuth.size(); ++k) {
    const double up = std::asin(beam_azimuth.v[k]), aside = std::asin(beam_azimuth.u[k] / std::cos(up));
    const double pattern = std::exp2(-2 * std::pow(up / radians(30), 2) - 2 * std::pow(aside / radians(40), 2));
    EXPECT_NEAR(std::abs(beam_azimuth.amplitude[k] / plain.amplitude[k]), pattern, 1e-3 * pattern);
  }
  bench.patterns = {};
  bench.shapes = {};
  const ElasticSolid concrete{2300, 4000, 2400};
  Mirror rough;
  rough.solid = concrete, rough.rms_height = 2e-4;
  bench.add_plate(corners, false, rough);
  beam_azimuth = bench.echoes();
  ASSERT_EQ(beam_azimuth.size(), plain.size());
  for (std::size_t k = 0; k < beam_azimuth.size(); ++k) {
    const double sine = std::abs(normal.dot(corners[0])) / (750 * beam_azimuth.delay[k]);
    const complex left = coherent_reflection_loss(edge_wavenumber, 2e-4, std::asin(sine)) *
                         reflection_coefficient(concrete, sine, sea_water_density, 1500);
    EXPECT_LT(std::abs(beam_azimuth.amplitude[k] / plain.amplitude[k] - left),
              2e-3);  // two of three are 1 / k off their place
  }
}
