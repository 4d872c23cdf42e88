// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "viewer/lazy_pings.hpp"

namespace insonify::viewer {

/// A cube, and the returns of its pings (PLY) or "".
struct CubeOfPings {
  std::string cube, returns;
};

/// The pings of cubes in turn, read one at a time; of the returns those of one cube are kept. Errors as read_cube.
LazyPings lazy_pings_of(const std::vector<CubeOfPings>& cubes);

/// Pings that are in memory.
LazyPings lazy_pings_of(std::vector<Ping> pings);

/// One head of a survey.
struct SurveyHeadRun {
  std::string folder;  ///< folder of the head, with its run.toml
  std::string name;
  std::vector<CubeOfPings> cubes;   ///< the finished blocks; if they are gone, the merged cube
  std::vector<std::string> others;  ///< names of the other heads
  std::size_t blocks = 0, done = 0;
};

/// The head that `target` (the folder of a survey, or of one of its heads) and `head` (or "": the first) name; nothing
/// if the target is of no survey. Throws Error(argument) for a head that the survey lacks, Error(content) if none of
/// its blocks is done.
std::optional<SurveyHeadRun> find_survey_head(const std::string& target, const std::string& head);

}  // namespace insonify::viewer
