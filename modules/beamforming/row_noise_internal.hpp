#pragma once
#include <cstddef>
#include <vector>

#include "beamforming/synthesize_noise.hpp"
#include "core/grid.hpp"

namespace insonify {

/// White noise of unit power per element, as received by the line array of each row of beams.
///
/// Without a column each row has elements of its own. With a column, the noise of element m of a row is formed from
/// that of the column's elements k, steered to the row:
///
///   y(row, m) = (1 / Nz) sum_k w_k exp(-2 pi i (d/lambda) (k - (Nz-1)/2) sin(elevation_row)) xi(m, k)
///
/// so the noise of rows is correlated as far as the column's beams overlap (E56). xi is counted by (ping, k columns +
/// m, bin), which for one row without column is the counting of a line array.
class RowNoise {
 public:
  RowNoise(const SonarHead& head, double wavelength, const std::vector<FanRow>& rows, const NoiseOptions& options);

  /// Returns the noise of element m for rows [first, last), rows x bins, on bins [begin, begin + bins).
  ComplexGrid white(std::size_t m, std::size_t first, std::size_t last, std::uint64_t begin, std::size_t bins) const;

 private:
  ComplexGrid column_;  // rows x elements of the column; empty without a column
  std::size_t columns_;
  NoiseOptions options_;
};

}  // namespace insonify
