// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "returns/label_objects.hpp"
#include "store/cube.hpp"
#include "store/mission_file.hpp"
#include "survey/randomise.hpp"

/// Runs that `dataset` reads.
namespace insonify::tool {

/// Cubes of one head of a run or survey, read one after the other.
struct DatasetSource {
  std::string run, head;       ///< head: of a survey; else empty
  std::size_t run_index = 0;   ///< in the list of runs
  std::size_t head_index = 0;  ///< in the mission
  std::vector<std::string> cubes;
  std::vector<TrackPoint> track;     ///< all pings, in the order of the cubes
  std::string scene;                 ///< path, or empty: unknown
  std::string scene_digest;          ///< digest of the scene's file; of a run without its scene that of the run's name
  std::vector<std::string> split{};  ///< train, val or test, of each ping
  std::vector<std::set<std::string>> shows{};  ///< classes that have boxes, of each ping; empty: unknown
  std::string draw_key;  ///< key of a run that is no survey: equal for pings of one draw of one scene
  std::optional<SurveyRandomisation> randomisation{};  ///< randomisation of a mission; absent: none
  SceneInstances instances{};                          ///< if the scene's cloud has a field `instance`
  std::string note{};                                  ///< on files of the scene that are gone; empty: none
};

/// The heads of runs, surveys and cubes. Throws Error(file) for one that is not there, Error(content) for a survey that
/// is not whole.
std::vector<DatasetSource> dataset_sources(const std::vector<std::string>& runs);

/// Calls `body` with every ping of a source and its position in the track, one in memory at a time. Throws Error(content)
/// for pings without labels.
void for_each_labelled_ping(const DatasetSource& source,
                            const std::function<void(const Cube&, const Ping&, std::size_t)>& body);

}  // namespace insonify::tool
