// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/grid.hpp"

namespace insonify {

/// Kind of path from head to contributor and back.
enum class PathKind : std::uint8_t { direct, one_bounce, two_bounces, two_surfaces };

/// The strongest contributors of every pixel of a ping, as a structure of arrays. Entry (beam x bins + bin) x per_pixel
/// + k is the k-th strongest of a pixel; unused entries have surfel `none` and share 0. Computed by find_contributors.
struct Contributors {
  static constexpr std::uint32_t none = 0xffffffff;
  static constexpr std::uint16_t no_material = 0xffff;

  std::size_t beams = 0, bins = 0, per_pixel = 0;
  std::vector<std::uint32_t> surfel;    ///< index in the scene
  std::vector<std::uint32_t> id;        ///< id of the surfel in the scene; `none` if unused
  std::vector<float> share;             ///< fraction of the energy of all contributors of the pixel, in [0, 1]
  std::vector<float> elevation;         ///< direction of arrival [rad], head axes; 0 if unused
  std::vector<std::uint16_t> material;  ///< index into the scene's materials; `no_material` if unused
  std::vector<PathKind> path;
  /// For a double echo, the surfel that the sound met first, index in the scene; otherwise `none`. Empty if no double
  /// echoes were computed.
  std::vector<std::uint32_t> surfel_before{};
  std::vector<float> total{};  ///< energy of all contributors of each pixel [Pa^2]; empty if read from a file

  /// Returns true if contributors were not asked for.
  bool empty() const { return surfel.empty(); }
  /// Returns the index of the k-th strongest contributor of a pixel into the arrays.
  std::size_t at(std::size_t beam, std::size_t bin, std::size_t k = 0) const {
    return (beam * bins + bin) * per_pixel + k;
  }
};

/// Throws Error(argument) naming `who` unless every array has beams x bins x per_pixel entries and per_pixel is within
/// 1 and 255.
void require_valid(const Contributors& contributors, const char* who);

/// Returns the material of the strongest contributor of every pixel, beams x bins; no_material where there is none.
Grid<std::uint16_t> material_image(const Contributors& contributors);

/// Returns the id of the strongest contributor of every pixel, beams x bins; `none` where there is none.
Grid<std::uint32_t> id_image(const Contributors& contributors);

}  // namespace insonify
