// SPDX-License-Identifier: BSD-3-Clause
// Series computed independently of this project; tests/data/golden/README.md states their conventions.
#include "acoustics/direct_echoes.hpp"
#include "acoustics/surface_scattering.hpp"
#include "beamforming/synthesize.hpp"
#include "sonar/shading.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

using Complex = std::complex<double>;
constexpr double fc = 900e3, sample_rate = 118e3, db_per_m = 0.0354;

/// Rows of numbers of a CSV file, without comments and header.
std::vector<std::vector<double>> read_table(const std::string& name) {
  std::ifstream file(std::string(INSONIFY_TEST_DATA) + "/golden/" + name);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || std::isalpha(line[0])) continue;
    std::vector<double> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    rows.push_back(row);
  }
  return rows;
}

/// One omnidirectional beam whose bin n - 1 is the golden sample n.
SonarHead golden_head(std::size_t samples) {
  const double bin = c0 / (2 * sample_rate);
  SonarHead head;
  head.pulse = {fc, 29.5e3 * std::sqrt(2 * std::numbers::ln2) / pi, 220};
  head.fan = make_fan(1, 0.1, 0.1, 0.1);
  head.gate = {0.5 * bin, (static_cast<double>(samples) - 0.5) * bin, bin};
  head.array = {0.5 * c0 / fc, uniform_shading(1)};
  return head;
}

/// Series of one golden beam, in the golden conventions; index n - 1 is sample n.
std::vector<Complex> series_of_beam(const std::vector<std::vector<double>>& scatterers, int beam, std::size_t samples) {
  Scatterers s;
  std::vector<double> sigma;
  std::vector<Complex> xi;
  for (const auto& row : scatterers) {  // beam, ray, range, alpha, dtheta, dphi, mu, xi_x, xi_y
    if (static_cast<int>(row[0]) != beam || row[2] == 0) continue;
    s.range.push_back(row[2]), s.azimuth.push_back(0), s.elevation.push_back(0);
    sigma.push_back(lambert_cross_section(row[6], std::cos(row[3]), row[2] * row[2] * row[4] * row[5]));
    xi.push_back(Complex(row[7], row[8]) / std::numbers::sqrt2);
  }
  const SonarHead head = golden_head(samples);
  const Medium medium{c0, {db_per_m * nepers_per_db, 0, 0}};
  const ComplexGrid p = synthesize_direct(target_echoes(s, sigma, xi, head.pulse, medium), head, medium);
  std::vector<Complex> series(static_cast<std::size_t>(p.cols()));
  for (std::size_t n = 0; n < series.size(); ++n)
    series[n] = p(0, static_cast<Eigen::Index>(n)) / std::numbers::sqrt2 *
                std::polar(1.0, -2 * pi * reduced_cycles(fc * (static_cast<double>(n) + 1) / sample_rate));
  return series;
}

}  // namespace

TEST(GoldenSeries, single_beam_of_three_scatterers_within_1e_9_of_its_maximum) {
  const auto scatterers = read_table("sb3_scatterers.csv");
  const auto golden = read_table("sb3_series.csv");  // n, t, range, re, im, level
  ASSERT_EQ(scatterers.size(), 3U);
  ASSERT_GT(golden.size(), 200U);
  const auto series = series_of_beam(scatterers, 1, 1887);
  double maximum = 0, worst = 0;
  for (const auto& row : golden) {
    const Complex expected(row[3], row[4]);
    maximum = std::max(maximum, std::abs(expected));
    worst = std::max(worst, std::abs(series.at(static_cast<std::size_t>(row[0]) - 1) - expected));
  }
  EXPECT_GT(maximum, 1);
  EXPECT_LT(worst / maximum, 1e-9);
}

TEST(GoldenSeries, five_beams_raw_and_mixed_within_1e_9_of_their_maximum) {
  const auto scatterers = read_table("mb5_scatterers.csv");
  const auto raw = read_table("mb5_series.csv"), mixed = read_table("mb5_mixed_series.csv");  // n, t, re1, im1, ...
  ASSERT_EQ(scatterers.size(), 15U);
  ASSERT_EQ(raw.size(), mixed.size());
  std::vector<std::vector<Complex>> beams;
  for (int b = 1; b <= 5; ++b) beams.push_back(series_of_beam(scatterers, b, 2516));

  const auto sinc = [](double x) { return x == 0 ? 1 : std::sin(pi * x) / (pi * x); };
  double max_raw = 0, worst_raw = 0, max_mixed = 0, worst_mixed = 0;
  for (std::size_t k = 0; k < raw.size(); ++k) {
    const auto n = static_cast<std::size_t>(raw[k][0]) - 1;
    for (std::size_t j = 0; j < 5; ++j) {
      const Complex expected_raw(raw[k][2 + 2 * j], raw[k][3 + 2 * j]),
          expected_mixed(mixed[k][2 + 2 * j], mixed[k][3 + 2 * j]);
      Complex mix = 0;
      for (std::size_t i = 0; i < 5; ++i)
        mix += sinc(0.884 * std::sin(0.05 * (static_cast<double>(i) - static_cast<double>(j))) / 0.1) * beams[i].at(n);
      max_raw = std::max(max_raw, std::abs(expected_raw));
      max_mixed = std::max(max_mixed, std::abs(expected_mixed));
      worst_raw = std::max(worst_raw, std::abs(beams[j].at(n) - expected_raw));
      worst_mixed = std::max(worst_mixed, std::abs(mix - expected_mixed));
    }
  }
  EXPECT_LT(worst_raw / max_raw, 1e-9);
  EXPECT_LT(worst_mixed / max_mixed, 1e-9);
}
