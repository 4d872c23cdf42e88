#pragma once
#include <cstddef>
#include <vector>

#include "beamforming/synthesize.hpp"

namespace insonify {

/// Echoes as each row of a head with several rows, or with a column, hears them (E14, E56).
class RowEchoes {
 public:
  /// An echo is left out of a row whose response is below `part` of that of the row nearest to it; 0: never.
  RowEchoes(const Echoes& echoes, const SonarHead& head, double wavelength, const std::vector<FanRow>& rows,
            double part, int threads);
  Echoes of(const FanRow& row) const;

 private:
  static constexpr std::size_t block = 4096;
  const Echoes& echoes_;
  const SonarHead& head_;
  double wavelength_;
  int threads_;
  std::vector<double> least_;  // response below which an echo is left out of a row
};

/// The head with the beams of one row alone, as a line array.
SonarHead line_head(const SonarHead& head, const FanRow& row);

/// Part of an echo that may be left out of one of `rows` rows: over all of them a tenth of the tolerance is lost.
double row_part(double tolerance, std::size_t rows);

/// Throws Error unless there is one echoes.v per echo.
void require_elevations(const Echoes& echoes);

/// An image, beams x bins, made row by row: line(echoes, head) gives that of a line array, beams of the row x bins. A
/// head with one row and no column is a line array already. `part` as RowEchoes takes it.
template <typename Image, typename Line>
Image image_by_rows(const Echoes& echoes, const SonarHead& head, const Medium& medium, double part, int threads,
                    const Line& line) {
  const std::vector<FanRow> rows = fan_rows(head.fan);
  if (rows.size() == 1 && !head.column) return line(echoes, head);
  require_elevations(echoes);
  const RowEchoes row_echoes(echoes, head, medium.sound_speed / head.pulse.centre_frequency, rows, part, threads);
  Image image(head.fan.beams(), head.gate.bins());
  for (const FanRow& row : rows) {
    const Image beams = line(row_echoes.of(row), line_head(head, row));
    for (std::size_t k = 0; k < row.beams.size(); ++k)
      image.row(static_cast<Eigen::Index>(row.beams[k])) = beams.row(static_cast<Eigen::Index>(k));
  }
  return image;
}

}  // namespace insonify
