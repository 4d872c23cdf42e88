#pragma once
#include <optional>
#include <string>

#include "beamforming/sonar_head.hpp"
#include "store/cube.hpp"
#include "tool/image_options.hpp"
#include "tool/parse_values.hpp"
#include "view/picture.hpp"

namespace insonify::tool {

/// What `image` reads of a run.
struct ImageRun {
  std::string path;                    ///< as the user gave it
  Cube cube;                           ///< with --layer: holds that layer in place of the whole pressure
  std::optional<SonarHead> head = {};  ///< from the run's run.toml; absent for a bare cube
};

/// Reads a run directory or a cube. Throws Error(file) if there is none, Error(content) if it is unfinished or damaged,
/// Error(argument) for a layer that is not in it.
ImageRun read_image_run(const std::string& path, const std::string& layer);

/// Reads the cube of a run directory, or a cube file; errors as read_image_run.
Cube read_run_cube(const std::string& path);

/// Size, colours and window of the options; Error(argument) naming the option that is wrong.
PictureOptions picture_options(const ImageOptions& options);

/// The levels of a ping with the gain of the options (--tvg, --raw).
LevelImage levels_of(const ImageRun& run, const ImageOptions& options, std::size_t ping);

}  // namespace insonify::tool
