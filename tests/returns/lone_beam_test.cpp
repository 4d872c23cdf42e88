// SPDX-License-Identifier: BSD-3-Clause
// Tests the deviations of soundings of a beam without neighbours against its errors, over planes and rough beds, from
// pings made by hand of echoes in known directions.
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "returns/bottom_detection.hpp"
#include "support/test.hpp"

namespace {

constexpr std::size_t lone_pings = 2000;
constexpr double lone_noise = 1e-3;  // relative to the echo's amplitude

/// An echo sounder, and the bed below it.
struct LoneBed {
  double width_deg = 0, pulse = 0;  ///< width of the beam, and of the pulse's intensity [m]
  double depth = 0;                 ///< [m] on the axis
  double tilt_deg = 0;              ///< tilt of the head over a level bed
  double slope_deg = 0;             ///< slope of the bed, across the tilt
  double relief = 0;                ///< standard deviation of the relief within the footprint [m]
  std::uint64_t echoes = 300;       ///< many in each pulse's length
};

Eigen::Vector3d direction_in(double across, double along) {
  return Eigen::Vector3d(std::sqrt(1 - across * across - along * along), across, along);
}

Ping lone_ping(const LoneBed& bed, std::uint64_t number) {
  const double spread = radians(bed.width_deg) / 2.3548, echo = bed.pulse / 2.3548;
  Ping ping;
  ping.fan = make_fan(1, 0, radians(bed.width_deg), radians(bed.width_deg));
  ping.gate = {0.5 * bed.depth, 2 * bed.depth, 0.44 * bed.pulse};
  ping.world_from_head = pose_from_yaw_pitch_roll({0, 0, 0}, 0, pi / 2 + radians(bed.tilt_deg), 0);
  ping.pressure = ComplexGridF::Zero(1, static_cast<Eigen::Index>(ping.gate.bins()));
  const Eigen::Vector3d up = Eigen::Vector3d(0, -std::tan(radians(bed.slope_deg)), 1).normalized();
  const Eigen::Vector3d in_head = ping.world_from_head.linear().transpose() * up;
  const auto normal = [&](std::uint64_t i, std::uint64_t k) {
    return random_complex_normal(11, RandomStage::noise, {number, i, k});
  };
  for (Eigen::Index n = 0; n < ping.pressure.cols(); ++n)
    ping.pressure(0, n) = std::complex<float>(lone_noise * normal(static_cast<std::uint64_t>(n), 0));
  for (std::uint64_t i = 0; i < bed.echoes; ++i) {
    const std::complex<double> away = std::sqrt(2.0) * spread * normal(i, 1), xi = normal(i, 2);
    if (std::norm(away) > 0.5) continue;
    const double cosine = in_head.dot(direction_in(away.real(), away.imag())) / in_head.x();
    if (std::abs(cosine) < 0.1) continue;
    const double range = bed.depth / cosine + bed.relief * std::sqrt(2.0) * normal(i, 3).real();
    // A Lambert bed has the energy cos^2 dS / r^4 over directions.
    const double loss = std::pow(bed.depth / range, 2) * std::sqrt(range / bed.depth / static_cast<double>(bed.echoes));
    const auto first =
        static_cast<std::size_t>(std::max(0.0, (range - 5 * echo - ping.gate.centre(0)) / ping.gate.bin_size));
    for (std::size_t n = first; n < ping.gate.bins() && ping.gate.centre(n) < range + 5 * echo; ++n)
      ping.pressure(0, static_cast<Eigen::Index>(n)) +=
          std::complex<float>(loss * xi * std::exp(-0.25 * std::pow((ping.gate.centre(n) - range) / echo, 2)));
  }
  return ping;
}

/// Root mean squares of errors, of deviations, and of one over the other.
struct LoneErrors {
  double bias = 0, observed = 0, predicted = 0, normalised = 0;
  std::size_t found = 0;
};

LoneErrors lone_errors(const LoneBed& bed) {
  std::vector<BottomSoundings> all(lone_pings);
  parallel_for(lone_pings, 0, [&](std::size_t p) {
    all[p] = detect_bottom(lone_ping(bed, p), {.range_resolution = bed.pulse, .threads = 1});
  });
  LoneErrors of;
  for (const BottomSoundings& one : all) {
    if (one.size() != 1 || one.reject[0] != 0) continue;
    const double error = one.range[0] - bed.depth, deviation = static_cast<double>(one.deviation[0]);
    ++of.found, of.bias += error, of.observed += error * error, of.predicted += deviation * deviation;
    of.normalised += std::pow(error / deviation, 2);
  }
  const auto count = static_cast<double>(of.found);
  of.bias /= count, of.predicted = std::sqrt(of.predicted / count), of.normalised = std::sqrt(of.normalised / count);
  of.observed = std::sqrt(of.observed / count - of.bias * of.bias);
  return of;
}

void expect_honest_lone(const LoneBed& bed) {
  const LoneErrors of = lone_errors(bed);
  const std::string name = testing::PrintToString(bed.depth) + " m, tilt " + testing::PrintToString(bed.tilt_deg) +
                           ", slope " + testing::PrintToString(bed.slope_deg) + ", relief " +
                           testing::PrintToString(bed.relief);
  std::printf("%5.1f deg %s: bias %.4f observed %.4f predicted %.4f (%.2f) normalised %.2f\n", bed.width_deg,
              name.c_str(), of.bias, of.observed, of.predicted, of.observed / of.predicted, of.normalised);
  EXPECT_GT(of.found, lone_pings * 995 / 1000) << name;
  EXPECT_LT(of.observed, 1.2 * of.predicted) << name;
  EXPECT_GT(of.observed, 0.8 * of.predicted) << name;
  EXPECT_LT(of.normalised, 1.25) << name;
  EXPECT_GT(of.normalised, 0.8) << name;
  EXPECT_LT(std::abs(of.bias), 0.25 * of.observed) << name;
}

}  // namespace

// Takes an es200-7c and a ping2: tilted a little over a level bed, over slopes that the head cannot know, and over
// relief.
TEST(LoneBeam, deviations_are_errors_of_seven_degrees) {
  for (const double depth : {5.0, 20.0, 60.0}) {
    const std::uint64_t echoes = depth > 50 ? 600 : 300;
    expect_honest_lone({7, 0.048, depth, 0, 0, 0, echoes});
    expect_honest_lone({7, 0.048, depth, 3, 12, 0, echoes});
    expect_honest_lone({7, 0.048, depth, 3, 0, 0.1, echoes});
  }
}

TEST(LoneBeam, deviations_are_errors_of_25_degrees) {
  for (const double depth : {3.0, 10.0, 20.0}) {
    const std::uint64_t echoes = depth > 15 ? 600 : 300;
    expect_honest_lone({25, 0.0417, depth, 5, 0, 0, echoes});
    expect_honest_lone({25, 0.0417, depth, 3, 12, 0, echoes});
    expect_honest_lone({25, 0.0417, depth, 3, 0, depth > 5 ? 0.1 : 0.04, echoes});
  }
}
