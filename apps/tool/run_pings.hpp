#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "acoustics/environment.hpp"
#include "core/geodesy.hpp"
#include "returns/bottom_detection.hpp"
#include "store/cube.hpp"

namespace insonify::tool {

/// The pings of a run or of one head of a survey: cubes whose pings are read one at a time.
struct RunPings {
  std::vector<std::string> cubes;  ///< paths
  Environment environment{};       ///< of its run.toml, if it has one
  std::optional<Anchor> anchor{};  ///< of its mission
  std::string start_utc;
};

/// Finds the cubes of a run directory, a cube, or a survey, of which `head` names the head; "" if it has one only. Throws
/// Error(file) for a run that does not exist, Error(content) for one without a cube or a survey with blocks that are not
/// done, Error(argument) for a head that is not named or not there.
RunPings find_run_pings(const std::string& run, const std::string& head);

/// Calls `use` with each ping and the cube it is of, without pings: memory is that of one ping.
void each_ping(const RunPings& run, const std::function<void(const Cube&, const Ping&)>& use);

/// Options to find the bottom in a ping of a cube: with the water at the head, and its depth in the profile.
BottomOptions bottom_options(const Cube& cube, const Ping& ping, const Environment& environment, int per_beam);

/// Seconds since 1970 of a time as 2026-05-01T08:30:00Z; 0 for "". Throws Error(argument) for another text.
double seconds_of_utc(const std::string& text);

}  // namespace insonify::tool
