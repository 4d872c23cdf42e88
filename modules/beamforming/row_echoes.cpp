// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "beamforming/head_patterns.hpp"
#include "beamforming/row_echoes_internal.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace insonify {

RowEchoes::RowEchoes(const Echoes& echoes, const SonarHead& head, double wavelength, const std::vector<FanRow>& rows,
                     double cutoff, int threads)
    : echoes_(echoes), head_(head), wavelength_(wavelength), threads_(threads), least_(echoes.size(), -1) {
  if (cutoff == 0) return;
  std::vector<double> v_row;
  for (const FanRow& row : rows) v_row.push_back(std::sin(row.elevation));
  parallel_blocks(echoes.size(), block, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double v = echoes.v[i];
      std::size_t above = std::lower_bound(v_row.begin(), v_row.end(), v) - v_row.begin();
      if (above > 0 && (above == rows.size() || v - v_row[above - 1] < v_row[above] - v)) --above;
      least_[i] = cutoff * std::abs(RowResponse(head, wavelength, rows[above].elevation).at(v));
    }
  });
}

Echoes RowEchoes::of(const FanRow& row) const {
  std::vector<double> response(echoes_.size());
  parallel_blocks(echoes_.size(), block, threads_, [&](std::size_t begin, std::size_t end) {
    RowResponse row_response(head_, wavelength_, row.elevation);
    for (std::size_t i = begin; i < end; ++i) response[i] = row_response.at(echoes_.v[i]);
  });
  Echoes of_row;
  for (std::size_t i = 0; i < response.size(); ++i) {
    if (std::abs(response[i]) <= least_[i]) continue;
    of_row.delay.push_back(echoes_.delay[i]);
    of_row.u.push_back(echoes_.u[i]);
    of_row.amplitude.push_back(echoes_.amplitude[i] * response[i]);
    if (!echoes_.doppler.empty()) of_row.doppler.push_back(echoes_.doppler[i]);
  }
  return of_row;
}

SonarHead line_head(const SonarHead& head, const FanRow& row) {
  SonarHead line = head;
  line.column.reset();
  line.fan.row_width = 0;
  line.fan.elevation.assign(row.beams.size(), row.elevation);
  line.fan.azimuth.clear();
  for (const std::size_t b : row.beams) line.fan.azimuth.push_back(head.fan.azimuth[b]);
  return line;
}

double row_cutoff(double tolerance, std::size_t rows) { return 0.1 * tolerance / std::sqrt(static_cast<double>(rows)); }

void require_elevations(const Echoes& echoes) {
  if (echoes.v.size() != echoes.size())
    fail(ErrorKind::argument, "synthesize: echoes have ", echoes.size(), " delays and ", echoes.v.size(),
         " directions upwards (v), must be one of each for a head with several rows of beams");
}

}  // namespace insonify
