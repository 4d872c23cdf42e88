// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/receive_array.hpp"

#include <complex>

#include "core/error.hpp"
#include "core/units.hpp"
#include "sonar/sonar_spec.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

using complex_amplitude = std::complex<double>;

constexpr double arc_wavelength = c0 / 100e3;

SonarHead arc_head(std::size_t elements, double radius, double spacing_in_wavelengths = 0.5) {
  SonarHead head;
  head.name = "arc";
  head.pulse = {100e3, 5e3, 220};
  head.fan = make_fan(5, radians(60), radians(4), radians(20));
  head.gate = {1, 20, 0.05};
  head.array = {spacing_in_wavelengths * arc_wavelength, uniform_shading(elements)};
  head.array_shape = ArrayShape::curved;
  head.array_radius = radius;
  return head;
}

// J_n(z) of any integer order.
double bessel(int n, double z) {
  const double j = std::cyl_bessel_j(std::abs(n), z);
  return n < 0 && n % 2 != 0 ? -j : j;
}

// The response of a uniform arc by the expansion of Jacobi and Anger. The difference of two directions in the plane has
// the length 2 sin(turn / 2) and points at psi:
//   B = sum_n (-i)^n J_n(k R length) exp(i n psi) sin(n N step / 2) / (N sin(n step / 2))
complex_amplitude bessel_sum(const SonarHead& head, double from, double beam) {
  const double step = head.array.spacing / head.array_radius, n_elements = static_cast<double>(head.array.elements());
  const double length = 2 * std::sin(0.5 * (from - beam)), psi = 0.5 * (from + beam) + pi / 2;
  const double z = 2 * pi / arc_wavelength * head.array_radius * std::abs(length);
  const double towards = length < 0 ? psi + pi : psi;
  const int most = static_cast<int>(z) + 60;
  complex_amplitude sum = 0;
  for (int n = -most; n <= most; ++n) {
    const double below = std::sin(0.5 * n * step);
    const double elements = std::abs(below) < 1e-9 ? std::cos(0.5 * n * n_elements * step) / std::cos(0.5 * n * step)
                                                   : std::sin(0.5 * n * n_elements * step) / (n_elements * below);
    const complex_amplitude turned = std::polar(1.0, n * (towards - pi / 2));
    sum += turned * bessel(n, z) * elements;
  }
  return sum;
}

double widest_difference(const SonarHead& head) {
  const auto array = receive_array(head);
  double most = 0;
  for (const double beam : {0.0, radians(25), radians(-70)})
    for (double from = -89; from <= 89; from += 0.7)
      most = std::max(
          most, std::abs(array->response(unit_vector({radians(from), 0}), unit_vector({beam, 0}), arc_wavelength) -
                         bessel_sum(head, radians(from), beam)));
  return most;
}

}  // namespace

TEST(CurvedArray, has_the_pattern_of_an_arc_by_bessel_sums) {
  EXPECT_LT(widest_difference(arc_head(64, 0.4)), 1e-6);
  EXPECT_LT(widest_difference(arc_head(41, 0.1, 0.7)), 1e-6);
}

TEST(CurvedArray, has_the_pattern_of_a_full_circle) {
  constexpr std::size_t elements = 61;
  const double radius = 0.5 * arc_wavelength * elements / (2 * pi);
  const SonarHead head = arc_head(elements, radius);
  require_valid(head, "test");
  const auto array = receive_array(head);
  for (double turn = 0; turn < 90; turn += 1.3) {
    // Orders beside J_0 are multiples of the number of elements.
    const double z = 4 * pi / arc_wavelength * radius * std::sin(radians(0.5 * turn));
    const complex_amplitude response =
        array->response(unit_vector({radians(turn), 0}), Eigen::Vector3d::UnitX(), arc_wavelength);
    EXPECT_NEAR(std::abs(response - std::cyl_bessel_j(0, z)), 0, 2.1 * std::cyl_bessel_j(elements, z) + 1e-9) << turn;
  }
}

TEST(CurvedArray, with_a_great_radius_is_a_line) {
  SonarHead bent = arc_head(48, 1e6), straight = bent;
  straight.array_shape = ArrayShape::line, straight.array_radius = 0;
  const auto arc = receive_array(bent), line = receive_array(straight);
  for (double u = -0.9; u < 1; u += 0.11) {
    const Eigen::Vector3d from = ahead(u, 0.1), beam = ahead(0.2, 0.1);
    EXPECT_NEAR(std::abs(arc->response(from, beam, arc_wavelength)),
                std::abs(line->response(from, beam, arc_wavelength)), 1e-6);
  }
  EXPECT_NEAR(arc->beam_width(arc_wavelength), line->beam_width(arc_wavelength), 1e-6);
  EXPECT_NEAR(arc->directivity_index_db(arc_wavelength), line->directivity_index_db(arc_wavelength), 1e-3);
  EXPECT_DOUBLE_EQ(array_gain_db(bent), array_gain_db(straight));
  EXPECT_NEAR(arc->length(), line->length(), 1e-6);
}

// The mean of |B|^2 over the sphere, by a sum. Noise at elements half a wavelength apart would be independent.
TEST(CurvedArray, has_the_directivity_of_its_pattern) {
  const SonarHead head = arc_head(24, 0.04, 0.3);
  const auto array = receive_array(head);
  constexpr int turns = 720, levels = 360;
  double mean = 0;
  for (int j = 0; j < levels; ++j)
    for (int i = 0; i < turns; ++i) {
      const double v = (2.0 * j + 1) / levels - 1, azimuth = 2 * pi * i / turns, across = std::sqrt(1 - v * v);
      const Eigen::Vector3d from{across * std::cos(azimuth), across * std::sin(azimuth), v};
      mean += std::norm(array->response(from, Eigen::Vector3d::UnitX(), arc_wavelength)) / (turns * levels);
    }
  EXPECT_NEAR(directivity_index_db(head, arc_wavelength), -db_from_power(mean), 0.01);
}

TEST(CurvedArray, is_built_for_a_beam_width) {
  SonarSpec spec = nine_beams();
  spec.array = ArrayShape::curved, spec.array_radius = 0.05;
  const SonarHead head = make_head(spec, c0);
  EXPECT_NEAR(degrees(receive_array(head)->beam_width(nominal_sound_speed / spec.centre_frequency)), 4, 0.15);
  // A bent array is shorter across than along.
  EXPECT_LT(receive_array(head)->length(), head.array.spacing * static_cast<double>(head.array.elements()));
  const auto array = receive_array(head);
  for (const Eigen::Vector3d& p : array->positions()) EXPECT_NEAR(p.norm(), 0.05, 1e-12);
}

TEST(CurvedArray, is_refused_where_it_cannot_form_beams) {
  SonarHead head = arc_head(32, 0.2);
  require_valid(head, "test");
  head.fan.azimuth.back() = radians(81);
  expect_error(ErrorKind::argument, {"within -80 and 80 for a curved array"}, [&] { require_valid(head, "test"); });
  head = arc_head(32, 0);
  expect_error(ErrorKind::argument, {"array_radius = 0 m, must be > 0 for a curved array"},
               [&] { require_valid(head, "test"); });
  head = arc_head(32, 0.03);
  expect_error(ErrorKind::argument, {"must be at most 360; use a larger array_radius"},
               [&] { require_valid(head, "test"); });
  head = arc_head(32, 0.2);
  head.fan.elevation[0] = 0.1;
  expect_error(ErrorKind::argument, {"must have one row of beams"}, [&] { require_valid(head, "test"); });
  head = arc_head(32, 0.2);
  head.array_shape = ArrayShape::line;
  expect_error(ErrorKind::argument, {"must be 0 for a line array"}, [&] { require_valid(head, "test"); });
  SonarSpec spec = nine_beams();
  spec.array_radius = 0.1;
  expect_error(ErrorKind::argument, {"array_radius_m = 0.1 m, must be left out"}, [&] { make_head(spec, c0); });
  spec.array = ArrayShape::curved, spec.array_radius = 0.004;
  expect_error(ErrorKind::argument, {"use a larger array_radius"}, [&] { make_head(spec, c0); });
}

// An arc of wide spacing hears beside its main lobe as loud as within; one of half a wavelength does not.
TEST(CurvedArray, finds_its_further_lobes) {
  EXPECT_FALSE(receive_array(arc_head(48, 1))->has_further_lobes(arc_head(48, 1).fan, arc_wavelength));
  const SonarHead wide = arc_head(24, 50, 2);
  EXPECT_TRUE(receive_array(wide)->has_further_lobes(wide.fan, arc_wavelength));
}
