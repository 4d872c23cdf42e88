// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

#include "beamforming/synthesize.hpp"

namespace insonify {

/// Echoes weighted by the elevation response of each row of a head with several rows or a column (E14, E56).
class RowEchoes {
 public:
  /// Omits an echo from a row if the response of the row is below `cutoff` times the response of the row nearest to the
  /// echo. A `cutoff` of 0 omits no echo.
  RowEchoes(const Echoes& echoes, const SonarHead& head, double wavelength, const std::vector<FanRow>& rows,
            double cutoff, int threads);
  /// Returns the echoes that a row receives, weighted by its response, in order.
  Echoes of(const FanRow& row) const;

 private:
  static constexpr std::size_t block = 4096;
  const Echoes& echoes_;
  const SonarHead& head_;
  double wavelength_;
  int threads_;
  std::vector<double> least_;  // least response with which each echo is included in a row
};

/// Returns the head with the beams of one row only, as a line array.
SonarHead line_head(const SonarHead& head, const FanRow& row);

/// Returns the cutoff for `rows` rows. With this cutoff the omitted responses of all rows together change the image by
/// at most a tenth of the tolerance.
double row_cutoff(double tolerance, std::size_t rows);

/// Throws Error unless every echo has a value of v.
void require_elevations(const Echoes& echoes);

/// Returns an image, beams x bins, computed row by row: line(echoes, head) returns the image of a line array, beams of
/// the row x bins. A head with one row and no column is passed to `line` unchanged. `cutoff` is that of RowEchoes.
template <typename Image, typename Line>
Image image_by_rows(const Echoes& echoes, const SonarHead& head, const Medium& medium, double cutoff, int threads,
                    const Line& line) {
  const std::vector<FanRow> rows = fan_rows(head.fan);
  if (rows.size() == 1 && !head.column) return line(echoes, head);
  require_elevations(echoes);
  const RowEchoes row_echoes(echoes, head, medium.sound_speed / head.pulse.centre_frequency, rows, cutoff, threads);
  Image image(head.fan.beams(), head.gate.bins());
  for (const FanRow& row : rows) image(row.beams, Eigen::all) = line(row_echoes.of(row), line_head(head, row));
  return image;
}

}  // namespace insonify
