// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tool/export/raster_plane.hpp"
#include "tool/merge/merge_survey.hpp"

namespace insonify::tool {

/// The cubes of a head, whose settings are in FOLDER/NAME/run.toml.
struct HeadCubes {
  std::string name;
  std::vector<std::string> cubes;
};

/// Lays the images of a survey on its bed (E96) and writes mosaic.vti, .png and .pgw into its folder, and .tif
/// if there is a plane: north up there, each cell as the cell of the mosaic that holds its middle.
///
/// heads    with the cubes of their blocks, in the order of time
/// returns  of all heads: the bed, unless the options give its height
///
/// Takes the memory of one block and of the grid; the result does not depend on `threads`. Throws Error(argument) for a
/// height that is no number, and as ImageMosaic and bed_of_returns.
void save_mosaic(const std::string& folder, const std::vector<HeadCubes>& heads, const std::string& returns,
                 const MosaicOptions& options, const std::optional<RasterPlane>& plane, int threads);

}  // namespace insonify::tool
