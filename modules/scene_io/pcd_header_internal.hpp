#pragma once
#include <string>

#include "scene_io/packed_rows_internal.hpp"

namespace insonify {

/// Header of a binary PCD, including its DATA line (written by PCL); comments become "# " lines.
std::string pcd_header(const PackedRows& rows);

}  // namespace insonify
