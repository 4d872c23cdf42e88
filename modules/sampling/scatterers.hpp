// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace insonify {

/// Visible surface patches in head axes, structure of arrays, one entry per scatterer in every array.
struct Scatterers {
  std::vector<double> range;            ///< [m], one way
  std::vector<double> azimuth;          ///< [rad], positive to port
  std::vector<double> elevation;        ///< [rad], positive up
  std::vector<float> cos_incidence;     ///< cosine between normal and direction to the head, in [0, 1]
  std::vector<float> projected_area;    ///< area projected towards the head [m^2]: cos_incidence x surface area, or
                                        ///< range^2 x solid angle of a ray; never divided by the cosine
  std::vector<std::uint16_t> material;  ///< index into the scene's materials
  std::vector<std::uint64_t> id;        ///< SceneCloud::piece_id of surfel and part; fixed to it, and so is the speckle
  std::vector<std::uint32_t> surfel;    ///< index of the surfel in the SceneCloud

  /// Returns the number of scatterers.
  std::size_t size() const { return range.size(); }
};

/// Bounds of the parts of a surfel: all stand within `reach` of `range` [m], and within `reach_u` of the direction
/// cosine `u` along the array.
struct SurfelBounds {
  double range, reach, u, reach_u;
};

}  // namespace insonify
