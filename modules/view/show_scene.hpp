// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "returns/soundings.hpp"
#include "sampling/seen_surfels.hpp"
#include "scene/scene_cloud.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"
#include "view/picture.hpp"

namespace insonify {

/// The quantity shown by the colour of the surfels.
enum class SceneColour {
  height,      ///< world z [m]
  material,    ///< one colour per material, with a legend
  part,        ///< one colour per part of a scene of parts, with a legend; other scenes: see material
  visibility,  ///< visible, hidden, turned away or outside the fan
  level,       ///< [dB]
  grazing,     ///< angle between the surface and the ray from the head [deg]
  incidence    ///< angle between the normal and the ray from the head [deg]
};

/// A sonar head in the scene.
struct SceneHead {
  Pose world_from_head = Pose::Identity();
  BeamFan fan;
  RangeGate gate;
};

/// Viewpoint of a picture of a scene.
enum class ScenePreset {
  automatic,  ///< with a head `behind`, looking down more steeply if that fills the picture better; else `iso`
  behind,     ///< behind the head and above it, along its heading; port is on the left
  top,        ///< seen from above, world x to the right and y up
  side,       ///< seen from starboard of the head, forward to the right; without a head along world y, x to the right
  iso         ///< seen from above a corner, between -x and -y
};

/// The contents and style of a picture of a scene. Empty members are not drawn.
struct SceneLook {
  SceneColour colour = SceneColour::height;
  std::vector<float> level_db;             ///< per surfel; NaN: unknown, drawn grey
  std::string level_unit = "dB re 1 µPa";  ///< unit of level_db and of the soundings
  std::vector<Visibility> visibility;      ///< per surfel, see find_visibility
  std::optional<SceneHead> head;           ///< body, axes, edges and arcs of its fan, and footprint on the scene;
  ///< drawn with the elevation width, which is narrower than the region of find_visibility
  std::vector<Eigen::Vector3d> track;      ///< track of the head [m, world]; a line
  Soundings soundings;                     ///< points coloured by level
  std::vector<std::uint32_t> highlighted;  ///< marked surfels, drawn in front of everything
  std::vector<Eigen::Vector3d> holes;      ///< holes of the scan [m, world], see find_holes; red points
  bool normals = false;                    ///< true: normals of some 4000 surfels, on both sides if not oriented
  ScenePreset camera = ScenePreset::automatic;
  double point_size = 1.4;               ///< side of a drawn surfel in units of its spacing sqrt(area)
  bool axes = true;                      ///< true: box and floor grid, labelled in world metres
  std::size_t most_surfels = 2'000'000;  ///< larger scenes are thinned evenly; 0: draw all
};

/// Draws a scene in perspective into a PNG, without an X server: surfels as squares of their own size, with colour bar
/// or legend, axes and title. Colours of height, material and visibility are shaded by the normals; those of levels and
/// angles are exactly the colours of the bar. World z points up in the picture (`top`: world y).
///
/// options.colour_map, min_db, max_db and window_db apply to levels; heights and angles use viridis. For scenes with
/// more than look.most_surfels surfels a subset is drawn, with larger squares to close the gaps; the ids alone select
/// the subset. Positions are drawn relative to scene.origin, so a scene in UTM coordinates looks the same as at zero.
/// Two renderings on one machine have the same bytes.
///
/// Written to a temporary name, then renamed. Throws Error(content) for a scene without surfels; Error(argument) if
/// level_db or visibility have another length than the scene, a highlighted surfel is not in it, the colour is grazing
/// or incidence without a head or visibility without `visibility`, point_size is not positive, or, as show_fan, for
/// picture options; Error(runtime) and Error(file) as show_fan.
void show_scene(const SceneCloud& scene, const SceneLook& look, const PictureOptions& options,
                const std::string& png_path);

}  // namespace insonify
