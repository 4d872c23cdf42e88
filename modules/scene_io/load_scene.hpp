// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "returns/soundings.hpp"
#include "scene/material_field.hpp"
#include "scene/scene_cloud.hpp"
#include "scene/scene_mesh.hpp"
#include "scene_io/scene_columns.hpp"

namespace insonify {

/// What a file does not say of itself, and how it is completed.
struct LoadOptions {
  std::optional<Eigen::Vector3d> viewpoint;  ///< where the capture stood [m, world]; orients normals without sides
  int normal_neighbours = 32;                ///< for the planes of estimated normals
  double mesh_spacing = 0;                ///< [m] between surfels of a mesh or height field; 0: see LoadedScene::mesh
  double unit = 1;                        ///< metres per unit of the file, e.g. 0.001 for millimetres
  std::vector<Material> materials;        ///< by label, or by name if the file names its own and one of these has
                                          ///< that name; empty: those in the file, else a default one per label
  std::optional<std::uint16_t> material;  ///< gives every surfel this index into the materials
  std::uint64_t seed = 1;                 ///< of mesh sampling
  int threads = 0;                        ///< 0: all cores
  /// Standard deviation of the scan across its surfaces [m], of all points of a cloud; a `noise` field of the file
  /// wins. Empty: estimated, unless the file is a prepared one. Meshes and tiles have none.
  std::optional<double> scan_noise{};
  bool keep_strays = false;        ///< points far from all others keep the areas that are estimated of them
  bool keep_columns = false;       ///< read the columns that a scene makes no use of, too
  MaterialField material_field{};  ///< which scalar field says the material, and how; unused with `material`
};

/// What was in the file and what was done to it. Everything dropped or repaired is counted here.
struct LoadReport {
  std::string path, format;  ///< e.g. "PCD binary_compressed", "PLY binary_big_endian mesh"
  std::size_t points_read = 0;
  std::size_t triangles_read = 0;
  std::size_t dropped_not_finite = 0;      ///< points with NaN, infinite or absurd (> 1e9 m) coordinates
  std::size_t dropped_withheld = 0;        ///< points that a LAS file marks as withheld
  std::size_t dropped_duplicates = 0;      ///< points at exactly the place of an earlier one
  std::size_t dropped_degenerate = 0;      ///< triangles without area, polygons with bad indices
  std::size_t repaired_normals = 0;        ///< zero or NaN normals replaced by estimates
  std::size_t dropped_without_normal = 0;  ///< points whose normal could not be estimated
  bool normals_estimated = false;
  bool areas_estimated = false;
  bool noise_estimated = false;
  std::size_t strays = 0;  ///< points far from all others, whose areas were cut down unless options.keep_strays
  bool materials_found = false;
  std::optional<Eigen::Vector3d> viewpoint;  ///< used to orient the normals
  std::vector<std::string> notes;            ///< sentences for the user: hints, assumptions, suspicions
  std::string material_field;                ///< as the file calls it; empty: none was read
  std::vector<std::string> other_columns{};  ///< of the file, of which the scene makes no use
  std::size_t outside_intervals = 0;         ///< surfels, or corners of a mesh, whose number lies in no interval
};

/// Result of load_scene.
struct LoadedScene {
  SceneCloud scene;
  LoadReport report;
  /// Without mesh_spacing: of a mesh, of which `scene` is a sample of about 200 000 surfels for an overview, or the
  /// surface of a height field, of which `scene` has the points. A ping samples it by what its head resolves
  /// (mesh_surfels). A height field is a cloud without areas of which 98 % of the points have one height each, or whose
  /// points stand on a grid along x and y and most show no noise (raster_triangles, height_triangles), and whose
  /// normals look up, or down, if it has any: they are those of the mesh. Noisy points are joined at smoothed_heights.
  std::optional<SceneMesh> mesh{};
  SceneColumns
      columns{};  ///< of the surfels, with options.keep_columns; of a sampled mesh those of the nearest corners
  SceneColumns corner_columns{};  ///< the same of the corners of a file's mesh
};

/// Extensions of the files that load_scene reads: ".pcd .ply .obj ...", separated by spaces, for messages and help.
std::string scene_extensions();

/// Reads a cloud or mesh by its extension, one of scene_extensions(), fields by name and type. Clouds without normals
/// get estimated ones (PCL), oriented to the viewpoint given or stored in the file, else to the origin if rows and
/// columns of an organised cloud fan out from there, else up if they are a raster of heights, else two-sided; without
/// areas, estimated ones (E15, E69; E73 for an organised cloud with a viewpoint); without noise, estimated noise (E67),
/// raised where a line of sight of an organised cloud with a viewpoint proves that a surfel hides nothing. Meshes are
/// sampled, area-preserving and stratified; their normals are the file's, else follow the winding, two-sided if more
/// than 1 % of the shared edges contradict it. Ids are the file's if unique, else row numbers (meshes: sample numbers).
/// Materials are those of a label field (whole numbers, as integers or floats), or of intervals of any scalar field;
/// numbers in no interval, NaN among them, get one more material, "outside", of the default Lambert coefficient, and
/// are counted. A surfel of a mesh takes the material of its nearest corner. Error(content) lists the file's fields if
/// it has none of the name asked for. A .tiles file is loaded whole and as it is: options do not change it. Coordinates
/// may be float or double; the centre of the bounding box, in whole metres, becomes the origin. Throws Error(file) if
/// missing or unreadable; Error(content) if it is not what its name says, is cut off, or holds no usable point: always
/// naming the file and what to do.
LoadedScene load_scene(const std::string& path, const LoadOptions& options = {});

/// Reads soundings from a .ply that save_soundings wrote: positions in double, everything else bit for bit. Throws
/// Error(file) if it is missing or unreadable; Error(content) if it is truncated, not a binary PLY, or lacks a column,
/// naming it.
Soundings load_soundings(const std::string& path);

/// Soundings of a survey, when they were sent [s] and by which head of the mission, from 0; both empty of a single run.
struct SurveyReturns {
  Soundings soundings;
  std::vector<double> time{};
  std::vector<std::uint32_t> head{};
};
/// Reads soundings with the columns that save_survey_returns adds, one file after the other; errors as load_soundings.
SurveyReturns load_survey_returns(const std::vector<std::string>& paths);

}  // namespace insonify
