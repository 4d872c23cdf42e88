// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene_io/packed_rows_internal.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/scene_columns.hpp"

// Private to scene_io.
namespace insonify {

/// A field's name in lower case without CloudCompare's prefix "scalar_", and with blanks as CloudCompare writes them.
std::string plain_name(std::string name);

/// The numbers of a column as they are; scaled ones as double.
SceneColumn copy_of(const RowTable& table, const RowTable::Column& column);

/// Makes a column of the rows listed, in that order.
void keep_rows(SceneColumn& column, const std::vector<std::uint32_t>& rows);

/// Takes the columns that go with the surfels. That of the labels goes on as the column of materials if its numbers are
/// theirs.
void take_columns(RawCloud& raw, const LoadOptions& options, SceneColumns& columns);

/// Adds further columns to the rows of a scene: by their names, "_in_file" behind those that the scene's own columns
/// have, in PLY as int, uchar, float or double. Throws Error(argument) for a column of another length.
void add_columns(PackedRows& rows, const SceneColumns& columns, CloudFormat format);

}  // namespace insonify
