#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "sampling/seen_surfels.hpp"
#include "viewer/viewer_data.hpp"

namespace insonify {

/// Visibility of a scene from a head, without simulating a ping.
struct HeadView {
  std::vector<Visibility> visibility;  ///< per surfel
  std::size_t seen = 0, hidden = 0, turned_away = 0, outside = 0;
  double nearest = 0, farthest = 0;     ///< range of the visible surfels [m]; 0, 0: none
  std::size_t rays = 0, rays_open = 0;  ///< 16 per beam; rays_open: hit neither a surface nor a hole
  std::vector<Eigen::Vector3d> holes;   ///< holes of the scan found by the rays, world [m]
};
HeadView look_from(const SceneCloud& scene, const View& view);

/// The view in sentences, one per line, with the corresponding option --pose.
std::string explain_view(const HeadView& view, const ViewerState& state);

/// Description of one surfel: material, id, position, area, range, bearing (positive to starboard), incidence,
/// visibility. Throws Error(argument) if it is not in the scene.
std::string explain_surfel(const SceneCloud& scene, const HeadView& view, const HeadPlace& head, std::uint32_t surfel);

}  // namespace insonify
