// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "acoustics/multipath_echoes.hpp"
#include "returns/contributors.hpp"
#include "returns/ping.hpp"
#include "returns/soundings.hpp"
#include "scene/scene_cloud.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify {

/// Reads pings by their index in a reel.
struct PingSource {
  std::function<Ping(std::size_t ping)> ping;
  /// Returns the pressure of one beam in `count` pings from the `first` on, pings x bins [Pa].
  std::function<ComplexGridF(std::size_t first, std::size_t count, std::size_t beam)> beam;
  std::function<Soundings(std::size_t ping)> returns;  ///< returns of one ping; empty: there are none
};

/// The pings that a viewer plays. The positions of all pings are known; images are read one at a time, so that memory
/// does not grow with their number. All pings have the fan and the gate of the first.
class LazyPings {
 public:
  LazyPings() = default;
  /// `source.ping` and `source.beam` must be given.
  LazyPings(std::vector<TrackPoint> positions, PingSource source);

  /// Returns the number of pings.
  std::size_t size() const { return positions_.size(); }
  /// Returns true if there is no ping.
  bool empty() const { return positions_.empty(); }
  /// Returns time and pose of ping `i`.
  const TrackPoint& position(std::size_t i) const { return positions_[i]; }
  /// Returns time and pose of all pings.
  const std::vector<TrackPoint>& positions() const { return positions_; }

  /// Returns the fan of every ping, read with the first one.
  const BeamFan& fan() const { return frame().fan; }
  /// Returns the range gate of every ping, read with the first one.
  const RangeGate& gate() const { return frame().gate; }
  /// Returns a ping; the last one stays in memory. Throws Error(content) for a ping that is invalid or differs from the
  /// first in fan or gate. Errors of the source propagate.
  std::shared_ptr<const Ping> ping(std::size_t i) const;
  /// Returns the pressure of one beam in some pings, pings x bins [Pa].
  ComplexGridF beam(std::size_t first, std::size_t count, std::size_t beam) const;
  /// Returns true if the source gives returns.
  bool has_returns() const { return static_cast<bool>(source_.returns); }
  /// Returns the returns of one ping; none if has_returns is false.
  Soundings returns(std::size_t i) const;

 private:
  struct Frame {
    BeamFan fan;
    RangeGate gate;
  };
  const Frame& frame() const;

  std::vector<TrackPoint> positions_;
  PingSource source_;
  mutable std::optional<Frame> frame_;
  mutable std::shared_ptr<const Ping> last_;
  mutable std::size_t last_index_ = 0;
};

/// Name of the public call in errors of the viewer.
inline constexpr const char* viewer_caller = "show_viewer";

/// Data of the viewer. For a run: pings, and the other members as far as available. To inspect: scene, fan and gate.
struct ViewerData {
  std::string title;
  std::string recorded_unit{};              ///< unit of levels of a recording, "dB re full scale"; empty: that of sound
  LazyPings pings;                          ///< pings with one fan and gate
  bool sides = false;                       ///< true: the two beams are the sides of a side-scan, port first
  std::vector<LazyPings> others{};          ///< pings of other heads, whose returns are gathered with those of `pings`
  std::string depth_datum{};                ///< datum of depths, "below z = 0"; empty: heights are shown, not depths
  std::vector<Contributors> contributors;   ///< contributors of each ping, empty if unknown; or no elements
  std::vector<std::string> material_names;  ///< names by index, for contributors if the scene is missing
  Soundings returns;                        ///< returns of all pings; unused if `pings` has returns of its own
  SceneCloud scene;                         ///< scene of all pings; may be empty
  /// For a scene whose parts differ from ping to ping: returns the scene of a ping, in place of `scene`. Equal scenes
  /// are the same object. Surfels are numbered within the scene of the ping. Otherwise empty.
  std::function<std::shared_ptr<const SceneCloud>(std::size_t ping)> scene_of_ping{};
  Pose vehicle_from_head = Pose::Identity();  ///< mounting of the head to inspect
  BeamFan fan;                                ///< fan to inspect
  RangeGate gate;                             ///< gate to inspect
  std::optional<View> view;  ///< sampling of the scene by a ping (resolve_ping), at any pose of the head;
                             ///< empty: sampling by fan and gate alone
};

/// Content of the first panel for a run.
enum class ViewerPicture {
  fan,        ///< the ping in true geometry
  sweep,      ///< for a scanning head of one beam: its display, with the latest samples of every bearing
  waterfall,  ///< for another head of one beam: ping after ping
  sides       ///< for both sides of a side-scan: ping after ping, port to the left
};
/// Returns the picture that suits the head of a run.
ViewerPicture picture_of(const ViewerData& data);

/// Returns true if there is a scene.
bool has_scene(const ViewerData& data);
/// Returns the scene at the time of a ping. A scene that is common to all pings is not copied and must outlive the
/// result.
std::shared_ptr<const SceneCloud> scene_at(const ViewerData& data, std::size_t ping);

/// Throws Error(content) unless there are pings, the first is valid, per-ping lists have one element per ping, and a
/// scene to inspect has surfels.
void require_viewable(const ViewerData& data, ViewerMode mode);

/// Returns the view of the scene for a head at `pose` with this fan and gate.
View view_at(const ViewerData& data, const Pose& pose, const BeamFan& fan, const RangeGate& gate);

/// Returns the pose of the vehicle of a head to inspect: the one that `ping` takes, which mounts the head.
PoseAngles vehicle_position(const ViewerData& data, const PoseAngles& head);

/// Returns the unit of levels, with or without range compensation.
std::string unit_of(const ViewerData& data, bool tvg);

/// Returns the numbers of pings, beams and bins.
ViewerExtent extent_of(const ViewerData& data);

}  // namespace insonify
