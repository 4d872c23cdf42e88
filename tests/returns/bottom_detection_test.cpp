// SPDX-License-Identifier: BSD-3-Clause
#include "returns/bottom_detection.hpp"

#include "acoustics/refract_paths.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "returns/bottom_fits_internal.hpp"
#include "support/test.hpp"

using testing::HasSubstr;

namespace {

/// Returns a silent ping of `beams` beams that look straight down.
Ping silent_swath(std::size_t beams, double fov_deg = 60, double max_range = 12, double bin = 0.01) {
  Ping ping;
  ping.fan = make_fan(beams, radians(fov_deg), radians(1), radians(1));
  ping.gate = {2, max_range, bin};
  ping.world_from_head = pose_from_yaw_pitch_roll({100, 50, -1}, 0, pi / 2, 0);
  ping.pressure = ComplexGridF::Zero(static_cast<Eigen::Index>(beams), static_cast<Eigen::Index>(ping.gate.bins()));
  return ping;
}

/// Adds a Gaussian echo of this intensity width [m].
void add_echo(Ping& ping, std::size_t beam, double range, double amplitude, double width) {
  for (std::size_t n = 0; n < ping.gate.bins(); ++n) {
    const double x = (ping.gate.centre(n) - range) / width;
    ping.pressure(static_cast<Eigen::Index>(beam), static_cast<Eigen::Index>(n)) +=
        static_cast<float>(amplitude * std::exp(-2 * std::log(2.0) * x * x));
  }
}

void add_white_noise(Ping& ping, std::uint64_t number) {
  for (Eigen::Index b = 0; b < ping.pressure.rows(); ++b)
    for (Eigen::Index n = 0; n < ping.pressure.cols(); ++n)
      ping.pressure(b, n) += std::complex<float>(random_complex_normal(
          3, RandomStage::noise, {number, static_cast<std::uint64_t>(b), static_cast<std::uint64_t>(n)}));
}

}  // namespace

TEST(DetectBottom, finds_a_short_echo_between_bins) {
  Ping ping = silent_swath(3);
  for (std::size_t b = 0; b < 3; ++b) add_echo(ping, b, 7.0034, 0.5, 0.03);
  const BottomSoundings found = detect_bottom(ping, {.range_resolution = 0.03});
  ASSERT_EQ(found.size(), 3U);
  // The range to a level bottom grows over beams of 1 x 1 degrees by half the range times the variances of their
  // patterns. (E132)
  const double lengthening = 0.5 * 7 * 2 * std::pow(radians(1) / 2.3548, 2);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(found.beam[i], i);
    EXPECT_EQ(found.reject[i], 0);
    EXPECT_EQ(found.method[i], BottomMethod::amplitude);
    EXPECT_NEAR(found.range[i], 7.0034 - lengthening, 2e-4);
    EXPECT_NEAR(static_cast<double>(found.quality[i]),
                std::log10(found.range[i] / static_cast<double>(found.deviation[i])), 1e-5);
    EXPECT_NEAR(static_cast<double>(found.level_db[i]), 20 * std::log10(0.5 / std::sqrt(2.0) / 1e-6), 0.1);
    // Straight down at 7 m: the world's x axis is ahead, port is +y.
    const double azimuth = ping.fan.azimuth[i];
    const Eigen::Vector3d expected(100, 50 + found.range[i] * std::sin(azimuth),
                                   -1 - found.range[i] * std::cos(azimuth));
    EXPECT_LT((found.position[i] - expected).norm(), 1e-9);
  }
}

// Noise alone: the strongest of all cells of a beam exceeds the threshold with the stated probability, which holds for
// any level of the noise since it is estimated from the same beam.
TEST(DetectBottom, false_alarms_of_open_water_come_at_the_stated_rate) {
  for (const double rate : {1e-1, 1e-2, 1e-3}) {
    const std::size_t beams = 128;
    const int pings = rate < 5e-3 ? 120 : 30;
    double count = 0;
    for (int p = 0; p < pings; ++p) {
      Ping ping = silent_swath(beams, 60, 5, 0.01);
      add_white_noise(ping, static_cast<std::uint64_t>(p));
      count += static_cast<double>(
          detect_bottom(ping, {.range_resolution = 0.01, .false_alarm_rate = rate, .side_lobe_margin_db = 1000})
              .size());
    }
    const double expected = rate * beams * pings;
    EXPECT_NEAR(count, expected, 3 * std::sqrt(expected) + 0.1 * expected) << rate;
  }
}

TEST(DetectBottom, gives_several_soundings_of_a_beam_on_request) {
  Ping ping = silent_swath(1, 1);
  add_echo(ping, 0, 4, 0.3, 0.03);
  add_echo(ping, 0, 9, 0.5, 0.03);
  add_echo(ping, 0, 6, 1e-4, 0.03);
  EXPECT_NEAR(detect_bottom(ping, {.range_resolution = 0.03}).range.at(0), 9, 1e-3);
  const BottomSoundings both = detect_bottom(ping, {.range_resolution = 0.03, .per_beam = 3});
  ASSERT_EQ(both.size(), 2U);  // the third is too weak
  EXPECT_NEAR(both.range[1], 4, 1e-3);
}

// Both sides of an echo that is longer than the footprint of a level bottom lead to its middle: one sounding.
TEST(DetectBottom, gives_an_echo_once) {
  Ping ping = silent_swath(64, 10);
  std::size_t several = 0;
  for (std::size_t b = 0; b < 64; ++b) {
    for (std::size_t n = 0; n < ping.gate.bins(); ++n)
      ping.pressure(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(n)) =
          std::complex<float>(random_complex_normal(9, RandomStage::noise, {0, b, n}) *
                              std::exp(-0.5 * std::pow((ping.gate.centre(n) - 7) / 0.05, 2)));
    add_echo(ping, b, 9, 0.5, 0.03);
  }
  const BottomSoundings all = detect_bottom(ping, {.range_resolution = 0.03, .per_beam = 5});
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all.beam[i] != all.beam[i - 1]) continue;
    ++several;
    for (std::size_t j = i; j > 0 && all.beam[j - 1] == all.beam[i]; --j)
      EXPECT_GE(std::abs(all.range[i] - all.range[j - 1]), ping.gate.bin_size) << all.beam[i];
  }
  EXPECT_GE(several, 64U) << "two echoes of each beam";
}

// The phase of the echo of a plane that is seen at 7 degrees, whose strongest part is nearer than the beam's axis: a
// line fitted to it would cross zero 4 to 8 mm beyond, as the ranges bend. The echo is 1 degree long along the way.
TEST(DetectBottom, takes_the_zero_of_the_phase_where_the_echo_is_long) {
  Ping ping = silent_swath(7, 7, 20);
  ping.world_from_head = pose_from_yaw_pitch_roll({0, 0, 0}, 0, radians(30), 0);
  ping.split_phase = Grid<float>::Zero(7, ping.pressure.cols());
  const double tilt = std::atan(60 / 8.5), distance = 8.5 * std::cos(tilt);  // dr/du is 60 m at 8.5 m
  const auto range_at = [&](double azimuth) { return distance / std::cos(azimuth + tilt); };
  for (std::size_t b = 0; b < 7; ++b) {
    const double axis = range_at(ping.fan.azimuth[b]), sine = std::sin(ping.fan.azimuth[b]);
    for (std::size_t n = 0; n < ping.gate.bins(); ++n) {
      const double range = ping.gate.centre(n);
      const auto xi = random_complex_normal(5, RandomStage::noise, {0, b, n});
      ping.pressure(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(n)) =
          std::complex<float>(xi * std::exp(-0.5 * std::pow((range - axis + 0.05) / 0.4, 2)));
      ping.split_phase(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(n)) = static_cast<float>(
          std::remainder(120 * (std::sin(std::acos(std::min(1.0, distance / range)) - tilt) - sine), 2 * pi));
    }
  }
  const BottomSoundings by_phase = detect_bottom(ping, {.centre_frequency = 4e5, .range_resolution = 0.01});
  ASSERT_EQ(by_phase.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(by_phase.method[i], BottomMethod::phase);
    EXPECT_NEAR(by_phase.range[i], range_at(ping.fan.azimuth[i]), 1e-3);
  }
  const BottomSoundings by_amplitude = detect_bottom(ping, {.range_resolution = 0.01, .phase = false});
  double mean = 0;
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(by_amplitude.method[i], BottomMethod::amplitude);
    mean += (by_amplitude.range[i] - by_phase.range[i]) / 7;
  }
  EXPECT_LT(mean, -0.01);
}

namespace {

/// Returns beams of 1 degree on a bottom of slope dr/du = 6 m: speckle of 2 cm in footprints of 10 cm, so that an echo
/// has five independent samples at most. The phase turns by `turn` per direction cosine.
Ping short_echoes(double turn, std::uint64_t number) {
  constexpr Eigen::Index beams = 21;
  constexpr double slope = 6, pulse = 0.02 / 2.3548, footprint = slope * 0.01745 / 2.3548;
  Ping ping = silent_swath(beams, 20);
  ping.split_phase = Grid<float>::Zero(beams, ping.pressure.cols());
  ComplexGrid port = ComplexGrid::Zero(beams, ping.pressure.cols()), starboard = port;
  for (Eigen::Index b = 0; b < beams; ++b) {
    const double axis = 8.5 + slope * std::sin(ping.fan.azimuth[static_cast<std::size_t>(b)]);
    for (int i = 0; i < 400; ++i) {
      const double off = (i - 200) * 0.001;
      const auto xi = random_complex_normal(5, RandomStage::noise,
                                            {number, static_cast<std::uint64_t>(b), static_cast<std::uint64_t>(i)}) *
                      std::exp(-0.25 * std::pow(off / footprint, 2));
      for (std::size_t n = 0; n < ping.gate.bins(); ++n) {
        const double x = ping.gate.centre(n) - axis - off;
        if (std::abs(x) > 5 * pulse) continue;
        const auto at = static_cast<Eigen::Index>(n);
        const std::complex<double> echo = xi * std::exp(-0.25 * std::pow(x / pulse, 2));
        ping.pressure(b, at) += std::complex<float>(echo);
        port(b, at) += echo * std::polar(1.0, -0.5 * turn * off / slope);
        starboard(b, at) += echo * std::polar(1.0, 0.5 * turn * off / slope);
      }
    }
  }
  ping.split_phase = (starboard * port.conjugate()).arg().cast<float>();
  return ping;
}

}  // namespace

// The echo has too few samples to show the slope of its phase: the other beams give it, of either sign.
TEST(DetectBottom, takes_the_zero_of_the_phase_of_short_echoes) {
  for (const double turn : {180.0, -180.0}) {
    double by_phase = 0, by_amplitude = 0, predicted = 0, count = 0;
    for (std::uint64_t number = 0; number < 4; ++number) {
      const Ping ping = short_echoes(turn, number);
      const BottomSoundings a = detect_bottom(ping, {.range_resolution = 0.02, .phase = false});
      const BottomSoundings p = detect_bottom(ping, {.centre_frequency = 4e5, .range_resolution = 0.02});
      ASSERT_EQ(p.size(), 21U);
      for (std::size_t i = 0; i < 21; ++i) {
        EXPECT_EQ(p.method[i], BottomMethod::phase);
        const double truth = 8.5 + 6 * std::sin(ping.fan.azimuth[i]);
        by_phase += std::pow(p.range[i] - truth, 2), by_amplitude += std::pow(a.range[i] - truth, 2);
        predicted += std::pow(static_cast<double>(p.deviation[i]), 2), count += 1;
      }
    }
    EXPECT_LT(std::sqrt(by_phase / count), 0.0035) << turn;
    EXPECT_GT(std::sqrt(by_amplitude / count), 0.008) << turn;
    EXPECT_LT(std::sqrt(by_phase / predicted), 1.3) << turn;
    EXPECT_GT(std::sqrt(by_phase / predicted), 0.5) << turn;
  }
}

// A sounding at the apparent position of a target stands where the target is: refract_paths puts it there.
TEST(DetectBottom, unbends_the_ray_of_a_profile) {
  const SoundSpeedProfile profile{{0, 5, 12, 30}, {1520, 1505, 1480, 1478}};
  const double head_depth = 1, c = sound_speed_at(profile, head_depth);
  Ping ping = silent_swath(5, 100, 30);
  for (std::size_t b = 0; b < 5; ++b) {
    const Eigen::Vector3d target(100, 50 + 10 * std::tan(ping.fan.azimuth[b]) + 0.3, -15);
    const double across = target.y() - 50;
    const Eigenray ray = find_eigenray(profile, head_depth, head_depth + 14, std::abs(across));
    ping.fan.azimuth[b] = std::copysign(pi / 2 + ray.elevation, across);
    add_echo(ping, b, c * ray.travel_time, 0.5, 0.03);
    const BottomSoundings found =
        detect_bottom(ping, {.sound_speed = c, .range_resolution = 0.03, .profile = profile, .head_depth = head_depth});
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found.beam[i] == b) {
        EXPECT_LT((found.position[i] - target).norm(), 2e-3) << b;
      }
  }
}

// Beams beside the bed hold the errors of the synthesis: any echo is far above them, but below the noise of a receiver.
// With the floor of that noise they have no sounding, and those of the bed stay.
TEST(DetectBottom, takes_nothing_below_the_noise_of_the_receiver_for_the_bed) {
  constexpr std::size_t beams = 24, of_bed = 8;
  const Pulse pulse{4e5, 2.5e4, 200};
  Ping ping = silent_swath(beams);
  const double floor_db = thermal_floor_db(pulse, ping.fan);
  const double noise = std::sqrt(2 * power_from_db(floor_db)) * micropascal;  // amplitude [Pa]
  for (std::size_t b = 0; b < beams; ++b)
    add_echo(ping, b, b < of_bed ? 7 : 10, (b < of_bed ? 1e3 : 0.3) * noise, 0.03);
  const auto count = [&](double floor) {
    const BottomSoundings found = detect_bottom(ping, {.range_resolution = 0.03, .noise_floor_db = floor});
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found.range[i], found.beam[i] < of_bed ? 7 : 10, 2e-3);
    return found.size();
  };
  EXPECT_EQ(count(-std::numeric_limits<double>::infinity()), beams);
  EXPECT_EQ(count(floor_db), of_bed);
  EXPECT_EQ(count(floor_db - 60), beams);
}

// The floor stands for noise that is not simulated: where a beam holds noise, that alone counts.
TEST(DetectBottom, measures_noise_where_it_is_simulated) {
  Ping ping = silent_swath(32);
  add_white_noise(ping, 1);
  for (std::size_t b = 0; b < 32; ++b) add_echo(ping, b, 7, 30, 0.03);
  const BottomSoundings measured = detect_bottom(ping, {.range_resolution = 0.03});
  const BottomSoundings below = detect_bottom(ping, {.range_resolution = 0.03, .noise_floor_db = 117});
  EXPECT_EQ(measured.range, below.range);
  EXPECT_EQ(measured.deviation, below.deviation);
}

// A level within the tolerance of the synthesis is no echo.
TEST(DetectBottom, takes_nothing_below_the_tolerance_of_the_synthesis_for_the_bed) {
  Ping ping = silent_swath(32);
  for (std::size_t b = 0; b < 32; ++b) add_echo(ping, b, 7, b < 16 ? 1 : 0.1, 0.03);
  const auto count = [&](double tolerance) {
    return detect_bottom(ping, {.range_resolution = 0.03, .tolerance = tolerance, .side_lobe_margin_db = 60}).size();
  };
  EXPECT_EQ(count(1e-2), 32U);
  EXPECT_EQ(count(0.3), 16U);
}

TEST(DetectBottom, does_not_depend_on_threads) {
  Ping ping = silent_swath(32);
  add_white_noise(ping, 1);
  for (std::size_t b = 0; b < 32; ++b) add_echo(ping, b, 7 + 0.01 * static_cast<double>(b), 30, 0.03);
  const BottomSoundings one = detect_bottom(ping, {.range_resolution = 0.03, .threads = 1});
  const BottomSoundings many = detect_bottom(ping, {.range_resolution = 0.03, .threads = 7});
  EXPECT_EQ(one.range, many.range);
  EXPECT_EQ(one.deviation, many.deviation);
  EXPECT_EQ(one.size(), 32U);
}

TEST(DetectBottom, refuses_what_it_cannot_judge) {
  const Ping ping = silent_swath(2);
  EXPECT_EQ(detect_bottom(ping, {}).size(), 0U);
  EXPECT_EQ(error_of([&] { detect_bottom(ping, {.false_alarm_rate = 0}); }),
            "detect_bottom: false_alarm_rate = 0, must be above 0 and below 1");
  EXPECT_EQ(error_of([&] { detect_bottom(ping, {.per_beam = 0}); }), "detect_bottom: per_beam = 0, must be >= 1");
  EXPECT_THAT(error_of([&] { detect_bottom(ping, {.noise_floor_db = std::nan("")}); }), HasSubstr("noise_floor_db"));
  EXPECT_THAT(error_of([&] { detect_bottom(ping, {.tolerance = 1}); }), HasSubstr("tolerance = 1"));
  Ping expected = ping;
  expected.expected_level = true;
  EXPECT_THAT(error_of([&] { detect_bottom(expected, {}); }), HasSubstr("is an expected level"));
  Ping cut = ping;
  cut.split_phase = Grid<float>::Zero(2, 3);
  EXPECT_THAT(error_of([&] { detect_bottom(cut, {}); }), HasSubstr("split_phase has 2 x 3 cells"));
}

// Neighbours of a beam that looks over an edge have ranges of another surface.
TEST(DetectBottom, a_slope_of_no_plane_moves_a_range_by_less_than_its_footprint) {
  BeamFan fan;
  fan.azimuth = {0}, fan.elevation = {0}, fan.beam_width = radians(1), fan.elevation_width = radians(1);
  for (const double sine : {-0.99, -0.5, 0.0, 0.5, 0.99})
    for (const double slope : {-1000.0, -10.0, 0.0, 10.0, 1000.0}) {
      const BottomEcho echo = echo_of_plane(fan, sine, 3, slope, 0.01);
      EXPECT_LT(std::abs(echo.lengthening - echo.lengthening_along), 1.001 * echo.footprint_deviation)
          << sine << ' ' << slope;
    }
}
