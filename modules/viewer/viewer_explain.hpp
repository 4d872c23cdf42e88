#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "returns/contributors.hpp"
#include "viewer/viewer_data.hpp"

namespace insonify {

/// One surfel that sent energy into a sample.
struct Contribution {
  std::uint32_t surfel = 0;  ///< index in the scene
  std::uint32_t id = 0;
  std::string material;  ///< its name, or its number if the scene is not there
  double share = 0;      ///< of the energies of all contributors
  double elevation = 0;  ///< [rad], head axes
  PathKind path = PathKind::direct;
};

/// How the head sees what stands at a sample's place: its beam's share of the fan, its range bin or within half a surfel
/// of it.
struct PixelVisibility {
  std::vector<std::uint32_t> seen, hidden;  ///< surfels, by index in the scene
  std::size_t turned_away = 0;
  std::optional<double> occluder_range;          ///< [m], of the nearest surfel that hides one of `hidden`
  std::optional<std::uint32_t> occluder_surfel;  ///< its index
};
PixelVisibility look_at_pixel(const SceneCloud& scene, const Ping& ping, PixelPlace place);

/// What is known about one sample.
struct PixelFacts {
  PixelPlace place;
  std::int64_t ping_number = 0;
  double range = 0;                         ///< of the bin's centre [m]
  double azimuth = 0;                       ///< of the beam [rad], positive to port
  double elevation = 0;                     ///< of the beam [rad]
  double level_db = 0;                      ///< dB re 1 uPa
  double compensated_level_db = 0;          ///< dB re 1 uPa at 1 m, range compensated (E20)
  std::vector<Contribution> contributions;  ///< strongest first; empty: none, or not known
  bool contributions_known = false;
  double level_error_db = std::numeric_limits<double>::quiet_NaN();  ///< of the sampling; NaN: not known
  bool unknown = false;                       ///< surface may be missing here: a hole of the scan, not open water
  std::optional<PixelVisibility> visibility;  ///< if there is a scene
  std::string seen_material;                  ///< of most of the surfels that are seen there; empty: none is
};
/// Throws Error(argument) if ping, beam or bin is not in the data.
PixelFacts find_pixel_facts(const ViewerData& data, std::size_t ping, PixelPlace place);

/// The facts in sentences, one per line: bearings positive to starboard, angles in degrees.
std::string explain_pixel(const PixelFacts& facts);

/// Surfels to highlight for a sample: its contributors, or, if these are not known, what is seen at its place.
std::vector<std::uint32_t> surfels_behind(const PixelFacts& facts);

/// The sample in which a point of the world is heard: its beam (nearest in azimuth, then in elevation) and its bin. None
/// outside fan and gate.
std::optional<PixelPlace> place_of(const Ping& ping, const Eigen::Vector3d& world_position);

}  // namespace insonify
