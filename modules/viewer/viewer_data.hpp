#pragma once
#include <string>
#include <vector>

#include "returns/contributors.hpp"
#include "returns/ping.hpp"
#include "returns/soundings.hpp"
#include "sampling/beam_fan.hpp"
#include "sampling/range_gate.hpp"
#include "scene/scene_cloud.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify {

/// What the viewer shows. Of a run: pings, and as much of the rest as there is. To inspect: scene, fan and gate.
struct ViewerData {
  std::string title;
  std::vector<Ping> pings;                  ///< all with the same fan and gate
  double absorption_db_per_m = 0;           ///< for range compensation
  std::vector<Contributors> contributors;   ///< one per ping, empty where not known; or none at all
  std::vector<std::string> material_names;  ///< by index, for contributors of a scene that is not there; or none
  Soundings returns;                        ///< of all pings
  SceneCloud scene;                         ///< may be empty
  BeamFan fan;                              ///< to inspect
  RangeGate gate;                           ///< to inspect
};

/// Throws Error(content) unless the pings have one fan and one gate that fit their samples, lists per ping are as many as
/// pings, and a scene to inspect has surfels.
void require_viewable(const ViewerData& data, ViewerMode mode);

/// What can be chosen in it.
ViewerExtent extent_of(const ViewerData& data);

}  // namespace insonify
