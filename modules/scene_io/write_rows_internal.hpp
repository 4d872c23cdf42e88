// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "scene_io/packed_rows_internal.hpp"

// Private to scene_io.
namespace insonify {

/// Writes header and rows to a temporary file, then renames it to `path`; leaves nothing behind on failure.
void write_rows(const std::string& path, const std::string& header, const PackedRows& rows);

}  // namespace insonify
