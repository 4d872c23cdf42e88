// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "returns/coverage.hpp"
#include "returns/soundings.hpp"
#include "scene/scene_cloud.hpp"
#include "scene_io/load_scene.hpp"

namespace insonify {

/// Writes a prepared scene as binary .ply (x y z nx ny nz area material id) or .pcd (the same, with normals named
/// normal_x ... as in PCL), and further columns. Comment lines hold the origin, the materials (name and numbers) and
/// whether normals are oriented. PLY coordinates are double if the origin is not zero: load_scene restores the scene
/// without estimating anything, coordinates within a nanometre (for an origin of 5000 km), everything else bit for bit.
/// PCD coordinates are float32: a scene beyond 2000 m from zero, which would lose more than 0.1 mm, must be a PLY.
/// Written to a temporary name, then renamed. Throws as require_valid; Error(argument) for another extension or a scene
/// too far from zero for PCD, Error(content) if it is empty, Error(file) if it cannot write.
void save_scene(const std::string& path, const SceneCloud& scene, const SceneColumns& columns = {});

/// Writes a loaded scene so that it is pinged as before: points of a height field, at their heights on its surface,
/// with a
/// comment line that says that they are, and in a .ply the triangles between them; a mesh as .ply, with its triangles;
/// a mesh as .pcd, which has no place for them, as the surfels of its overview. Otherwise as above.
void save_scene(const std::string& path, const LoadedScene& loaded);

/// Writes a mesh as .ply: corners with their materials and normals, if it has any, triangles, and the same comment lines;
/// load_scene reads them back bit for bit. Throws as require_valid; Error(argument) for another extension,
/// Error(content) if it has no triangle, Error(file) if it cannot write.
void save_mesh(const std::string& path, const SceneMesh& mesh);

/// Writes the points of a scene alone, as a scanner gives them: x y z, as save_scene in all else.
void save_bare_points(const std::string& path, const SceneCloud& scene);

/// Writes soundings as .pcd (fields x y z level_db range azimuth elevation ping beam bin true_elevation true_surfel
/// true_material) or .ply (the same,
/// named scalar_level_db ..., so that CloudCompare shows them as scalar fields), with units in comment lines. x y z are
/// world coordinates, in PLY double. A PCD is float32: of soundings beyond 2000 m from zero they count from a local
/// origin in whole hundreds of metres, which is the translation of the VIEWPOINT (where pcl_viewer puts the cloud) and
/// is
/// returned [m]; zero otherwise. It also has intensity (level_db) and label (true_material). Written to a temporary
/// name, then renamed. Empty soundings give a file without points. Throws Error(argument) for another extension or
/// columns of different lengths, Error(file) if it cannot write.
Eigen::Vector3d save_soundings(const std::string& path, const Soundings& soundings);

/// Writes the soundings of one head of a survey as .ply: the columns of save_soundings, then scalar_time (double, when
/// the ping was sent [s]) and scalar_head (its index in the mission). Throws as save_soundings.
void save_survey_returns(const std::string& path, const Soundings& soundings, const std::vector<double>& time,
                         std::uint32_t head);

/// Makes one .ply of binary ones with the same columns, in the order given; holds a few MB of them at a time. Throws
/// Error(argument) without parts, Error(file) for one that is missing or if it cannot write, Error(content) for one
/// that is damaged or has other columns than the first.
void join_clouds(const std::string& path, const std::vector<std::string>& parts);

/// Writes the scene with what pings did to its surfels, by ascending id, as .pcd (fields x y z normal_x normal_y
/// normal_z level_db grazing_deg range hits material id) or .ply (normals nx ny nz, from level_db on named
/// scalar_level_db ..., for CloudCompare). Levels are dB re 1 uPa, ranges metres; level_db, grazing_deg and range are
/// NaN for surfels never insonified. x y z are world coordinates: float in PCD, double in PLY unless the scene's origin
/// is zero. Written to a temporary name, then renamed. Throws Error(argument) for another extension or a surfel of
/// another scene, Error(file) if it cannot write.
void save_insonification(const std::string& path, const SceneCloud& scene, const std::vector<CoveredSurfel>& covered);

}  // namespace insonify
