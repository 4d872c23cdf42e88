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
/// normal_x ... as in PCL), followed by further columns. Comment lines hold the origin, the materials (name and
/// numbers) and whether normals are oriented. load_scene restores the scene without estimating anything.
///
///   .ply   coordinates are double if the origin is not zero. They read back within a nanometre (for an origin of
///          5000 km), everything else bit for bit.
///   .pcd   coordinates are float32. A scene beyond 2000 m from zero would lose more than 0.1 mm and must be a PLY.
///
/// The file is written to a temporary name, then renamed. Throws as require_valid; Error(argument) for another
/// extension or a scene too far from zero for PCD, Error(content) if the scene is empty, Error(file) if it cannot
/// write.
void save_scene(const std::string& path, const SceneCloud& scene, const SceneColumns& columns = {});

/// Writes a loaded scene so that later pings of the file equal pings of `loaded`. Points of a height field are written
/// at their heights on its surface, with a comment line that marks them, and in a .ply with the triangles between them.
/// A mesh is written as .ply with its triangles; a .pcd cannot hold triangles and gets the surfels of the overview.
/// Other scenes are written as by save_scene above, with the same errors.
void save_scene(const std::string& path, const LoadedScene& loaded);

/// Writes a mesh as .ply: corners with materials and, if present, normals, then triangles, and the comment lines of
/// save_scene. load_scene reads the mesh back bit for bit. Throws as require_valid; Error(argument) for another
/// extension, Error(content) if the mesh has no triangle, Error(file) if it cannot write.
void save_mesh(const std::string& path, const SceneMesh& mesh);

/// Writes only the points of a scene, x y z, as a scanner gives them. Formats and errors are those of save_scene.
void save_bare_points(const std::string& path, const SceneCloud& scene);

/// Writes soundings as .pcd or .ply, with units in comment lines, and returns the local origin [m]. The fields are x y
/// z level_db range azimuth elevation ping beam bin true_elevation true_surfel true_material.
///
///   .ply   fields are named scalar_level_db ..., so that CloudCompare shows them as scalar fields. x y z are world
///          coordinates in double; the origin is zero.
///   .pcd   all numbers are float32. Soundings beyond 2000 m from zero are relative to a local origin in whole hundreds
///          of metres. The VIEWPOINT of the file holds this origin as its translation, where pcl_viewer puts the cloud.
///          Nearer soundings have the origin zero. Further fields are intensity (level_db) and label (true_material).
///
/// The file is written to a temporary name, then renamed. Empty soundings give a file without points. Throws
/// Error(argument) for another extension or columns of different lengths, Error(file) if it cannot write.
Eigen::Vector3d save_soundings(const std::string& path, const Soundings& soundings);

/// Writes the soundings of one head of a survey as .ply: the columns of save_soundings, then scalar_time (double, time
/// of transmission [s]) and scalar_head (index of the head in the mission). Throws as save_soundings.
void save_survey_returns(const std::string& path, const Soundings& soundings, const std::vector<double>& time,
                         std::uint32_t head);

/// Joins binary .ply files with the same columns into one, in the order given. A few MB are in memory at a time. Throws
/// Error(argument) without parts, Error(file) if a part is missing or the file cannot be written, Error(content) for a
/// part that is damaged or has other columns than the first.
void join_clouds(const std::string& path, const std::vector<std::string>& parts);

/// Writes the scene with the coverage of its surfels by pings, by ascending id. The fields are those of a .pcd: x y z
/// normal_x normal_y normal_z level_db grazing_deg range hits material id. A .ply has normals nx ny nz, and
/// scalar_level_db ... from level_db on, for CloudCompare. Levels are dB re 1 uPa, ranges metres; level_db, grazing_deg
/// and range are NaN for surfels that no ping insonified. x y z are world coordinates: float in PCD, double in PLY
/// unless the scene's origin is zero. The file is written to a temporary name, then renamed. Throws Error(argument) for
/// another extension or a surfel of another scene, Error(file) if it cannot write.
void save_insonification(const std::string& path, const SceneCloud& scene, const std::vector<CoveredSurfel>& covered);

}  // namespace insonify
