// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <vector>

#include "beamforming/display/cell_row_internal.hpp"
#include "beamforming/head_patterns.hpp"
#include "sonar/response_table.hpp"

namespace insonify {

/// Returns the echoes of surfaces, and after them `fixed` ones, with the parts of their energies in each cell.
EchoesByCell echoes_by_cell(const DisplayPlan& plan, const SurfaceEchoes& surface, const Echoes& fixed,
                            const Medium& medium, const CellOptions& options);

/// Returns the responses of a row of beams to echoes of surfaces and `fixed` ones, which `source` lists (E14, E56); 0 if it
/// is below `cutoff` times that of the row nearest to the echo. A column's are interpolated, within 1e-5. Elevations of
/// all rows ascend.
class RowWeights {
 public:
  /// Keeps a reference to the head.
  RowWeights(const SonarHead& head, double wavelength, const std::vector<FanRow>& rows, double cutoff,
             const SurfaceEchoes& surface, const Echoes& fixed, const UninitializedVector<std::uint32_t>& source,
             int threads);
  std::vector<double> of(const FanRow& row) const;

 private:
  /// Calls use(i, response of the row at row_of(i)) for each echo.
  template <typename RowOf, typename Use>
  void for_each(const RowOf& row_of, const Use& use) const;

  const SonarHead& head_;
  double wavelength_;
  int threads_;
  std::optional<ResponseTable> column_;
  std::vector<double> v_, least_;
};

}  // namespace insonify
