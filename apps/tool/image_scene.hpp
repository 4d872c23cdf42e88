#pragma once
#include "tool/image_options.hpp"
#include "view/picture.hpp"

namespace insonify::tool {

/// Draws `image --view scene`: of a run, its returns over its scene; of a scene alone, its visibility from the sonar.
/// Throws Error(argument) for options that exclude one another, and as read_run_cube and load_scene.
void image_scene(const ImageOptions& options, const PictureOptions& picture);

}  // namespace insonify::tool
