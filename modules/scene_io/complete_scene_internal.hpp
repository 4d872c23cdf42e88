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

/// Cleans and completes a raw cloud and counts the changes: everything load_scene does after reading.
LoadedScene complete_scene(RawCloud raw, const LoadOptions& options);

/// What a report says of a cloud before it is cleaned.
LoadReport begin_report(const RawCloud& raw);

/// For each point the first index with exactly the same coordinates (its own if there is no earlier one).
/// Points that are not finite match no other.
std::vector<std::uint32_t> first_at_same_place(std::span<const Eigen::Vector3f> points);

/// Unit normals of the points listed in `wanted`, from the plane fitted to the `neighbours` nearest points (PCL); the
/// sign is arbitrary, NaN where no plane can be fitted. Does not depend on `threads`.
std::vector<Eigen::Vector3f> estimate_normals(const std::vector<Eigen::Vector3f>& points,
                                              const std::vector<std::uint32_t>& wanted, int neighbours, int threads);

/// Gives every point of `raw` a unit normal, drops points without one, and reports the changes.
void complete_normals(RawCloud& raw, const LoadOptions& options, LoadedScene& result);

/// The largest area that one point of a cloud can have [m^2]: twice the square of its extent; 1e18 of fewer than four
/// points and of what save_scene wrote.
double largest_area(const RawCloud& raw);

/// Uses the file's areas where valid, else estimates them (E15, E69, E73); with estimated normals, refines these too.
void complete_areas(RawCloud& raw, const LoadOptions& options, LoadReport& report);

/// The triangles between the points of a raster of heights, seen from above: two in each cell of four nodes, apart
/// along the diagonal that is shorter on the surface, one where a node is missing. Empty unless each point stands
/// within 2 % of a node of a grid along x and y, one on each, on a sixteenth of the nodes or more. The shape of the
/// grid's cells is free.
std::vector<std::array<std::uint32_t, 3>> raster_triangles(std::span<const Eigen::Vector3f> points);

/// Where an organised cloud without a viewpoint, not yet cleaned, was seen from: the origin of its coordinates, if it
/// fans out from there. Empty for other clouds, and where the viewpoint is known.
std::optional<Eigen::Vector3d> viewpoint_by_rows(const RawCloud& raw);
/// Takes the viewpoint of the options, else leaves that of the file, else takes viewpoint_by_rows with a note.
void find_viewpoint(RawCloud& raw, const LoadOptions& options, std::vector<std::string>& notes);
/// What info and reports say of it.
inline constexpr const char* fans_out_note =
    "rows and columns fan out from 0,0,0: taken as seen from there; give the viewpoint if it was another";
/// What they say of rasters of heights without a viewpoint.
inline constexpr const char* looks_up_note =
    "a raster of heights: its surface looks up; give the viewpoint if it was seen from below";

/// Whether a cloud without a viewpoint is a raster of heights, which looks up: by its format, or by raw.raster unless
/// it is an organised cloud in one plane, which may be a picture of a wall.
bool looks_up(const RawCloud& raw);

/// Whether the rows and columns of an organised cloud, not yet cleaned, fan out from the origin of its coordinates: the
/// directions of neighbours from there are even where the points themselves are not. False where that cannot be seen,
/// as of smooth surfaces.
bool fans_out_from_origin(const RawCloud& raw);

/// Uses the file's noise, else that of the options, else estimates it (E67).
void complete_noise(const RawCloud& raw, const LoadOptions& options, LoadedScene& result);

/// Scales usable normals to unit length unless save_scene wrote them (`prepared`). Returns the number whose length was
/// off by more than 1e-3.
std::size_t renormalise(std::vector<Eigen::Vector3f>& normals, bool prepared);
/// Turns normals that look down.
void turn_up(std::vector<Eigen::Vector3f>& normals);
/// True if the normal is finite and not zero.
bool usable_normal(const Eigen::Vector3f& normal);

/// Why the labels of a cloud cannot stand for materials of the table, or for "label 0", "label 1", ... without one, and
/// the remedy; empty if they can. `largest` is the largest label.
std::string label_problem(const RawCloud& raw, const std::vector<Material>& table, std::uint16_t largest);

/// Sets the table of materials: the caller's, the file's, or a default material per label. Converts the labels in
/// result.scene.material to indices into it.
void complete_materials(const RawCloud& raw, const LoadOptions& options, LoadedScene& result);

/// Drops all points not listed in `keep` (ascending).
void keep_points(RawCloud& raw, const std::vector<std::uint32_t>& keep);

/// Sets the surface between the points of a height field: the triangles of a raster, or those of the plan if there are
/// none.
void set_surface(std::span<const Eigen::Vector3f> points, std::vector<std::array<std::uint32_t, 3>> raster, int threads,
                 RawCloud& raw);

/// Makes raw.surface, if there is any, the mesh of a completed cloud, or with options.mesh_spacing samples it in place
/// of the points.
void add_surface(RawCloud& raw, const LoadOptions& options, LoadedScene& result);

/// Samples a mesh: fills points, normals, areas, labels and ids of result.scene, and the report; columns of the corners
/// become columns of the surfels.
void sample_mesh(RawCloud& mesh, const LoadOptions& options, LoadedScene& result);

/// Warnings about doubtful coordinates: units, precision. `spacing` is the typical spacing of the cloud [m]; `unit` has
/// been applied already.
std::vector<std::string> doubts_about(const RawCloud& raw, double spacing, double unit);

/// Notes that a scene without any area returns nothing.
void note_no_area(double total_area, std::vector<std::string>& notes);

/// "12 of 3400 points (0.4 %)".
std::string share(std::size_t part, std::size_t whole, const char* noun);

}  // namespace insonify
