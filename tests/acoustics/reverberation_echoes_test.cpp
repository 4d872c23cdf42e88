// SPDX-License-Identifier: BSD-3-Clause
// Compares mean levels of the reverberation of water, surface and bottom with closed forms.
#include "acoustics/direct_echoes.hpp"
#include "acoustics/reverberation_bench.hpp"
#include "acoustics/reverberation_cells_internal.hpp"
#include "sampling/find_scatterers.hpp"
#include "scene/built_in_scenes.hpp"

namespace insonify::reverberation_tests {

/// Returns the sample at `range` of a uniform line steered ahead: the plain sum, with the whole pulse_900k.
std::complex<double> beam_ahead(const Echoes& e, double range) {
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double t = 2 * range / 1500 - e.delay[i];
    if (std::abs(t) > 1.5 / pulse_900k.bandwidth) continue;
    const double x = pi * array_length / wavelength_900k * e.u[i];
    const double pattern = std::abs(x) < 1e-9 ? 1 : std::sin(x) / x;
    sum += e.amplitude[i] * pattern * echo_envelope(pulse_900k, medium.absorption, 750 * e.delay[i]).at(t);
  }
  return sum;
}

struct Looks {
  double power = 0, square = 0;
  int count = 0;
  void add(std::complex<double> p) {
    power += std::norm(p);
    square += std::norm(p) * std::norm(p);
    ++count;
  }
  double level_db() const { return pressure_level_db(std::sqrt(power / count)); }
  double contrast() const { return square * count / (power * power); }  // 2: exponential intensity, Rayleigh amplitude
};

/// Collects `looks` independent pings at ranges within half a metre of `range`, 4 cm apart, more than the pulse_900k
/// length.
template <typename Hear>
Looks listen(Hear&& receive, double range, int pings) {
  Looks looks;
  for (int p = 0; p < pings; ++p) {
    const Echoes e = receive(RangeGate{range - 0.4, range + 0.4, 0.01}, p);
    for (int k = -10; k <= 10; ++k) looks.add(beam_ahead(e, range + 0.04 * k));
  }
  return looks;
}

// RL = SL - 40 log r - 2 a r + Sv + 10 log V, V = (lambda / L) integral b_E^2 de  r^2 c tau_e / 2: over a line beam
// ahead, cos(e) dtheta de = du de, so that the cosine cancels.
TEST(VolumeEchoes, has_the_level_of_the_sonar_equation) {
  const double width = radians(20), range = 10;
  const auto receive = [&](const RangeGate& gate, int ping) {
    return volume_echoes(environment(), fan_of(40), gate, transmission(1, width), {.ping = ping});
  };
  const Looks looks = listen(receive, range, 150);
  const double over_elevation = 0.5 * width * std::sqrt(pi / std::numbers::ln2);
  const double volume = wavelength_900k / array_length * over_elevation * range * range * slice;
  const double expected = 220 - 40 * std::log10(range) - 2 * 0.2994626 * range - 70 + db_from_power(volume);
  EXPECT_NEAR(looks.level_db(), expected, 0.3);  // 3150 looks: sd 0.08 dB
  EXPECT_NEAR(looks.contrast(), 2, 0.2);
}

// The energy of every beam of a uniform line, summed over ranges from 3 to 11 m with their squares: 2 p0^2 Sv (R2 - R1)
// integral B^2(u - u_b) b_E^2(e) cos(e) de dtheta, by quadrature. All directions ahead, mean power: what is left is the
// random places of the cells.
TEST(VolumeEchoes, of_all_beams_have_the_closed_form_to_0_02_db) {
  const BeamFan fan = fan_of(120);
  Transmission sent = transmission(1, radians(20));
  sent.echo_options.amplitude = SurfaceAmplitude::mean_power;
  const Echoes cells = volume_echoes(environment(), fan, {2, 12, 0.01}, sent, {.azimuth_margin = pi});
  const auto pattern = [](double du) {
    const double x = pi * array_length / wavelength_900k * du;
    return std::abs(x) < 1e-9 ? 1 : std::sin(x) / x;
  };
  double sum = 0, closed_sum = 0;
  for (std::size_t b = 0; b < fan.beams(); b += 7) {
    const double u_beam = std::sin(fan.azimuth[b]);
    double energy = 0, directions = 0;
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (const double r = 750 * cells.delay[i]; r >= 3 && r <= 11)
        energy += std::norm(cells.amplitude[i] * r * pattern(cells.u[i] - u_beam));
    constexpr int azimuths = 4000, elevations = 80;
    for (int k = 0; k < azimuths; ++k)
      for (int j = 0; j < elevations; ++j) {
        const double azimuth = pi * ((k + 0.5) / azimuths - 0.5), e = radians(80) * ((j + 0.5) / elevations - 0.5);
        directions += std::exp2(-std::pow(2 * e / radians(20), 2)) * std::cos(e) *
                      std::pow(pattern(std::cos(e) * std::sin(azimuth) - u_beam), 2);
      }
    directions *= pi / azimuths * radians(80) / elevations;
    const double closed = std::pow(source_pressure(pulse_900k), 2) * power_from_db(-70) * 8 * directions;
    EXPECT_NEAR(db_from_power(energy / closed), 0, 0.1) << b;
    sum += energy, closed_sum += closed;
  }
  EXPECT_NEAR(db_from_power(sum / closed_sum), 0, 0.02);
}

// Larger cells, same mean: the level must not depend on the division of the water into cells.
TEST(VolumeEchoes, level_does_not_depend_on_the_cells) {
  double power[2] = {0, 0};
  for (const int fine : {0, 1}) {
    const Echoes e = volume_echoes(environment(), fan_of(40), {9, 11, 0.01}, transmission(1, radians(20)),
                                   {.cells_per_resolution = fine ? 4.0 : 1.0});
    for (std::size_t i = 0; i < e.size(); ++i)
      if (std::abs(750 * e.delay[i] - 10) < 0.9) power[fine] += std::norm(e.amplitude[i]);
  }
  EXPECT_NEAR(power[1] / power[0], 1, 0.04);  // 6600 exponential intensities in the coarse sum: sd 0.012
}

TEST(VolumeEchoes, rows_share_a_cells_volume) {
  BeamFan planar = fan_of(40);
  planar.row_width = radians(2);
  const Echoes one = volume_echoes(environment(), fan_of(40), {9, 11, 0.01}, transmission(1, radians(20)));
  const Echoes rows = volume_echoes(environment(), planar, {9, 11, 0.01}, transmission(1, radians(20)));
  EXPECT_GT(rows.size(), 20 * one.size());
  const auto power = [](const Echoes& e) {
    double sum = 0;
    for (const auto& a : e.amplitude) sum += std::norm(a);
    return sum;
  };
  EXPECT_NEAR(power(rows) / power(one), 1, 0.04);
}

TEST(VolumeEchoes, applies_the_transmit_pattern_in_azimuth) {
  const auto receive = [](double transmit_width) {
    Transmission sent = transmission(1, radians(20));
    sent.echo_options.transmit_width = transmit_width;
    return volume_echoes(environment(), fan_of(40), {9, 9.2, 0.01}, sent);
  };
  const Echoes even = receive(0), shaped = receive(radians(30));
  ASSERT_EQ(shaped.size(), even.size());
  for (std::size_t i = 0; i < even.size(); ++i) {
    const double azimuth = std::asin(even.u[i] / std::sqrt(1 - even.v[i] * even.v[i]));
    const double expected = gaussian_lobe(radians(30), azimuth);
    EXPECT_NEAR(std::abs(shaped.amplitude[i] / even.amplitude[i]), expected, 1e-9 * expected) << degrees(azimuth);
  }
}

TEST(ElevationLaw, integral_is_the_closed_form_of_a_gaussian) {
  // integral of 2^(-(2x/w)^2) cos(c + x) dx = cos(c) sqrt(pi / (4 ln2)) w exp(-w^2 / (16 ln2))
  for (const double centre : {0.0, 0.3}) {
    const double w = radians(20), ln2 = std::numbers::ln2;
    const ElevationLaw law(fan_of(40), {.elevation_width = w, .elevation_centre = centre});
    // The law holds the intensity of the two-way response: its -3 dB width is w.
    const double expected = std::cos(centre) * std::sqrt(pi / (4 * ln2)) * w * std::exp(-w * w / (16 * ln2));
    EXPECT_NEAR(law.integral() / expected, 1, 1e-5);
  }
  const ElevationLaw sector(fan_of(40), {.elevation_shape = ElevationShape::sector, .elevation_width = 0.5});
  EXPECT_NEAR(sector.integral(), 2 * std::sin(0.25), 1e-4);
}

TEST(ElevationLaw, draws_equal_parts) {
  const ElevationLaw law(fan_of(40), {.elevation_width = radians(20)});
  EXPECT_NEAR(law.elevation_at(0.5), 0, 1e-6);
  // A normal law of variance w^2 / (8 ln2): 84.134 % lie below one sd (cos(e) narrows it a little).
  EXPECT_NEAR(law.elevation_at(0.84134), radians(20) / std::sqrt(8 * std::numbers::ln2), 0.002);
  double before = law.elevation_at(0);
  for (double q = 0.001; q <= 1; q += 0.001) {
    EXPECT_GE(law.elevation_at(q), before);
    before = law.elevation_at(q);
  }
}

// RL = SL - 40 log r - 2 a r + 10 log mu + 20 log(h / r) + 10 log[(lambda / L) r^2 / sqrt(r^2 - h^2) c tau_e / 2] of a
// flat bottom 3 m below; the same to 0.01 dB as an independent evaluation: 129.28, 110.47 and 89.28 dB.
TEST(BottomEchoes, has_the_level_of_the_closed_form) {
  const double h = 3, recorded[][2] = {{5, 129.28}, {10, 110.47}, {20, 89.28}};
  for (const auto& [range, level] : recorded) {
    const double area = wavelength_900k / array_length * range * range / std::sqrt(range * range - h * h) * slice;
    const double closed =
        220 - 40 * std::log10(range) - 2 * 0.2994626 * range - 27 + 20 * std::log10(h / range) + db_from_power(area);
    EXPECT_NEAR(closed, level, 0.03);  // recorded for 1489.8 m/s, here 1500
    const auto receive = [&](const RangeGate& gate, int ping) {
      return bottom_echoes(environment(), at(0, 0, -7), fan_of(40), gate, transmission(1 + ping));
    };
    const Looks looks = listen(receive, range, 80);
    EXPECT_NEAR(looks.level_db(), closed, 0.4)
        << range;  // 1680 looks: sd 0.1 dB, and a slope of 10 dB per metre at 5 m
    EXPECT_NEAR(looks.contrast(), 2, 0.3) << range;
  }
}

// A turned head over the same plane as surfels: elevation and transmit pattern, direction and incidence all agree, ring
// by ring.
TEST(BottomEchoes, is_what_a_plane_of_surfels_gives) {
  SceneCloud plane = make_built_in_scene("plane", {.points = 150000, .size = {40, 40}});
  Environment e = environment();
  e.bottom->height = 0;
  e.surface.reset();
  e.bottom->lambert_mu = plane.materials[0].lambert_mu;
  const Pose pose = at(2, 0, 3, 5, 12, 15);
  const RangeGate gate{4, 14, 0.01};
  Transmission sent = transmission(1, radians(20));
  sent.echo_options.transmit_width = radians(40);
  const Echoes cells = bottom_echoes(e, pose, fan_of(60), gate, sent);

  sent.echo_options.amplitude = SurfaceAmplitude::coherent;
  const SamplingOptions sampling{.scatterers_per_cell = 0, .elevation_half_extent = pi / 2, .occlusion = false};
  const Scatterers s = find_scatterers(plane, pose, fan_of(60), gate, sampling).scatterers;
  const Echoes surfels = direct_echoes(s, plane.materials, pulse_900k, medium, sent.echo_options);
  const auto moments = [](const Echoes& x, double from, double to) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < x.size(); ++i)
      if (750 * x.delay[i] >= from && 750 * x.delay[i] < to)
        sum += std::norm(x.amplitude[i]) * Eigen::Vector3d(1, x.u[i], x.v[i]);
    return sum;
  };
  for (const auto& [from, to] : {std::pair(5.0, 7.0), std::pair(7.0, 10.0), std::pair(10.0, 13.0)}) {
    const Eigen::Vector3d a = moments(cells, from, to), b = moments(surfels, from, to);
    EXPECT_NEAR(db_from_power(a[0] / b[0]), 0, 0.25) << from;
    EXPECT_NEAR(a[1] / a[0], b[1] / b[0], 0.01) << from;
    EXPECT_NEAR(a[2] / a[0], b[2] / b[0], 0.01) << from;
  }
}

// Directly below the head a range slice begins at the nadir: no area is lost there.
TEST(BottomEchoes, counts_the_whole_disc_under_the_head) {
  const Pose down = at(0, 0, -7, 0, 90);
  BeamFan round = make_fan(360, 2 * pi, beam_width, radians(60));
  const Echoes e = bottom_echoes(environment(), down, round, {2.5, 3.05, 0.01}, transmission());
  double area = 0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double r = 750 * e.delay[i], sine = 3 / r;
    if (r < 3.05)
      area += std::norm(e.amplitude[i] * r * r / source_pressure(pulse_900k)) / (power_from_db(-27) * sine * sine);
  }
  EXPECT_NEAR(area / (pi * (3.05 * 3.05 - 9)), 1, 0.1);  // about 13 000 exponential intensities of unequal size
}

TEST(SurfaceEchoes, has_the_level_of_its_strength) {
  const double d = 2, range = 10;
  const auto receive = [&](const RangeGate& gate, int ping) {
    return surface_echoes(environment(), at(0, 0, -d), fan_of(40), gate, transmission(), {.ping = ping});
  };
  const Looks looks = listen(receive, range, 80);
  const double area = wavelength_900k / array_length * range * range / std::sqrt(range * range - d * d) * slice;
  const double closed = 220 - 40 * std::log10(range) - 2 * 0.2994626 * range - 30 + db_from_power(area);
  EXPECT_NEAR(looks.level_db(), closed, 0.4);
  const Echoes e = receive({9, 11, 0.01}, 0);
  for (std::size_t i = 0; i < e.size(); ++i) ASSERT_NEAR(e.v[i], d / (750 * e.delay[i]), 1e-12);  // from above
}

}  // namespace insonify::reverberation_tests
