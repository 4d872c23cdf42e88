#pragma once
#include <optional>
#include <string>

#include "beamforming/sonar_head.hpp"
#include "store/cube.hpp"
#include "tool/options.hpp"
#include "tool/parse_values.hpp"
#include "view/picture.hpp"

namespace insonify::tool {

/// A run as `image` sees it.
struct ImageRun {
  std::string path;                    ///< as the user gave it
  Cube cube;                           ///< of --layer alone, if one was asked for
  std::optional<SonarHead> head = {};  ///< from the run's run.toml; absent for a bare cube
};

/// Reads a run directory or a cube. Throws Error(file) if there is none, Error(content) if it is unfinished or damaged,
/// Error(argument) for a layer that it has not.
ImageRun read_image_run(const std::string& path, const std::string& layer);

/// The cube of a run directory, or of a cube's own path; errors as read_image_run's.
Cube read_run_cube(const std::string& path);

/// Where on the beam axis a view looks.
enum class BeamChoice { one, strongest, mean };
struct ChosenBeam {
  BeamChoice choice = BeamChoice::one;
  std::size_t beam = 0;  ///< of `one`
};

/// --beam: a number, "max" (waterfall), "all" (spectrum), or empty: all of a spectrum, else the middle one. Throws
/// Error(argument).
ChosenBeam choose_beam(const ImageOptions& options, std::size_t beams);

/// Size, colours and window of the options; Error(argument) naming the option that is wrong.
PictureOptions picture_options(const ImageOptions& options);

/// The levels that a view shows of a ping: with the gain that the options ask for.
LevelImage levels_of(const ImageRun& run, const ImageOptions& options, std::size_t ping);

}  // namespace insonify::tool
