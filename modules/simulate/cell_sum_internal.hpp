// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "beamforming/synthesize_cells.hpp"
#include "simulate/layer_sum_internal.hpp"

namespace insonify {

/// Draws display cells from the energies of all echoes (E180).
class CellSum {
 public:
  /// Keeps references to both arguments, which must outlive it.
  CellSum(const ResolvedPing& ping, SynthesizerTable& synthesizers) : ping_(ping), synthesizers_(synthesizers) {}

  /// Adds direct echoes, of roots of mean power, with the patches that they are of.
  void add_direct(const Scatterers& patches, const Echoes& echoes);
  /// Adds echoes of reverberation, which are new in each ping: the `number`-th kind of them.
  void add_reverberation(const std::string& name, Echoes echoes, std::size_t number);

  /// Draws the cells of all echoes and noise, and moves ping and report of layers into `result`.
  void finish(SimulatedPing& result);

 private:
  const ResolvedPing& ping_;
  SynthesizerTable& synthesizers_;
  SurfaceEchoes all_;
  std::vector<LayerReport> report_;
};

}  // namespace insonify
