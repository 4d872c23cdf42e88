// SPDX-License-Identifier: BSD-3-Clause
// Second-order laws of speckle: correlation between neighbouring beams and between neighbouring poses of the head.
#include "acoustics/direct_echoes.hpp"
#include "speckle_bench.hpp"
#include "support/test.hpp"

using namespace insonify::laws;

namespace {

constexpr double array_length = 50.5;  // 101 elements at half a wavelength [wavelengths]

double sinc(double x) { return x == 0 ? 1 : std::sin(pi * x) / (pi * x); }

/// Returns uniform reverberation: rings of patches evenly spread in the direction cosine u, each ring at its own range.
Scatterers rings(std::size_t count, std::size_t per_ring, const RangeGate& gate, std::size_t bins_apart) {
  Scatterers s;
  for (std::size_t ring = 0; ring < count; ++ring)
    for (std::size_t i = 0; i < per_ring; ++i) {
      s.id.push_back(s.range.size());
      s.range.push_back(gate.centre(ring * bins_apart));
      s.azimuth.push_back(std::asin(2 * (static_cast<double>(i) + 0.5) / static_cast<double>(per_ring) - 1));
    }
  s.elevation.assign(s.range.size(), 0);
  s.cos_incidence.assign(s.range.size(), 1);
  s.projected_area.assign(s.range.size(), 1e-4F);
  s.material.assign(s.range.size(), 0);
  s.surfel.assign(s.range.size(), 0);
  return s;
}

/// Returns a head whose three beams ahead lie apart by their null width.
SonarHead forward_head() {
  const double bandwidth = 40e3, bin = 0.44 * speed / (2 * bandwidth);
  return head_with(one_degree_array(), {std::asin(-2.0 / 101), 0, std::asin(2.0 / 101)}, bandwidth, {7.3, 8.7, bin});
}

/// Returns the pressure of a flat bottom at a head at `world_from_head`, one image per seed. The patches are the same
/// for all poses.
std::vector<ComplexGrid> bottom_echoes_at(const Pose& world_from_head) {
  const SceneCloud scene = flat_bottom();
  const SonarHead head = forward_head();
  const Scatterers s = visible(scene, head, world_from_head);
  std::vector<ComplexGrid> images;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    images.push_back(synthesize_gridded(direct_echoes(s, scene.materials, head.pulse, clear_water(), {.seed = seed}),
                                        head, clear_water()));
  return images;
}

/// Returns the correlation of the speckle ahead of a head at rest with that of one `sideways` [m] to port and turned: 3
/// beams, 56 bins and 10 seeds are 1700 looks. Removes the phase 2 k d u_b by which a beam's patches turn together. The
/// phase of the longer path, - k d^2 / r, and that of the beam's footprint, which moves along by d, cancel.
Complex correlation_with(const Pose& world_from_head, double sideways) {
  static const std::vector<ComplexGrid> at_rest = bottom_echoes_at(Pose::Identity());
  const std::vector<ComplexGrid> elsewhere = bottom_echoes_at(world_from_head);
  const SonarHead head = forward_head();
  const double k = 2 * pi / wavelength;
  Correlation correlation;
  for (std::size_t seed = 0; seed < at_rest.size(); ++seed)
    for (Eigen::Index b = 0; b < at_rest[0].rows(); ++b)
      for (Eigen::Index n = 0; n < at_rest[0].cols(); n += 3) {
        const double u = std::sin(head.fan.azimuth[static_cast<std::size_t>(b)]);
        correlation.add(at_rest[seed](b, n) * std::polar(1.0, -2 * k * sideways * u), elsewhere[seed](b, n));
      }
  return correlation.value();
}

Pose moved(double sideways, double yaw_deg = 0) {
  return pose_from_yaw_pitch_roll({0, sideways, 0}, radians(yaw_deg), 0, 0);
}

}  // namespace

// Van Cittert and Zernike: beams of a uniform array, length L, that look at even reverberation are correlated by
// sinc(L du / lambda): 0.959, 0.709 and 0.131 at 0.18, 0.5 and 1 degree for the 50.5 wavelengths here (0.9587, 0.7071
// and 0.126 for a beam of exactly one degree, 50.76). A correlation r over n looks has the error (1 - r^2) / sqrt(n).
TEST(SpeckleLaws, beams_are_correlated_by_the_sinc_of_their_distance) {
  const double spacings[] = {0.18, 0.5, 1.0, degrees(std::asin(2.0 / 101))};
  std::vector<double> azimuths{0};
  for (const double d : spacings) azimuths.push_back(radians(d));
  const double bandwidth = 100e3, bin = 0.44 * speed / (2 * bandwidth);
  const std::size_t count = 100, bins_apart = 4;
  const SonarHead head = head_with(one_degree_array(), azimuths, bandwidth, {10, 10 + 400 * bin, bin});
  const Scatterers s = rings(count, 600, head.gate, bins_apart);
  const std::vector<Material> materials{{"patch", 1.0}};
  Correlation with_first[4];
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const ComplexGrid p =
        synthesize_gridded(direct_echoes(s, materials, head.pulse, clear_water(), {.seed = seed}), head, clear_water());
    for (std::size_t ring = 0; ring < count; ++ring)
      for (Eigen::Index b = 0; b < 4; ++b) {
        const auto n = static_cast<Eigen::Index>(ring * bins_apart);
        with_first[b].add(p(0, n), p(b + 1, n));
      }
  }
  const double looks = 2000;
  for (int b = 0; b < 4; ++b) {
    const double expected = sinc(array_length * std::sin(radians(spacings[b])));
    EXPECT_LT(std::abs(with_first[b].value() - expected), 3 * (1 - expected * expected) / std::sqrt(looks) + 1e-3)
        << spacings[b] << " degrees apart: " << with_first[b].value();
  }
}

// A head that moves sideways by d turns the phase of a patch at u by 2 k d u. With the beam's power B^2(u), whose
// transform is the triangle of the aperture with itself, that leaves the correlation 1 - 2 d / L: none beyond half the
// array. Error: 0.024 of the looks, 0.02 of the finite number of patches per cell; 0.06 is twice both.
TEST(SpeckleLaws, correlation_falls_in_a_straight_line_with_sideways_displacement) {
  const double length = array_length * wavelength;
  for (const double part : {0.0, 0.1, 0.25, 0.4, 0.5, 0.7}) {
    const double sideways = part * length, expected = std::max(0.0, 1 - 2 * part);
    const Complex measured = correlation_with(moved(sideways), sideways);
    EXPECT_LT(std::abs(measured - expected), part == 0 ? 1e-9 : 0.06)
        << "moved by " << part << " of the array: " << measured;
  }
}

// A turn by the angle a moves a patch at elevation e by cos(e) a in u. At 8 m and 3 m below, cos(e) = 0.927.
TEST(SpeckleLaws, speckle_decorrelates_when_the_head_turns_by_a_beam) {
  for (const double turn_deg : {0.25, 0.5, 1.0, 3.0}) {
    const double expected = sinc(array_length * 0.927 * std::sin(radians(turn_deg)));
    const Complex measured = correlation_with(moved(0, turn_deg), 0);
    EXPECT_LT(std::abs(measured - expected), 0.06) << "turned by " << turn_deg << " degrees: " << measured;
  }
  EXPECT_LT(std::abs(correlation_with(moved(0, 1.2), 0)), 0.1);  // the beam's null width
}
