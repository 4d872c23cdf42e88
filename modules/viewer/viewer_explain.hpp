// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "returns/contributors.hpp"
#include "sampling/seen_surfels.hpp"
#include "viewer/viewer_data.hpp"

namespace insonify {

/// One surfel that contributes energy to a sample.
struct Contribution {
  std::uint32_t surfel = 0;  ///< index in the scene of the ping
  std::uint32_t id = 0;
  std::string material;  ///< name of the material, or its number if the scene is missing
  double share = 0;      ///< fraction of the energy of all contributors
  double elevation = 0;  ///< elevation in head axes [rad]
  PathKind path = PathKind::direct;
  std::string part{};  ///< name of the part in a scene of parts
};

/// Visibility from the head of the surfels at a sample's position: those within the beam's cell of the fan, and within
/// half a surfel of the range bin.
struct PixelVisibility {
  std::vector<std::uint32_t> seen, hidden;  ///< surfels, by index in the scene
  std::size_t turned_away = 0;
  std::optional<double> occluder_range;          ///< range of the nearest surfel that hides one of `hidden` [m]
  std::optional<std::uint32_t> occluder_surfel;  ///< index of this surfel
};
/// Returns the visibility at a sample of a ping. `scene` is the scene of the ping; empty for an empty scene.
PixelVisibility look_at_pixel(const ViewerData& data, const SceneCloud& scene, const Ping& ping,
                              PixelPosition position);

/// Facts about one sample.
struct PixelFacts {
  PixelPosition position;
  std::int64_t ping_number = 0;
  double range = 0;                         ///< range of the bin's centre [m]
  double azimuth = 0;                       ///< azimuth of the beam [rad], positive to port
  std::optional<double> scan_angle;         ///< scan angle of a scanning head [rad], positive to port
  double elevation = 0;                     ///< elevation of the beam [rad]
  double level_db = 0;                      ///< level in `unit`
  std::string unit = "dB re 1 µPa";         ///< unit of sound, or that of a recording
  double compensated_level_db = 0;          ///< dB re 1 uPa at 1 m, range compensated (E20)
  std::vector<Contribution> contributions;  ///< strongest first; empty: none, or unknown
  bool contributions_known = false;
  bool unknown = false;                       ///< true: hole of the scan, surface may be missing here
  std::optional<PixelVisibility> visibility;  ///< empty: there is no scene
  std::string part;                           ///< in a scene of parts: the part of the pixel; empty: none
  std::string seen_material;                  ///< most frequent material of the visible surfels; empty: none visible
};
/// Throws Error(argument) if ping, beam or bin is not in the data.
PixelFacts find_pixel_facts(const ViewerData& data, std::size_t ping, PixelPosition position);

/// Returns the facts in sentences, one per line; bearings are positive to starboard, angles in degrees.
std::string explain_pixel(const PixelFacts& facts);

/// Returns the surfels to highlight for a sample: its contributors, or, if unknown, the visible surfels at its
/// position.
std::vector<std::uint32_t> surfels_behind(const PixelFacts& facts);

/// Returns the sample that contains a point of the world: its beam (nearest in azimuth, then in elevation) and its bin.
/// Returns nothing outside fan and gate.
std::optional<PixelPosition> position_of(const Ping& ping, const Eigen::Vector3d& world_position);

/// Visibility of a scene from a head, without simulating a ping.
struct HeadView {
  std::vector<Visibility> visibility;  ///< per surfel
  std::size_t seen = 0, hidden = 0, turned_away = 0, outside = 0;
  double nearest = 0, farthest = 0;     ///< range of the visible surfels [m]; 0, 0: none
  std::size_t rays = 0, rays_open = 0;  ///< 16 per beam; rays_open: hit neither a surface nor a hole
  std::vector<Eigen::Vector3d> holes;   ///< holes of the scan found by the rays, world [m]
};
/// Returns the visibility of a scene from a head, with the sampling of `view`.
HeadView look_from(const SceneCloud& scene, const View& view);

/// Returns the view in sentences, one per line, with the corresponding option --pose.
std::string explain_view(const HeadView& view, const ViewerState& state);

/// Returns the description of one surfel: material, id, position, area, range, bearing (positive to starboard),
/// incidence, visibility. Throws Error(argument) if it is not in the scene.
std::string explain_surfel(const SceneCloud& scene, const HeadView& view, const PoseAngles& head, std::uint32_t surfel);

}  // namespace insonify
