#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "sampling/seen_surfels.hpp"
#include "viewer/viewer_data.hpp"

namespace insonify {

/// What a head would see of a scene, before anything is simulated.
struct HeadView {
  std::vector<Visibility> visibility;  ///< per surfel
  std::size_t seen = 0, hidden = 0, turned_away = 0, outside = 0;
  double nearest = 0, farthest = 0;     ///< range of the surfels that are seen [m]; 0, 0: none
  std::size_t rays = 0, rays_open = 0;  ///< 16 per beam; rays_open: meet nothing, and no hole of the scan
  std::vector<Eigen::Vector3d> holes;   ///< of the scan, where rays look into one: world [m]
};
HeadView look_from(const SceneCloud& scene, const BeamFan& fan, const RangeGate& gate, const HeadPlace& head);

/// The view in sentences, one per line, with the option --pose it belongs to.
std::string explain_view(const HeadView& view, const ViewerState& state);

/// One surfel as a head sees it: material, id, place, area, range, bearing (positive to starboard), incidence, visibility.
/// Throws Error(argument) if it is not in the scene.
std::string explain_surfel(const SceneCloud& scene, const HeadView& view, const HeadPlace& head, std::uint32_t surfel);

}  // namespace insonify
