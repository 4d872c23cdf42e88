// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "acoustics/multipath_echoes.hpp"
#include "returns/contributors.hpp"
#include "returns/soundings.hpp"
#include "scene/scene_cloud.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"
#include "viewer/lazy_pings.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify {

/// The public call that errors of the viewer name.
inline constexpr const char* viewer_caller = "show_viewer";

/// Data of the viewer. Of a run: pings, and the other members as far as available. To inspect: scene, fan and gate.
struct ViewerData {
  std::string title;
  std::string recorded_unit{};              ///< of levels of a recording, "dB re full scale"; empty: those of sound
  LazyPings pings;                          ///< all with the same fan and gate
  std::vector<Contributors> contributors;   ///< one per ping, empty if unknown; or no elements
  std::vector<std::string> material_names;  ///< by index, for contributors if the scene is missing
  Soundings returns;                        ///< of all pings; unused if `pings` has returns of its own
  SceneCloud scene;                         ///< of all pings; may be empty
  /// Of a scene whose parts stand elsewhere from ping to ping: that of a ping, the same object where it is the same, in
  /// place of `scene`; else empty. Surfels are numbered within it.
  std::function<std::shared_ptr<const SceneCloud>(std::size_t ping)> scene_of_ping{};
  BeamFan fan;               ///< to inspect
  RangeGate gate;            ///< to inspect
  std::optional<View> view;  ///< how a ping samples the scene (resolve_ping), wherever the head stands; or
                             ///< none: by fan and gate alone
};

/// What the first panel shows of a run.
enum class ViewerPicture {
  fan,       ///< the ping in true geometry
  sweep,     ///< of a scanning head of one beam: what its display shows, every bearing as it was heard last
  waterfall  ///< of another head of one beam: ping after ping
};
/// The picture that suits the head of a run.
ViewerPicture picture_of(const ViewerData& data);

/// Whether there is a scene.
bool has_scene(const ViewerData& data);
/// Returns the scene as it was when a ping was sent; of a scene of all pings, which must outlive it, without a copy.
std::shared_ptr<const SceneCloud> scene_at(const ViewerData& data, std::size_t ping);

/// Throws Error(content) unless there are pings, the first is valid, per-ping lists have one element per ping, and a
/// scene to inspect has surfels.
void require_viewable(const ViewerData& data, ViewerMode mode);

/// Returns where a head at `pose` with this fan and gate looks in the scene.
View view_at(const ViewerData& data, const Pose& pose, const BeamFan& fan, const RangeGate& gate);

/// The unit of levels, with the gain of range compensation or without.
std::string unit_of(const ViewerData& data, bool tvg);

/// Numbers of pings, beams and bins.
ViewerExtent extent_of(const ViewerData& data);

}  // namespace insonify
