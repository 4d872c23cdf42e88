// SPDX-License-Identifier: BSD-3-Clause
// Why soundings are rejected, and what their deviations hold, from pings made by hand.
#include "core/random.hpp"
#include "returns/bottom_detection.hpp"
#include "support/test.hpp"

namespace {

constexpr double echo_width = 0.02, echo_deviation = echo_width / 2.3548;  // of the pulse's intensity [m]

/// Returns a ping that looks straight down, silent but for faint noise.
Ping quiet_ping(std::size_t beams, double field_deg, double along_deg, double max_range) {
  Ping ping;
  ping.fan = make_fan(beams, radians(field_deg), radians(1), radians(along_deg));
  ping.gate = {2, max_range, 0.01};
  ping.world_from_head = pose_from_yaw_pitch_roll({0, 0, 0}, 0, pi / 2, 0);
  ping.pressure = ComplexGridF(static_cast<Eigen::Index>(beams), static_cast<Eigen::Index>(ping.gate.bins()));
  for (Eigen::Index b = 0; b < ping.pressure.rows(); ++b)
    for (Eigen::Index n = 0; n < ping.pressure.cols(); ++n)
      ping.pressure(b, n) = std::complex<float>(
          1e-3 * random_complex_normal(3, RandomStage::noise,
                                       {900, static_cast<std::uint64_t>(b), static_cast<std::uint64_t>(n)}));
  return ping;
}

/// Adds speckle: 400 echoes at `range_of(x)`, x a normal number, of power 1 together.
template <typename RangeOf>
void add_speckle(Ping& ping, std::size_t beam, std::uint64_t number, const RangeOf& range_of) {
  for (std::uint64_t i = 0; i < 400; ++i) {
    const auto u = random_complex_normal(7, RandomStage::noise, {number, beam, 2 * i});
    const auto xi = random_complex_normal(7, RandomStage::noise, {number, beam, 2 * i + 1}) / 20.0;
    const double range = range_of(std::sqrt(2.0) * u.real());
    const double first = (range - 6 * echo_deviation - ping.gate.centre(0)) / ping.gate.bin_size;
    for (auto n = static_cast<std::size_t>(std::max(0.0, first)); n < ping.gate.bins(); ++n) {
      const double x = (ping.gate.centre(n) - range) / echo_deviation;
      if (x > 6) break;
      ping.pressure(static_cast<Eigen::Index>(beam), static_cast<Eigen::Index>(n)) +=
          std::complex<float>(xi * std::exp(-0.25 * x * x));
    }
  }
}

/// Adds the level bottom 7 m below, in all beams.
void add_level_bottom(Ping& ping, std::uint64_t number) {
  for (std::size_t b = 0; b < ping.fan.beams(); ++b) {
    const double angle = ping.fan.azimuth[b], slope = 7 * std::tan(angle) / std::cos(angle);
    add_speckle(ping, b, number, [&](double x) {
      return 7 / std::cos(angle) + slope * x * ping.fan.beam_width / std::cos(angle) / 2.3548;
    });
  }
}

/// Adds an echo at 14 m in place of, or beside, a beam's own: longer than a pulse, turned by so much in a bin [rad].
void add_lobe(Ping& ping, std::size_t beam, double turn, bool beside) {
  for (std::size_t n = 0; n < ping.gate.bins(); ++n) {
    const double x = (ping.gate.centre(n) - 14) / 0.1;
    auto& here = ping.pressure(static_cast<Eigen::Index>(beam), static_cast<Eigen::Index>(n));
    here = (beside ? here : 1e-3F * here) +
           std::complex<float>(std::polar((beside ? 1 : 4) * std::exp(-x * x), turn * static_cast<double>(n)));
  }
}

}  // namespace

// Sound from beyond the fan fills the outer beams at one range, where nothing else is received, a bandwidth beside the
// pulse's frequency: it lasts longer than a pulse and turns. The same without the turn is an echo of the fan's own, and
// stays.
TEST(JudgeSoundings, rejects_what_a_grating_lobe_brings_in) {
  for (const double turn : {1.4, -1.4, 0.0}) {  // [rad] in a bin
    Ping ping = quiet_ping(101, 140, 1, 24);
    add_level_bottom(ping, 1);
    for (std::size_t b = 0; b < 10; ++b) add_lobe(ping, b, turn, false);
    const BottomSoundings found = detect_bottom(ping, {.range_resolution = echo_width});
    ASSERT_EQ(found.size(), 101U);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const bool lobe = found.beam[i] < 10;
      if (lobe) {
        EXPECT_NEAR(found.range[i], 14, 0.05);
      }
      EXPECT_EQ((found.reject[i] & reject_grating_lobe) != 0, lobe && turn != 0) << "beam " << i << ", turn " << turn;
    }
  }
}

// In one beam there is no echo of the bottom, but one behind it, 22 dB below.
TEST(JudgeSoundings, rejects_what_is_far_below_the_bottom_about_it) {
  Ping ping = quiet_ping(101, 90, 1, 24);
  add_level_bottom(ping, 1);
  ping.pressure.row(50) *= 1e-3F;
  Ping behind = quiet_ping(101, 90, 1, 24);
  add_speckle(behind, 50, 5, [](double x) { return 9 + 0.01 * x; });
  ping.pressure.row(50) += 0.08F * behind.pressure.row(50);
  const BottomSoundings found = detect_bottom(ping, {.range_resolution = echo_width});
  ASSERT_EQ(found.size(), 101U);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_EQ((found.reject[i] & reject_faint) != 0, found.beam[i] == 50) << "beam " << found.beam[i];
}

// Louder than the bottom, which is in the same beams: the bottom is found.
TEST(JudgeSoundings, finds_the_bottom_beside_a_grating_lobe) {
  Ping ping = quiet_ping(101, 140, 1, 24);
  add_level_bottom(ping, 1);
  for (std::size_t b = 8; b < 18; ++b) add_lobe(ping, b, 1.4, true);
  const BottomSoundings found = detect_bottom(ping, {.range_resolution = echo_width});
  ASSERT_EQ(found.size(), 101U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double range = 7 / std::cos(ping.fan.azimuth[found.beam[i]]);
    if (found.beam[i] >= 8 && found.beam[i] < 18 && std::abs(range - 14) > 1) {
      EXPECT_NEAR(found.range[i], range, 0.3) << found.beam[i];
    }
  }
}

// Among so many beams over level bottoms hardly one echo is taken for a grating lobe's.
TEST(JudgeSoundings, takes_speckle_for_an_echo_of_the_fan) {
  std::size_t found = 0, rejected = 0;
  for (std::uint64_t number = 0; number < 12; ++number) {
    Ping ping = quiet_ping(101, 140, 1, 24);
    add_level_bottom(ping, number);
    const BottomSoundings all = detect_bottom(ping, {.range_resolution = echo_width});
    found += all.size();
    for (const std::uint8_t reject : all.reject) rejected += (reject & reject_grating_lobe) != 0;
  }
  EXPECT_GT(found, 1200U);
  EXPECT_LE(rejected, 1U);
}

// Beams of 20 degrees along the way over beds that bend along it: the mean range of a plane is taken off, that of a
// trough or a crest is another, and the deviation says so.
TEST(JudgeSoundings, states_what_a_bend_along_the_way_may_cost) {
  const double along = radians(20) / 2.3548;
  const auto normalised = [&](double bend) {  // bend: of range over angle, 1 of a plane
    double errors = 0, deviations = 0;
    for (std::uint64_t number = 0; number < 6; ++number) {
      Ping ping = quiet_ping(31, 31, 20, 12);
      for (std::size_t b = 0; b < ping.fan.beams(); ++b) {
        const double range = 6 / std::cos(ping.fan.azimuth[b]);
        add_speckle(ping, b, number, [&](double x) { return range + 0.5 * bend * range * std::pow(along * x, 2); });
      }
      const BottomSoundings found = detect_bottom(ping, {.range_resolution = echo_width});
      for (std::size_t i = 0; i < found.size(); ++i) {
        errors += std::pow(found.range[i] - 6 / std::cos(ping.fan.azimuth[found.beam[i]]), 2);
        deviations += std::pow(static_cast<double>(found.deviation[i]), 2);
      }
    }
    RecordProperty("deviation_of_bend_" + std::to_string(bend), std::to_string(std::sqrt(deviations / 186)));
    return std::sqrt(errors / deviations);
  };
  EXPECT_LT(normalised(1), 1.3);
  for (const double bend : {-1.0, -0.5, 0.2, 2.5}) {
    EXPECT_GT(normalised(bend), 0.6) << bend;
    EXPECT_LT(normalised(bend), 2) << bend;
  }
}
