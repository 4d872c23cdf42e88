// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace insonify {

/// Writes one cube from cubes of consecutive pings of one sonar. The images (pressure, layers, maps) become HDF5
/// virtual data sets that refer to the parts by paths relative to the cube, so that folder and parts can be moved
/// together. With `copy` the images are copied, ping by ping, and the cube does not need the parts. Axes and attributes
/// are those of the first part. Layers and maps that some parts lack are left out. The call takes as much memory as one
/// image. The same parts give the same bytes. Throws Error(argument) without parts, Error(file) for a missing part,
/// Error(content) for a part that is not a cube or differs in sonar or extent, naming it.
void concatenate_cube_files(const std::string& path, const std::vector<std::string>& sources, bool copy = false);

}  // namespace insonify
