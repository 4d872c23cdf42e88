#pragma once
#include <string>

#include "returns/insonification.hpp"
#include "returns/soundings.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Writes a prepared scene as binary .ply (x y z nx ny nz area material id) or .pcd (the same, normals named
/// normal_x ... as PCL expects). Origin, materials (name and numbers) and whether normals have sides stand in
/// comment lines of both. PLY coordinates are double when the origin is not zero: load_scene gives back the same
/// scene without estimating anything, coordinates within a nanometre (an origin of 5000 km), all else bit by bit.
/// PCD coordinates are float32: a scene that reaches beyond 2000 m from zero, where more than 0.1 mm would be lost,
/// must be a PLY. Written to a temporary name, then renamed.
/// Throws as require_valid; Error(argument) for another extension or a scene too far for PCD, Error(content) if it
/// is empty, Error(file) if it cannot be written.
void save_scene(const std::string& path, const SceneCloud& scene);

/// Writes soundings as .pcd (fields x y z level_db range azimuth elevation ping beam bin material) or .ply (the same,
/// named scalar_level_db ..., so that CloudCompare shows them as scalar fields). x y z are world coordinates: float in
/// PCD, double in PLY. Written to a temporary name, then renamed. No soundings make a file with no points.
/// Throws Error(argument) for another extension or columns of different lengths, Error(file) if it cannot be written.
void save_soundings(const std::string& path, const Soundings& soundings);

/// Writes the scene with what pings heard of it as .pcd (fields x y z normal_x normal_y normal_z level_db grazing_deg range
/// hits material id) or .ply (normals nx ny nz, from level_db on named scalar_level_db ..., as CloudCompare shows them).
/// Levels are dB re 1 uPa, ranges metres; level_db, grazing_deg and range are NaN where nothing was heard. x y z are world
/// coordinates: float in PCD, double in PLY unless the scene's origin is zero. Written to a temporary name, then renamed.
/// Throws Error(argument) for another extension or a map of another scene, Error(file) if it cannot be written.
void save_insonification(const std::string& path, const SceneCloud& scene, const Insonification& map);

}  // namespace insonify
