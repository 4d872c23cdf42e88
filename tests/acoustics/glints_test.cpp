// SPDX-License-Identifier: BSD-3-Clause
// Tests a head's own image in one and several mirrors, with edges and without, and in calibrated targets.
#include "acoustics/glints.hpp"

#include "acoustics/reflection.hpp"
#include "support/errors.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace {

using Eigen::Vector3d;
using complex = std::complex<double>;

/// A head with equal response in all directions, at `head`, in water of 1500 m/s.
struct Bench {
  SceneCloud scene;
  SmoothShapes shapes;
  Environment environment;
  bool with_levels = false;
  View view{Pose::Identity(), make_fan(181, radians(360), radians(2), radians(180)), {0.1, 1e5, 1}, {}};
  Transmission sent{pulse_900k, {1500, {}}, {}};
  GlintOptions options;

  explicit Bench(const Vector3d& head = Vector3d::Zero()) { view.world_from_head.translation() = head; }
  Echoes echoes() const { return glint_echoes(scene, shapes, environment, with_levels, view, sent, options); }
  /// Returns the sum of the echoes at an apparent range re a point 1 m away that returns all: amplitude times 1 m.
  complex at(double range) const {
    complex sum = 0;
    const Echoes e = echoes();
    for (std::size_t k = 0; k < e.size(); ++k)
      if (std::abs(750 * e.delay[k] - range) < 1e-5)
        sum += e.amplitude[k] / source_pressure(sent.pulse) *
               std::polar(1.0, -2 * pi * reduced_cycles(sent.pulse.centre_frequency * e.delay[k]));
    return sum;
  }
  double target_strength(double range) const { return db_from_amplitude(std::abs(at(range)) * range * range); }
  /// Returns the strength of all echoes together, as of one plate with its edges.
  double joint_strength(double range) const {
    complex sum = 0;
    for (const complex& amplitude : echoes().amplitude) sum += amplitude / source_pressure(sent.pulse);
    return db_from_amplitude(std::abs(sum) * range * range);
  }
};

/// Returns a mirror with these corners that faces `inside`.
Mirror facing(std::vector<Vector3d> corners, const Vector3d& inside) {
  const Mirror mirror = with_corners({}, corners);
  if (mirror.normal.dot(inside - mirror.position) > 0) return mirror;
  std::reverse(corners.begin(), corners.end());
  return with_corners({}, corners);
}

Mirror plate_before(double distance, double width, double height) {
  return with_size({"plate", {distance, 0, 0}, {-1, 0, 0}}, width, height);
}

/// Returns two plates of a x b that open towards the head at `range` before their edge, by 90 degrees and `more`.
Bench dihedral(double a, double b, double range, double frequency, double more = 0) {
  Bench bench({-range, 0, 0});
  bench.sent.pulse.centre_frequency = frequency;
  for (const double side : {-1.0, 1.0}) {
    const double angle = pi / 4 + more / 2;
    const Vector3d out = a * Vector3d(-std::cos(angle), side * std::sin(angle), 0), up(0, 0, b / 2);
    bench.shapes.mirrors.push_back(facing({-up, out - up, out + up, up}, {-range, 0, 0}));
  }
  return bench;
}

/// Returns three faces of edge a, triangles or squares, seen along their axis.
Bench trihedral(double a, bool square, double range, double frequency) {
  const Vector3d head = range * Vector3d(1, 1, 1).normalized();
  Bench bench(head);
  bench.sent.pulse.centre_frequency = frequency;
  for (int k = 0; k < 3; ++k) {
    const Vector3d u = a * Vector3d::Unit(k), v = a * Vector3d::Unit((k + 1) % 3), apex = Vector3d::Zero();
    bench.shapes.mirrors.push_back(
        facing(square ? std::vector<Vector3d>{apex, u, u + v, v} : std::vector<Vector3d>{apex, u, v}, head));
  }
  return bench;
}

}  // namespace

// R / 2d for every mirror without edges, and with its sign: an independent table of a tank, see Tank below.
TEST(Glints, of_a_wall_is_the_heads_own_image) {
  Bench b;
  b.shapes.mirrors = {{"wall", {4, 0, 0}, {-1, 0.0, 0}, {}, 0.7}};
  const Echoes e = b.echoes();
  ASSERT_EQ(e.size(), 1u);
  EXPECT_DOUBLE_EQ(e.delay[0], 8.0 / 1500);
  EXPECT_LT(std::abs(b.at(4) - 0.7 / 8), 1e-12);
  b.shapes.mirrors[0].reflection = -1;
  EXPECT_LT(std::abs(b.at(4) + 1.0 / 8), 1e-12);
  b.shapes.mirrors[0].rms_height = 1e-4;
  EXPECT_LT(std::abs(b.at(4) + coherent_reflection_loss(2 * pi * 600, 1e-4, pi / 2) / 8), 1e-12);
}

// Target strengths of a square plate of 10 cm at 900 kHz from 1 m to the far field, 20 log10(area / wavelength) =
// 15.56.
TEST(Glints, of_a_plate_are_those_of_its_edges) {
  const double rows[][2] = {{1, -3.70}, {2, -2.60}, {5, 12.76}, {10, 14.87}, {50, 15.54}};
  for (const auto& [range, db] : rows) {
    Bench b;
    b.shapes.mirrors = {plate_before(range, 0.1, 0.1)};
    EXPECT_NEAR(b.joint_strength(range), db, 0.006) << range;
  }
  Bench far;
  far.shapes.mirrors = {plate_before(2000, 0.1, 0.1)};
  EXPECT_NEAR(far.joint_strength(2000), db_from_amplitude(0.01 / wavelength_900k), 1e-3);
}

// 2 a^2 b^2 / wavelength^2, a^4 / (3 wavelength^2) and 3 a^4 / wavelength^2 of faces of 10 cm.
TEST(Glints, of_corners_are_those_of_both_orders) {
  for (const double frequency : {900e3, 400e3}) {
    const double first = db_from_amplitude(0.01 * frequency / 1500), range = 300;
    EXPECT_NEAR(dihedral(0.1, 0.1, range, frequency).target_strength(range), first + db_from_power(2), 0.1);
    EXPECT_NEAR(trihedral(0.1, false, range, frequency).target_strength(range), first - db_from_power(3), 0.1);
    EXPECT_NEAR(trihedral(0.1, true, range, frequency).target_strength(range), first + db_from_power(3), 0.1);
  }
}

TEST(Glints, of_a_dihedral_of_half_a_metre_grow_with_range) {
  const double rows[][2] = {{10, 14.76}, {50, 30.43}, {200, 38.96}, {1000, 39.47}};
  for (const auto& [range, db] : rows)
    EXPECT_NEAR(dihedral(0.5, 0.5, range, 400e3).target_strength(range), db, 0.01) << range;
}

// Each of two wide plates gives d / (2 pi h) sqrt(wavelength / 2 D) of the corner's image, with d and h from the plate
// and along it, D from the edge.
TEST(Glints, of_the_edge_between_two_plates_are_weak_beside_the_corner) {
  Bench b = dihedral(4, 4, 3, 900e3);
  const double image = std::abs(b.at(3));
  EXPECT_NEAR(image, 1 / 6.0, 0.01);
  b.options.most_bounces = 1, b.options.over_band = false;
  double edges = 0;
  const Echoes e = b.echoes();
  for (std::size_t k = 0; k < e.size(); ++k)
    if (std::abs(750 * e.delay[k] - 3) < 1e-3) edges += std::abs(e.amplitude[k]) / source_pressure(b.sent.pulse);
  EXPECT_NEAR(edges / image, 2 / (2 * pi) * std::sqrt(wavelength_900k / 6), 2e-4);
}

// From wavelength / (4 a) off the right angle the halves of a far dihedral send beside the head.
TEST(Glints, of_a_dihedral_fade_off_the_right_angle) {
  const double range = 3e4, off = 1500 / 400e3 / (4 * 0.5);
  const auto strength = [&](double more) {
    const Bench b = dihedral(0.5, 0.5, range, 400e3, more);
    complex sum = 0;
    const Echoes e = b.echoes();
    for (std::size_t k = 0; k < e.size(); ++k)
      if (std::abs(750 * e.delay[k] - range) < 1) sum += e.amplitude[k];
    return db_from_amplitude(std::abs(sum) / source_pressure(b.sent.pulse) * range * range);
  };
  // The reference is a slit of a / sqrt(2) that sends 2 `more` beside the head.
  for (const double more : {off, 2 * off, -off}) {
    const double x = pi * std::sqrt(2.0) * 0.5 * std::abs(more) * 400e3 / 1500;
    EXPECT_NEAR(strength(more) - strength(0), db_from_amplitude(std::sin(x) / x), 0.15) << more;
  }
}

TEST(Glints, of_a_tank_stand_at_their_images_with_their_levels) {
  Bench b({1.1, 1.7, 1.3});
  b.shapes.mirrors = mirrors_of(Tank{{6, 4, 3}, {0, 0, 0}, 0.7});
  const double rows[][3] = {{1.1, 0.7 / 2.2, -9.95}, {1.3, 0.7 / 2.6, -11.40}, {1.702939, 0.49 / 3.405877, -16.84}};
  for (const auto& [range, amplitude, db] : rows) {
    EXPECT_LT(std::abs(b.at(range) - amplitude), 1e-5) << range;
    EXPECT_NEAR(db_from_amplitude(std::abs(b.at(range))), db, 0.006) << range;
  }
  // Two at one range: the wall at y = 0 and the surface, of which each alone is -13.73 and -10.63 dB.
  EXPECT_LT(std::abs(b.at(1.7) - (0.7 - 1) / 3.4), 1e-9);
}

// In a box all orders of mirrors are a lattice of images: order N has (2 N + 1) (2 N^2 + 2 N + 3) / 3 of them, the head
// included. Their energy of a slice of time is that of a diffuse field, 4 pi c dt / V.
TEST(Glints, of_a_box_are_the_lattice_of_its_images) {
  const Vector3d size(6, 4, 3), head(1.1, 1.7, 1.3);
  struct Image {
    Vector3d position;
    int order;
  };
  std::vector<Image> lattice;
  const int most = 60;
  for (int i = -most; i <= most; ++i)
    for (int j = -most; j <= most; ++j)
      for (int k = -most; k <= most; ++k) {
        const int n[] = {i, j, k};
        Image image{Vector3d::Zero(), 0};
        for (int a = 0; a < 3; ++a) {
          image.position[a] = n[a] * size[a] + (n[a] % 2 == 0 ? head[a] : size[a] - head[a]);
          image.order += std::abs(n[a]);
        }
        lattice.push_back(image);
      }
  double energy = 0;
  for (const Image& image : lattice) {
    const double r = (image.position - head).norm();
    if (r > 80 && r < 160) energy += 1 / (r * r);
  }
  EXPECT_NEAR(energy, 4 * pi * 80 / size.prod(), 2e-3);

  Bench b(head);
  b.shapes.mirrors = mirrors_of(Tank{size, {0, 0, 0}, 1});
  b.shapes.mirrors.back().reflection = 1;
  const std::size_t counts[] = {7, 25, 63};
  for (int order = 1; order <= 3; ++order) {
    b.options.most_bounces = order;
    const Echoes e = b.echoes();
    EXPECT_EQ(e.size() + 1, counts[order - 1]);
    for (std::size_t k = 0; k < e.size(); ++k) {
      const double length = 1500 * e.delay[k];
      double nearest = 1;
      for (const Image& image : lattice)
        if (image.order <= order) nearest = std::min(nearest, std::abs((image.position - head).norm() - length));
      EXPECT_LT(nearest, 1e-9);
      EXPECT_NEAR(std::abs(e.amplitude[k]) * length / source_pressure(pulse_900k), 1, 1e-5) << length;
    }
  }
}

// A closed room about a head that turns, pitches and rolls: every image of the lattice that is ahead, within the fan
// and 1.5 beam widths beyond it, has the level of the head's pattern; the others, behind the head too, are absent.
TEST(Glints, of_a_room_follow_the_heads_pattern_and_are_absent_behind_it) {
  const Vector3d size(6, 4, 3), head(2.1, 1.7, 1.3);
  const double lobe = radians(50), shot = radians(70), half_fan = radians(60), beam = radians(2);
  Bench b(head);
  b.view.fan = make_fan(121, 2 * half_fan, beam, lobe);
  b.sent.echo_options.elevation_width = lobe, b.sent.echo_options.transmit_width = shot;
  b.shapes.mirrors = mirrors_of(Tank{size, {0, 0, 0}, 1});
  b.shapes.mirrors.back().reflection = 1;
  std::size_t beam_azimuth = 0, absent = 0;
  for (int step = 0; step < 36; ++step) {
    const double tilt = radians(step % 3 == 0 ? 4 : step % 3 == 1 ? 23 : -37), roll = radians(7 * (step % 5) + 1);
    const Eigen::Matrix3d turn =
        (Eigen::AngleAxisd(radians(10 * step + 3), Vector3d::UnitZ()) * Eigen::AngleAxisd(tilt, Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Vector3d::UnitX()))
            .toRotationMatrix();
    b.view.world_from_head.linear() = turn;
    const Echoes e = b.echoes();
    std::vector<std::uint8_t> found(e.size(), 0);
    for (int i = -3; i <= 3; ++i)
      for (int j = -3; j <= 3; ++j)
        for (int k = -3; k <= 3; ++k) {
          const int n[] = {i, j, k}, order = std::abs(i) + std::abs(j) + std::abs(k);
          if (order < 1 || order > 3) continue;
          // Sound that met two walls that face each other comes back from the side away from which it left.
          Vector3d image, last;
          for (int a = 0; a < 3; ++a) {
            image[a] = n[a] * size[a] + (n[a] % 2 == 0 ? 0 : size[a] - 2 * head[a]);
            last[a] = n[a] % 2 == 0 ? -image[a] : image[a];
          }
          const Vector3d out = turn.transpose() * image.normalized(), back = turn.transpose() * last.normalized();
          const double aside = std::atan2(out.y(), out.x());
          const auto up = [&](const Vector3d& leg) { return std::pow(std::asin(leg.z()) / lobe, 2); };
          const double level = std::exp2(-up(out) - up(back) - 2 * std::pow(aside / shot, 2));
          const auto in_fan = [&](const Vector3d& leg) {
            return leg.x() > 0 && std::abs(leg.y()) < std::sin(b.view.fan.azimuth.back()) + 1.5 * beam;
          };
          const bool ahead = in_fan(out) && in_fan(back);
          bool is_there = false;
          for (std::size_t s = 0; s < e.size(); ++s) {
            if (std::abs(1500 * e.delay[s] - image.norm()) > 1e-6 || std::abs(e.u[s] - back.y()) > 1e-9 ||
                std::abs(e.v[s] - back.z()) > 1e-9)
              continue;
            is_there = true, found[s] = 1;
            const double amplitude = std::abs(e.amplitude[s]) * image.norm() / source_pressure(pulse_900k);
            EXPECT_NEAR(db_from_amplitude(amplitude / level), 0, 0.1);
          }
          EXPECT_EQ(is_there, ahead && level > 1e-4) << step << ": " << out.transpose();
          ++(is_there ? beam_azimuth : absent);
        }
    EXPECT_EQ(std::count(found.begin(), found.end(), 0), 0) << step;
  }
  EXPECT_GT(beam_azimuth, 300u);
  EXPECT_GT(absent, 800u);
}

TEST(Glints, count_surface_and_bottom_with_a_mirror_only) {
  Bench b({0, 0, -3});
  b.environment.surface = SeaSurface{};
  b.shapes.mirrors = {{"wall", {4, 0, 0}, {-1, 0, 0}, {}, 1}};
  EXPECT_EQ(b.echoes().size(), 1u);
  b.with_levels = true;
  EXPECT_EQ(b.echoes().size(), 2u);
  EXPECT_LT(std::abs(b.at(5) + 0.1), 1e-9);  // by the corner: one image, of sign -1, 3 m down and 4 m ahead
}

TEST(Glints, arrive_from_the_last_mirror_and_leave_for_the_first) {
  Bench b;
  const double tilt = radians(-10);  // 80 degrees between the two
  b.shapes.mirrors = {{"a", {4, 0, 0}, {-1, 0, 0}}, {"b", {0, 5, 0}, {-std::sin(tilt), -std::cos(tilt), 0}}};
  b.options.most_bounces = 2;
  const Echoes e = b.echoes();
  ASSERT_EQ(e.size(), 4u);  // a, ab, b, ba
  EXPECT_NEAR(e.u[0], 0, 1e-12);
  EXPECT_NEAR(e.u[2], std::cos(tilt), 1e-12);
  EXPECT_DOUBLE_EQ(e.delay[1], e.delay[3]);
  EXPECT_GT(e.u[1], e.u[3]);  // the echo by a, then b arrives from b, to port
}

TEST(Glints, are_blocked_by_surfels_that_are_not_the_mirrors) {
  Bench b;
  b.shapes.mirrors = {{"wall", {4, 0, 0}, {-1, 0, 0}}};
  b.scene.materials = {{"m", 0.1}};
  for (int j = -5; j <= 5; ++j)
    for (int k = -5; k <= 5; ++k) add_surfel(b.scene, {4.01, 0.1 * j, 0.1 * k}, {-1, 0, 0}, 0.01);
  EXPECT_EQ(b.echoes().size(), 1u);
  add_surfel(b.scene, {2, 0, 0.01}, {-1, 0, 0}, 0.01);
  EXPECT_EQ(b.echoes().size(), 0u);
  b.view.sampling.occlusion = false;
  EXPECT_EQ(b.echoes().size(), 1u);
}

TEST(Glints, refuse_a_head_on_or_behind_a_mirror) {
  Bench b;
  b.shapes.mirrors = {{"quay", {0.0005, 0, 0}, {-1, 0, 0}}};
  expect_error(ErrorKind::argument, {"glint_echoes", "quay", "stands on"}, [&] { b.echoes(); });
  b.shapes.mirrors[0].normal = {1, 0, 0};
  b.shapes.mirrors[0].position = {2, 0, 0};
  expect_error(ErrorKind::argument, {"quay", "2 m behind", "must be in front of it"}, [&] { b.echoes(); });
  // A plate may be passed and may face away; in its plane, beside it, it does nothing.
  b.shapes.mirrors = {with_size({"plate", {2, 0, 0}, {1, 0, 0}}, 1, 1)};
  EXPECT_EQ(b.echoes().size(), 0u);
  b.shapes.mirrors = {with_size({"plate", {0, 2, 0}, {-1, 0, 0}}, 1, 1)};
  EXPECT_EQ(b.echoes().size(), 0u);
  b.shapes.mirrors = {with_size({"plate", {0, 0.4, 0}, {-1, 0, 0}}, 1, 1)};
  expect_error(ErrorKind::argument, {"plate", "stands on"}, [&] { b.echoes(); });
  // Nearer than the gate it is not received.
  b.shapes.mirrors = {{"quay", {0.05, 0, 0}, {-1, 0, 0}}};
  b.view.gate.min_range = 1;
  EXPECT_EQ(b.echoes().size(), 0u);
}
