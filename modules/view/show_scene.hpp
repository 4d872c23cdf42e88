#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "returns/soundings.hpp"
#include "sampling/beam_fan.hpp"
#include "sampling/range_gate.hpp"
#include "sampling/seen_surfels.hpp"
#include "scene/scene_cloud.hpp"
#include "view/picture.hpp"

namespace insonify {

/// What the colour of a surfel says.
enum class SceneColour {
  height,      ///< world z [m]
  material,    ///< one colour per material, with their names
  visibility,  ///< what the head sees of it
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

/// From where a scene is looked at.
enum class ScenePreset {
  automatic,  ///< `behind` if there is a head, else `iso`
  behind,     ///< behind the head and above it, along its heading; port is on the left
  top,        ///< from above, world x to the right and y up
  side,       ///< from starboard of the head, forward to the right; without a head along world y, x to the right
  iso         ///< from above a corner, between -x and -y
};
struct SceneCamera {
  ScenePreset preset = ScenePreset::automatic;
  std::optional<Eigen::Vector3d> position, focal_point;  ///< [m, world]; both or neither, instead of the preset
};

/// What is drawn of a scene, and how. Empty means: not drawn, or not known.
struct SceneLook {
  SceneColour colour = SceneColour::height;
  std::vector<float> level_db;             ///< per surfel; NaN: none, drawn grey
  std::string level_unit = "dB re 1 µPa";  ///< of level_db and of the soundings
  std::vector<Visibility> visibility;      ///< per surfel, see find_visibility
  std::optional<SceneHead> head;           ///< body, axes, edges and arcs of its fan, footprint on the
      ///< scene: of the elevation width, narrower than what find_visibility looks at
  Soundings soundings;                     ///< points in the colour of their level
  std::vector<std::uint32_t> highlighted;  ///< surfels marked, in front of everything
  std::vector<Eigen::Vector3d> holes;      ///< where the scan has holes [m, world], see find_holes: red points
  bool normals = false;                    ///< of some 4000 surfels, as lines; of both sides if they have none
  SceneCamera camera;
  double point_size = 1.4;               ///< side of a drawn surfel in units of its spacing sqrt(area)
  bool axes = true;                      ///< box and floor grid, labelled in world metres
  std::size_t most_surfels = 2'000'000;  ///< a larger scene is drawn thinned, evenly; 0: draw all
};

/// Draws a scene in perspective into a PNG, without an X server: surfels as squares of their own size, shaded by their
/// normals where the colour leaves room for it (height, material, visibility), with colour bar or legend, axes and title.
/// Levels and angles are in exactly the colours of their bar. Up is world z, up in the picture (`top`: world y).
///
/// options.colour_map, min_db, max_db and window_db are those of levels; heights and angles are in viridis.
/// Above look.most_surfels the surfels drawn are chosen by their ids alone and grow to close the gaps. Positions are
/// drawn relative to scene.origin: a scene in UTM coordinates looks as it does at zero. Two renderings on one machine
/// have the same bytes.
///
/// Written to a temporary name, then renamed. Throws Error(content) for a scene without surfels; Error(argument) if
/// level_db or visibility have another length than the scene, a highlighted surfel is not in it, grazing or incidence is
/// asked for without a head, visibility without `visibility`, half a camera is given, point_size is not positive, or as show_fan
/// does for picture options; Error(runtime) and Error(file) as show_fan.
void show_scene(const SceneCloud& scene, const SceneLook& look, const PictureOptions& options,
                const std::string& png_path);

}  // namespace insonify
