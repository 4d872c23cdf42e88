// SPDX-License-Identifier: BSD-3-Clause
// Error rates of detection in noise. Bins are longer than the pulse and beams are in each other's nulls, so samples are
// independent; seeds are fixed, tolerances are multiples of the binomial standard error.
#include "acoustics/direct_echoes.hpp"
#include "beamforming/synthesize_noise.hpp"
#include "returns/detect_soundings.hpp"
#include "speckle_bench.hpp"
#include "support/test.hpp"

using namespace insonify::laws;

namespace {

constexpr double element_level_db = 60;
constexpr std::size_t elements = 32, beams = 16, bins = 20000;

/// Returns 16 of the 32 orthogonal beams of a uniform array, 20 000 independent bins.
SonarHead independent_head() {
  std::vector<double> azimuths;
  for (std::size_t b = 0; b < beams; ++b)
    azimuths.push_back(std::asin((static_cast<double>(b) - 7.5) * 2.0 / static_cast<double>(elements)));
  const double bin = 0.1;
  return head_with({wavelength / 2, std::vector<double>(elements, 1.0)}, azimuths, 60e3,
                   {10, 10 + bin * (static_cast<double>(bins) - 0.5), bin});
}

double noise_floor_db() { return element_level_db - 10 * std::log10(static_cast<double>(elements)); }

Ping noise_ping(const SonarHead& head, const ComplexGrid& signal, std::int64_t number) {
  Ping ping;
  ping.number = number;
  ping.fan = head.fan;
  ping.gate = head.gate;
  ComplexGrid p = synthesize_noise(head, clear_water(), element_level_db, {.seed = 5, .ping = number});
  if (signal.size() > 0) p += signal;
  ping.pressure = p.cast<std::complex<float>>();
  return ping;
}

const SonarHead detecting_head = independent_head();

/// Detects without a scene: the ping alone decides.
Soundings detections_of(const Ping& ping, const DetectionOptions& options) {
  return detect_soundings(ping, Scatterers{}, Echoes{}, options);
}

/// Returns the detections of one kind in `pings` pings of pure noise.
double false_alarms(int pings, DetectionOptions options) {
  double count = 0;
  for (int ping = 0; ping < pings; ++ping)
    count += static_cast<double>(detections_of(noise_ping(detecting_head, {}, ping), options).size());
  return count;
}

double threshold_db(double false_alarm_rate) { return db_from_power(-std::log(false_alarm_rate)); }

}  // namespace

TEST(DetectionLaws, thresholds_of_exponential_noise_are_8_39_9_64_and_11_40_db) {
  EXPECT_NEAR(threshold_db(1e-3), 8.39, 0.005);
  EXPECT_NEAR(threshold_db(1e-4), 9.64, 0.005);
  EXPECT_NEAR(DetectionOptions{}.threshold_db, threshold_db(1e-6), 0.005);
}

// The fraction Pfa of the samples is above the threshold. A local maximum must also exceed both neighbours, which
// removes ln(1 / Pfa) Pfa of them, less than 1 % here.
TEST(DetectionLaws, false_alarms_come_at_the_rate_of_their_threshold) {
  const double samples = 4.0 * beams * bins;
  for (const double rate : {1e-2, 1e-3, 1e-4}) {
    const double expected = rate * samples, error = 3 * std::sqrt(expected);
    DetectionOptions every;
    every.all_bins = true;
    every.above_db = noise_floor_db() + threshold_db(rate);
    EXPECT_NEAR(false_alarms(4, every), expected, error) << rate;
    DetectionOptions peaks;
    peaks.noise_floor_db = noise_floor_db();
    peaks.threshold_db = threshold_db(rate);
    peaks.false_alarm_rate = 1;
    EXPECT_NEAR(false_alarms(4, peaks), expected, error + rate * expected) << rate;
  }
  // 1.28 expected at 10^-6: six or more have a chance of 0.2 %.
  EXPECT_LE(false_alarms(4, {.noise_floor_db = noise_floor_db(), .false_alarm_rate = 1}), 5);
}

// Cell averaging over n = 32 cells: x above a sum of n such cells / n times the factor, and above both neighbours, has
// probability p(1) - p(2) + p(3) / 3 with p(k) = (1 + k factor / n)^-n, of which p(1) is the rate of a single sample.
TEST(DetectionLaws, false_alarms_above_the_background_come_at_their_rate_for_any_level_of_it) {
  const double samples = 4.0 * beams * bins;
  for (const double rate : {1e-1, 1e-2, 1e-3, 1e-4}) {
    const double factor = background_factor(rate, 32) / 32;
    const auto p = [&](int k) { return std::pow(1 + k * factor, -32); };
    EXPECT_NEAR(p(1) / rate, 1, 1e-12);
    const double expected = (p(1) - p(2) + p(3) / 3) * samples;
    for (const double floor_db : {-100.0, 0.0}) {
      const double found = false_alarms(
          4, {.noise_floor_db = floor_db, .threshold_db = 0, .side_lobe_margin_db = 1000, .false_alarm_rate = rate});
      EXPECT_NEAR(found, expected, 3 * std::sqrt(expected) + 0.002 * expected) << rate;
    }
  }
}

// A target of Rayleigh amplitude: Pd = Pfa^(1 / (1 + SNR)). 0.5 at 10^-4 takes 10.89 dB, 0.9 takes 19.37 dB.
TEST(DetectionLaws, rayleigh_target_is_found_with_pfa_to_the_one_over_one_plus_snr) {
  const double rate = 1e-4;
  for (const auto& [snr_db, expected] : {std::pair(10.89, 0.5), std::pair(19.37, 0.9), std::pair(3.0, 0.0462)}) {
    ASSERT_NEAR(std::pow(rate, 1 / (1 + power_from_db(snr_db))), expected, 5e-4);
    // One patch in every tenth bin of the beams, of mean level `snr_db` above the beam's noise.
    Scatterers s;
    std::vector<double> power;
    const double wanted = 2 * std::pow(micropascal, 2) * power_from_db(noise_floor_db() + snr_db);
    for (std::size_t b = 0; b < beams; ++b)
      for (std::size_t n = 5; n < bins; n += 10) {
        s.id.push_back(s.range.size());
        s.range.push_back(detecting_head.gate.centre(n));
        s.azimuth.push_back(detecting_head.fan.azimuth[b]);
        const double one_square_metre = source_pressure(detecting_head.pulse) / std::pow(s.range.back(), 2);
        power.push_back(wanted / (one_square_metre * one_square_metre));
      }
    s.elevation.assign(s.range.size(), 0);
    s.cos_incidence.assign(s.range.size(), 1);
    s.material.assign(s.range.size(), 0);
    s.surfel.assign(s.range.size(), 0);
    for (const double sigma : power) s.projected_area.push_back(static_cast<float>(sigma));
    const std::vector<Material> materials{{"target", 1.0}};
    const Echoes echoes = direct_echoes(s, materials, detecting_head.pulse, clear_water(), {.seed = 9});
    const Ping ping = noise_ping(detecting_head, synthesize_gridded(echoes, detecting_head, clear_water()), 77);
    const Soundings found = detections_of(ping, {.noise_floor_db = noise_floor_db(),
                                                 .threshold_db = threshold_db(rate),
                                                 .side_lobe_margin_db = 1000,
                                                 .false_alarm_rate = 1});
    double hits = 0;
    for (const std::uint32_t bin : found.bin) hits += bin % 10 == 5;
    const auto targets = static_cast<double>(s.size());
    EXPECT_NEAR(hits / targets, expected, 3 * std::sqrt(expected * (1 - expected) / targets) + 1e-3) << snr_db << " dB";
  }
}
