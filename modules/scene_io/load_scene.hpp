// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "returns/soundings.hpp"
#include "scene/material_field.hpp"
#include "scene/meaning_override.hpp"
#include "scene/scene_cloud.hpp"
#include "scene/scene_mesh.hpp"
#include "scene_io/file_meaning.hpp"
#include "scene_io/scene_columns.hpp"

namespace insonify {

/// Facts that a file does not state, and settings for its completion.
struct LoadOptions {
  std::optional<Eigen::Vector3d> viewpoint;  ///< position of the capture [m, world]; orients normals without sides
  int normal_neighbours = 32;                ///< points in the plane of an estimated normal
  double mesh_spacing = 0;                ///< between surfels of a mesh or height field [m]; 0: see LoadedScene::mesh
  MeaningOverride meaning;                ///< units, axes and holes that the file does not state, or states wrongly
  std::vector<Material> materials;        ///< index is the label, or the name if the file has a material of this name.
                                          ///< Empty: the materials in the file, or a default one per label
  std::optional<std::uint16_t> material;  ///< gives every surfel this index into the materials
  std::uint64_t seed = 1;                 ///< seed of mesh sampling
  int threads = 0;                        ///< 0: all cores
  /// Standard deviation of the scan across its surfaces [m], for all points of a cloud; 0: none. A `noise` field of the
  /// file takes precedence. Empty: the noise is estimated, unless the file is a prepared one. Meshes and tiles have no
  /// noise. Heights of height fields that show noise are smoothed by at most 2.9 of it (E160), with a note.
  std::optional<double> scan_noise{};
  bool keep_strays = false;        ///< points far from all others keep their estimated areas
  bool keep_columns = false;       ///< also read the columns that a scene does not use
  MaterialField material_field{};  ///< the scalar field that gives the material, and its rule; unused with `material`
};

/// Contents of a file and changes made to them. Counts everything that was dropped or repaired.
struct LoadReport {
  std::string path, format;  ///< such as "PCD binary_compressed", "PLY binary_big_endian mesh"
  std::size_t points_read = 0;
  std::size_t triangles_read = 0;
  std::size_t dropped_not_finite = 0;      ///< points with NaN, infinite or absurd (> 1e9 m) coordinates
  std::size_t dropped_withheld = 0;        ///< points that a LAS file marks as withheld
  std::size_t dropped_classes = 0;         ///< points of classes that are not read, in LAS also noise
  std::size_t dropped_duplicates = 0;      ///< points at exactly the position of an earlier one
  std::size_t dropped_degenerate = 0;      ///< triangles without area, polygons with bad indices
  std::size_t repaired_normals = 0;        ///< zero or NaN normals replaced by estimates
  std::size_t dropped_without_normal = 0;  ///< points whose normal could not be estimated
  bool normals_estimated = false;
  bool areas_estimated = false;
  bool noise_estimated = false;
  std::size_t strays = 0;  ///< points far from all others, whose areas were cut down unless options.keep_strays
  bool materials_found = false;
  std::optional<Eigen::Vector3d> viewpoint;  ///< viewpoint used to orient the normals
  std::vector<std::string> notes;            ///< sentences for the user: hints, assumptions, suspicions
  std::string material_field;                ///< name in the file; empty: none was read
  std::vector<std::string> other_columns{};  ///< columns of the file that the scene does not use
  std::size_t outside_intervals = 0;         ///< surfels, or corners of a mesh, whose number lies in no interval
  FileMeaning meaning{};                     ///< meaning of the numbers of the file, as applied
};

/// Result of load_scene.
struct LoadedScene {
  SceneCloud scene;
  LoadReport report;
  /// The surface that pings sample as finely as their head resolves (mesh_surfels). Empty with mesh_spacing. For a mesh
  /// file, this is the mesh, and `scene` is a sample of about 200 000 surfels for an overview. For a height field, this
  /// is the surface between the points of `scene`, with noisy points at smoothed_heights.
  ///
  /// A cloud is a height field if it has no areas and meets one of two conditions: 98 % of its points have one height
  /// each, or its points stand on a grid along x and y and most show no noise (raster_triangles, height_triangles). If
  /// it has normals, they must look up, or all down; they become the normals of the mesh.
  std::optional<SceneMesh> mesh{};
  SceneColumns
      columns{};  ///< with options.keep_columns: columns of the surfels, for a sampled mesh of the nearest corners
  SceneColumns corner_columns{};  ///< columns of the corners of a file's mesh
};

/// Returns the extensions that load_scene reads, separated by spaces, for messages and help: ".pcd .ply .obj ...".
std::string scene_extensions();

/// Returns the scene in a cloud or mesh file. The extension, one of scene_extensions(), selects the reader; fields are
/// found by name and type.
///
///   normals     of a cloud: those of the file, else estimates (PCL). Estimates are oriented to the viewpoint that is
///               given or stored in the file; else to the origin if rows and columns of an organised cloud fan out from
///               there; else up if the cloud is a raster of heights; else they are two-sided.
///   areas       of a cloud: those of the file, else estimates (E15, E69; E73 for an organised cloud with a viewpoint)
///   noise       of a cloud: that of the file, else estimates (E67), raised where a line of sight of an organised cloud
///               with a viewpoint proves that a surfel hides nothing
///   meshes      are sampled, area-preserving and stratified. Their normals are those of the file, else they follow the
///               winding, and are two-sided if more than 1 % of the shared edges contradict it.
///   ids         those of the file if unique, else row numbers (meshes: sample numbers)
///   materials   those of a label field (whole numbers, as integers or floats), or of intervals of any scalar field.
///               Numbers in no interval, including NaN, are counted and get one more material, "outside", with the
///               default Lambert coefficient. A surfel of a mesh takes the material of its nearest corner.
///   origin      the centre of the bounding box in whole metres; coordinates may be float or double
///
/// A .tiles file is loaded whole and unchanged by the options. Throws Error(file) if the file is missing or unreadable.
/// Throws Error(content) if it is not what its name says, is cut off, holds no usable point, or lacks the field asked
/// for; the message then lists its fields. Every message names the file and the remedy.
LoadedScene load_scene(const std::string& path, const LoadOptions& options = {});

/// Returns the soundings in a .ply that save_soundings wrote: positions in double, everything else bit for bit. Throws
/// Error(file) if the file is missing or unreadable; Error(content) if it is truncated, not a binary PLY, or lacks a
/// column, naming it.
Soundings load_soundings(const std::string& path);

/// Soundings of a survey with the time of transmission [s] and the index of the mission's head, from 0. Both lists are
/// empty for a single run.
struct SurveyReturns {
  Soundings soundings;
  std::vector<double> time{};
  std::vector<std::uint32_t> head{};
};
/// Returns the soundings of several files, one after the other, with the columns that save_survey_returns adds. Throws
/// as load_soundings.
SurveyReturns load_survey_returns(const std::vector<std::string>& paths);

}  // namespace insonify
