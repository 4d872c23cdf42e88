// SPDX-License-Identifier: BSD-3-Clause
// Reads from a mission the sides and the water level of a run, also while its survey is not complete.
#include <cmath>
#include <filesystem>

#include "files/path_status.hpp"
#include "run_scenes/stored_run.hpp"
#include "store/environment_file.hpp"
#include "store/survey_run.hpp"
#include "tool/run/run_pings.hpp"

namespace insonify::tool {

namespace fs = std::filesystem;

std::string depth_datum(const MissionWater& water) {
  return water.datum.empty() || water.datum == "UNKNOWN" ? "below z = 0" : "below " + water.datum;
}

std::string depth_datum_of_run(const std::string& run) {
  const std::string settings = StoredRun(run).find("run.toml");
  bool has_level = !settings.empty() && surface_height(load_environment(settings)).has_value();
  MissionWater water;
  const fs::path survey = real_path(run).parent_path(), mission = survey / "mission.toml";
  if (is_survey_run(survey.string()) && path_exists(mission.string())) {
    const MissionFile file = load_mission(mission.string());
    water = file.water;
    has_level = has_level || water.level || !file.mission.tide.time.empty();
  }
  return has_level ? depth_datum(water) : "";
}

std::optional<SideScanHeads> side_scan_heads(const std::string& run) {
  constexpr double athwart = 0.5;  // least part of a head's axis along that to port
  const std::string mission = run + "/mission.toml";
  if (!is_folder(run) || !is_survey_run(run) || !path_exists(mission)) return {};
  std::vector<std::string> port, starboard;
  for (const MissionHead& head : load_mission(mission).mission.heads) {
    const double to_port = head.assumed.vehicle_from_head.value_or(head.vehicle_from_head).linear()(1, 0);
    if (std::abs(to_port) > athwart) (to_port > 0 ? port : starboard).push_back(head.name);
  }
  if (port.size() != 1 || starboard.size() != 1) return {};
  return SideScanHeads{port.front(), starboard.front()};
}

}  // namespace insonify::tool
