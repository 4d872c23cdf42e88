#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/grid.hpp"

namespace insonify {

/// How sound came from a contributor.
enum class PathKind : std::uint8_t { direct, one_bounce, two_bounces };

/// The strongest contributors of every pixel of a ping, structure of arrays. Entry (beam x bins + bin) x per_pixel + k is
/// the k-th strongest of a pixel; where a pixel has fewer, surfel is `none` and share 0. find_contributors makes it.
struct Contributors {
  static constexpr std::uint32_t none = 0xffffffff;
  static constexpr std::uint16_t no_material = 0xffff;

  std::size_t beams = 0, bins = 0, per_pixel = 0;
  std::vector<std::uint32_t> surfel;    ///< index in the scene
  std::vector<std::uint32_t> id;        ///< of the surfel, as the scene names it; `none` where there is none
  std::vector<float> share;             ///< of the energies of all contributors of the pixel, in [0, 1]
  std::vector<float> elevation;         ///< from which it is heard [rad], head axes; 0 where there is none
  std::vector<std::uint16_t> material;  ///< index into the scene's materials; `no_material` where there is none
  std::vector<PathKind> path;

  bool empty() const { return surfel.empty(); }
  std::size_t at(std::size_t beam, std::size_t bin, std::size_t k = 0) const {
    return (beam * bins + bin) * per_pixel + k;
  }
};

/// Throws Error(argument) naming `who` unless every array has beams x bins x per_pixel entries and per_pixel is within 1
/// and 255.
void require_valid(const Contributors& contributors, const char* who);

/// Material of the strongest contributor of every pixel, beams x bins; no_material where there is none.
Grid<std::uint16_t> material_image(const Contributors& contributors);

/// Id of the strongest contributor of every pixel, beams x bins; none where there is none.
Grid<std::uint32_t> instance_image(const Contributors& contributors);

}  // namespace insonify
