#pragma once
#include "tool/options.hpp"
#include "view/picture.hpp"

namespace insonify::tool {

/// The 3-D picture of `image --view scene`: of a run, its returns over its scene; of a scene to inspect, what the sonar
/// would see of it. Throws Error(argument) for options that do not go together, and as the loading of either.
void image_scene(const CommonOptions& common, const ImageOptions& options, const PictureOptions& picture);

/// Throws Error(argument) for an option of view scene beside another view.
void require_no_scene_options(const ImageOptions& options);

}  // namespace insonify::tool
