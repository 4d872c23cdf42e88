#pragma once
#include <cstddef>
#include <vector>

#include "beamforming/synthesize_noise.hpp"
#include "core/grid.hpp"

namespace insonify {

/// White noise of unit power per element, as the line array of each row of beams hears it.
///
/// Without column each row is a line array with elements of its own. With one, element m of a row is what the column's
/// elements k make of their noise when steered to the row:
///
///   y(row, m) = (1 / Nz) sum_k w_k exp(-2 pi i (d/lambda) (k - (Nz-1)/2) sin(elevation_row)) xi(m, k)
///
/// so that rows hear related noise as far as the column's beams overlap (E56). xi is counted by (ping, k columns + m,
/// bin): with one row and no column as ever.
class RowNoise {
 public:
  RowNoise(const SonarHead& head, double wavelength, const std::vector<FanRow>& rows, const NoiseOptions& options);

  /// Noise of element m for the rows [first, last), rows x bins, on the bins [begin, begin + bins).
  ComplexGrid white(std::size_t m, std::size_t first, std::size_t last, std::uint64_t begin, std::size_t bins) const;

 private:
  ComplexGrid column_;  // rows x elements of the column; empty without
  std::size_t columns_;
  NoiseOptions options_;
};

}  // namespace insonify
