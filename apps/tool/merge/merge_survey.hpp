// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "tool/command/common_options.hpp"
#include "tool/run/world_reference.hpp"

namespace insonify::tool {

/// --mosaic and what goes with it.
struct MosaicOptions {
  double cell = 0;          ///< [m]; 0: no mosaic
  std::string bottom;       ///< height of a level bed [m], or empty: the returns' surface
  std::string by = "mean";  ///< or "best"
  std::string crs;          ///< system of mosaic.tif: EPSG:N, local, or empty: that of the world, else UTM
  WorldOptions world{};     ///< place of the world; empty: as mission or scene say
};

/// Joins the blocks of a survey in its folder: NAME/cube.h5 of each head, which refers to the blocks unless `copy`,
/// returns.ply and manifest.json; with a mosaic also mosaic.vti, .png, .pgw and,
/// with a position on the globe or a local plane, .tif. Throws Error(content) naming blocks that
/// are missing or were changed; SomeFailed, when all is written, if some pings failed.
void merge_survey(const std::string& folder, bool copy, const MosaicOptions& mosaic, const CommonOptions& common);

}  // namespace insonify::tool
