// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace insonify {

/// Makes one cube of cubes of consecutive pings of one sonar. The images (pressure, layers, maps) become HDF5 virtual
/// data sets that refer to the parts by paths relative to the cube, so that folder and parts may be moved together;
/// with `copy` they are copied, ping by ping, and the cube stands alone. Axes and attributes are those of the first
/// part. Layers and maps that not all parts have are left out. Takes as much memory as one image. The same parts give
/// the same bytes. Throws Error(argument) without parts, Error(file) for one that is missing, Error(content) for one
/// that is no cube or differs in sonar or extent, naming it.
void concatenate_cube_files(const std::string& path, const std::vector<std::string>& parts, bool copy = false);

}  // namespace insonify
