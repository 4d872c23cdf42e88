// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <span>
#include <vector>

#include "scene_io/load_scene.hpp"
#include "scene_io/raw_cloud_internal.hpp"

// Private to scene_io: conversion of a raw cloud to a scene.
namespace insonify {

/// Throws Error(argument) for invalid options. `who` names the caller.
void check_options(const LoadOptions& options, const char* who);

/// Returns the cleaned and completed scene of a raw cloud, with counts of the changes. This is all that load_scene does
/// after reading.
LoadedScene complete_scene(RawCloud raw, const LoadOptions& options);

/// Returns the report of a cloud before it is cleaned.
LoadReport begin_report(const RawCloud& raw);

/// Returns for each point the first index with exactly the same coordinates (its own if there is no earlier one).
/// Points that are not finite match no other point.
std::vector<std::uint32_t> first_at_same_position(std::span<const Eigen::Vector3f> points);

/// Returns unit normals of the points listed in `wanted`: normals of the plane fitted to the `neighbours` nearest
/// points (PCL), with the sign that faces `towards`; NaN where no plane can be fitted. Does not depend on `threads`.
std::vector<Eigen::Vector3f> estimate_normals(const std::vector<Eigen::Vector3f>& points,
                                              const std::vector<std::uint32_t>& wanted, int neighbours, int threads,
                                              const Eigen::Vector3f& towards = Eigen::Vector3f::Zero());

/// Note on estimated normals without a side.
inline constexpr const char* two_sided_note =
    "no normals in the file and no viewpoint known: the estimated normals are not oriented, so both sides of every "
    "surface reflect; give the viewpoint of the capture to orient them";

/// Turns each normal to the side from which its point was seen.
void face_viewpoints(RawCloud& raw);

/// Gives every point of `raw` a unit normal, drops points without one, and reports the changes.
void complete_normals(RawCloud& raw, const LoadOptions& options, LoadedScene& result);

/// Returns the largest area that one point of a cloud can have [m^2]: twice the square of its extent. Returns 1e18 for
/// fewer than four points and for files of save_scene.
double largest_area(const RawCloud& raw);

/// Sets the areas: those of the file where valid, else estimates (E15, E69, E73). Also refines estimated normals.
void complete_areas(RawCloud& raw, const LoadOptions& options, LoadReport& report);

/// Returns the triangles between the points of a raster of heights, seen from above. A cell of four nodes has two
/// triangles, divided along the diagonal that is shorter on the surface; a cell with a missing node has one. The result
/// is empty unless the points form a grid along x and y: each point within 2 % of a node, one point per node, and
/// points on a sixteenth of the nodes or more. The cells of the grid may have any shape.
std::vector<std::array<std::uint32_t, 3>> raster_triangles(std::span<const Eigen::Vector3f> points);

/// Returns false if the points of a sample (raster_sample) are already so close along x and y that a grid through them
/// has more than twenty nodes for each of the `points` of the cloud, which no raster has.
bool may_be_raster(std::span<const Eigen::Vector3f> sample, std::size_t points);
/// Returns the index of the k-th point of that sample, ascending with k; from `points` on there are no more. The steps
/// are uneven, since even ones may be those of the rows.
std::size_t raster_sample(std::size_t k, std::size_t points);

/// Returns the viewpoint of an organised cloud that does not state one and is not yet cleaned: the origin of its
/// coordinates, if rows and columns fan out from there. Empty for other clouds, and where the viewpoint is known.
std::optional<Eigen::Vector3d> viewpoint_by_rows(const RawCloud& raw);
/// Sets the viewpoint: that of the options, else that of the file, else viewpoint_by_rows with a note.
void find_viewpoint(RawCloud& raw, const LoadOptions& options, std::vector<std::string>& notes);
/// Note of info and reports for clouds that fan out from the origin.
inline constexpr const char* fans_out_note =
    "rows and columns fan out from 0,0,0: taken as seen from there; give the viewpoint if it was another";
/// Note of info and reports for rasters of heights without a viewpoint.
inline constexpr const char* looks_up_note =
    "a raster of heights: its surface looks up; give the viewpoint if it was seen from below";

/// Returns true if a cloud without a viewpoint is a raster of heights, whose surface looks up. The format may say so.
/// Otherwise raw.raster decides, except for an organised cloud in one plane, which may be a picture of a wall.
bool looks_up(const RawCloud& raw);

/// Returns true if the rows and columns of an organised cloud, not yet cleaned, fan out from the origin of its
/// coordinates. They do if the directions from there to neighbouring points are even where the points themselves are
/// not. Returns false where this cannot be decided, as on smooth surfaces.
bool fans_out_from_origin(const RawCloud& raw);

/// Facts about a cloud without normals that is completed in groups of neighbours.
struct GroupCompletion {
  LoadOptions options;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< origin of the whole cloud [m]
  std::optional<Eigen::Vector3d> viewpoint;          ///< [m]
  bool areas = true, noise = true;                   ///< false: they are known
};

/// Sets normals, areas and noise of a group, as complete_scene does for a cloud that is no raster and no single view. A
/// point whose normal cannot be estimated looks up.
void complete_group(const GroupCompletion& how, SceneCloud& group);

/// Sets the noise: that of the file, else that of the options, else an estimate (E67).
void complete_noise(const RawCloud& raw, const LoadOptions& options, LoadedScene& result);
/// Returns the note on values of noise that are taken as 0.
std::string bad_noise_note(std::size_t bad, std::size_t points);

/// Scales usable normals to unit length unless save_scene wrote them (`prepared`). Returns the number whose length was
/// off by more than 1e-3.
std::size_t renormalise(std::vector<Eigen::Vector3f>& normals, bool prepared);
/// Reverses normals that look down.
void turn_up(std::vector<Eigen::Vector3f>& normals);
/// Returns true if the normal is finite and not zero.
bool usable_normal(const Eigen::Vector3f& normal);

/// Returns the reason why the labels of a cloud cannot be indices into the table of materials (without a table: "label
/// 0", "label 1", ...), and the remedy; empty if they can. `largest` is the largest label.
std::string label_problem(const RawCloud& raw, const std::vector<Material>& table, std::uint16_t largest);

/// Sets the table of materials: the caller's, the file's, or a default material per label. Converts the labels in
/// result.scene.material to indices into it.
void complete_materials(const RawCloud& raw, const LoadOptions& options, LoadedScene& result);

/// Drops points that are unused or coincide with an earlier point. Returns the number of the latter.
std::size_t drop_unusable(RawCloud& raw);

/// Drops all points not listed in `keep` (ascending).
void keep_points(RawCloud& raw, const std::vector<std::uint32_t>& keep);

/// Sets raw.surface to the surface between the points of a height field: the triangles of a raster, or those of the
/// plan if there is no raster.
void set_surface(std::span<const Eigen::Vector3f> points, std::vector<std::array<std::uint32_t, 3>> raster, int threads,
                 RawCloud& raw);

/// If raw.surface is not empty, makes it the mesh of the completed cloud. With options.mesh_spacing, samples it instead
/// and replaces the points.
void add_surface(RawCloud& raw, const LoadOptions& options, LoadedScene& result);

/// Samples a mesh: fills points, normals, areas, labels and ids of result.scene, and the report; columns of the corners
/// become columns of the surfels.
void sample_mesh(RawCloud& mesh, const LoadOptions& options, LoadedScene& result);

/// Returns warnings about doubtful coordinates, each with a remedy. `spacing` is the typical spacing of the cloud [m].
std::vector<std::string> doubts_about(const RawCloud& raw, double spacing);

/// Adds a note if the total area is zero: such a scene reflects no sound.
void note_no_area(double total_area, std::vector<std::string>& notes);

/// Returns a text such as "12 of 3400 points (0.4 %)".
std::string share(std::size_t part, std::size_t whole, const char* noun);

}  // namespace insonify
