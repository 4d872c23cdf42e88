#pragma once
#include "tool/image/image.hpp"

namespace insonify::tool {

/// Draws `image --view track`: the ways of the heads of a merged survey from above, over its mosaic if there is one, else over
/// its returns. Throws Error(file) if the run is no survey, Error(content) if it is not merged.
void draw_track(const ImageOptions& options, const PictureOptions& picture);

}  // namespace insonify::tool
