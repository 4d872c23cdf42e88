// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "beamforming/synthesize_cells.hpp"
#include "simulate/layer_sum_internal.hpp"

namespace insonify {

/// Half width of the box with the variance of a disc, in the radius of the disc.
inline constexpr double spread_of_disc = 0.866;

/// Draws display cells from the energies of all echoes (E180). A layer has the cells of its echoes alone, with the
/// random amplitudes that they have in the sum.
class CellSum {
 public:
  /// Keeps references to both arguments, which must outlive it.
  CellSum(const ResolvedPing& ping, SynthesizerTable& synthesizers) : ping_(ping), synthesizers_(synthesizers) {}

  /// Adds direct echoes, of roots of mean power, with the patches of a scene that they are of.
  void add_direct(const SceneCloud& scene, const Scatterers& patches, const Echoes& echoes);
  /// Adds echoes of reverberation, which are new in each ping: the `number`-th kind of them.
  void add_reverberation(const std::string& name, Echoes echoes, std::size_t number);
  /// Adds echoes of surfaces by way of others, and those of no random amplitude.
  void add(const std::string& name, const SurfaceEchoes& surface, const Echoes& fixed = {});

  /// Draws the cells of all echoes and noise, and moves ping and report of layers into `result`; with the labels of the
  /// cells if the options ask for them, without shadow. The scene is that of the direct echoes.
  void finish(const SceneCloud& scene, SimulatedPing& result);

 private:
  /// The echoes of a layer, and those before it.
  struct Span {
    std::string name;
    std::size_t first, end, first_fixed, end_fixed;
  };
  void note(const std::string& name, std::size_t first, std::size_t first_fixed);
  CellOptions options_with(double noise_db) const;
  ComplexGridF drawn(const SurfaceEchoes& surface, const Echoes& fixed, double noise_db) const;
  ComplexGridF drawn(const Span& layer) const;
  /// Draws all echoes and noise, and sets the labels of the cells.
  ComplexGridF labelled(const SceneCloud& scene, double noise_db, PixelLabels& labels) const;

  const ResolvedPing& ping_;
  SynthesizerTable& synthesizers_;
  SurfaceEchoes all_;
  Echoes fixed_;
  std::vector<std::uint32_t> surfel_;  ///< surfel of each direct echo
  std::size_t water_begin_ = 0;        ///< first echo of reverberation; 0: there is none
  std::vector<Span> layers_;
  std::vector<LayerReport> report_;
};

}  // namespace insonify
