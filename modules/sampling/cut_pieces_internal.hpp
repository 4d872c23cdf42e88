// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// One number or answer for each tenth of the ranges up to the farthest.
template <typename T>
using RangeTenths = std::array<T, 10>;

/// Returns the tenth of the ranges up to `farthest` in which a range lies.
inline std::size_t tenth_of(double range, double farthest) {
  return static_cast<std::size_t>(std::clamp(10 * range / farthest, 0.0, 9.0));
}

/// Energy that a cut returns by Lambert's law from each tenth of the ranges, and the part that comes from nodes whose
/// relief turns away from the head (E225): sums of areas times squares of cosines of incidence [m^2].
struct CutEnergy {
  RangeTenths<double> all{}, turned{};

  void add(const CutEnergy& other);
  /// Returns true for the tenths in which relief that turns away returns more than 4.55 % of the energy, of which half is
  /// 0.1 dB, and for those beside them, onto which its shadows fall.
  RangeTenths<bool> hidden_by_relief() const;
};

/// Surfels and nodes that stand for the surfels of some blocks.
struct CutPiece {
  SceneCloud scene;
  std::vector<std::uint32_t> stands_for;  ///< surfel of the scene, or its id
  CutEnergy energy;                       ///< energy of its surfels and nodes in the region
};

/// Returns the sum of the energies of all parts.
CutEnergy energy_of(const std::vector<CutPiece>& pieces);

/// Parts joined in the order of the scene, however its surfels are arranged in levels.
struct OrderedCut {
  SceneCloud cut;
  std::vector<std::uint32_t> order;       ///< places in the cut of the surfels of all parts
  std::vector<std::uint32_t> stands_for;  ///< surfels that those of the cut stand for

  OrderedCut(const std::vector<CutPiece>& pieces, const SceneCloud& scene, int threads);
};

/// Returns parts whose `stands_for` are ids, joined by ascending id, with all but the surfels of `like`.
SceneCloud joined_by_id(const std::vector<CutPiece>& pieces, const SceneCloud& like, bool noisy, int threads);

}  // namespace insonify
