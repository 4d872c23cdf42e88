// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene_io/packed_rows_internal.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/scene_columns.hpp"

// Private to scene_io.
namespace insonify {

/// Returns a copy of the numbers of a column, called `name`: unchanged, or as double if the column is scaled.
SceneColumn copy_of(const RowTable& table, const RowTable::Column& column, const std::string& name);

/// Reduces a column to the listed rows, in that order.
void keep_rows(SceneColumn& column, const std::vector<std::uint32_t>& rows);

/// Moves the columns of the surfels into `columns`. The column of labels becomes the column of materials if its numbers
/// are the indices of the materials.
void take_columns(RawCloud& raw, const LoadOptions& options, SceneColumns& columns);

/// Adds further columns to the rows of a scene, with legal_names, and comment lines with the names that they replace.
/// Names the column without a name, that of the materials. In PLY the types are int, uchar, float or double. Throws
/// Error(argument) for a column of another length.
void add_columns(PackedRows& rows, const SceneColumns& columns, CloudFormat format);

}  // namespace insonify
