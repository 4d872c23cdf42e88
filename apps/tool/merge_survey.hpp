#pragma once
#include <string>

#include "tool/options.hpp"

namespace insonify::tool {

/// Joins the blocks of a survey in its folder: NAME/cube.h5 of each head, which refers to the blocks unless `copy`,
/// returns.ply and manifest.json; of a `mosaic` > 0, the size of its cells [m], also mosaic.vti, .png and .pgw. Throws Error(content) naming blocks that are missing or were changed; SomeFailed,
/// when all is written, if some pings failed.
void merge_survey(const std::string& folder, bool copy, double mosaic, const CommonOptions& common);

}  // namespace insonify::tool
