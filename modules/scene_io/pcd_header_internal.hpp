#pragma once
#include <string>

#include "scene_io/packed_rows_internal.hpp"

namespace insonify {

/// Header of a binary PCD up to and with its DATA line (PCL writes it); comments stand as "# " lines.
std::string pcd_header(const PackedRows& rows);

}  // namespace insonify
