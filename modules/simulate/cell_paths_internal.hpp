// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "acoustics/double_echoes.hpp"
#include "beamforming/synthesize_cells.hpp"
#include "simulate/resolve_ping.hpp"

namespace insonify {

/// Echoes by way of other surfaces, as display cells take them (E190).
///
/// Both senses of a path have one random number, and add up as pressures in a beam that holds both directions. What
/// this adds to their energy is 2 Re(A_1 A_2*) times the correlation of a beam's pattern over the distance of the
/// directions, and stands halfway between them. Where it is negative, the energies of both are less. Echoes of
/// different delays are independent.
class CellPaths {
 public:
  /// Keeps references to both arguments, which must outlive it.
  CellPaths(const SceneCloud& scene, const ResolvedPing& ping);

  /// Returns the echoes by boundaries or mirrors: of each surfel and pair of legs the first has the energy of all
  /// patches. kind: a number that keeps their ids apart from those of other kinds.
  SurfaceEchoes of(const Multipath& bounced, std::uint64_t kind) const;
  /// Returns the double echoes: each ray is an echo of its own, at the positions that it joins.
  SurfaceEchoes of(const DoubleEchoes& doubles) const;

 private:
  /// An echo of a list, with the half extents of its surface.
  struct Entry {
    const Echoes& of;
    std::size_t index;
    std::uint64_t id;
    double depth, width;
  };
  struct Merged;
  static void add(const Entry& entry, SurfaceEchoes& to);
  void add_both(const Entry& one, const Entry& other, SurfaceEchoes& to) const;
  double likeness(const Echoes& echoes, std::size_t i, std::size_t j) const;
  void add_surfel(const Multipath& bounced, std::size_t begin, std::size_t end, std::uint64_t kind,
                  const std::vector<Eigen::Vector3d>& heads, SurfaceEchoes& to) const;

  const SceneCloud& scene_;
  const ResolvedPing& ping_;
  double wavelength_;
  bool rows_;
};

}  // namespace insonify
