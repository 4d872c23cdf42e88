// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <filesystem>

#include "files/sha256.hpp"
#include "tool/tool_runner.hpp"

/// A mission of two heads, 13 pings each, over the built-in harbour.
inline const std::string survey_mission = R"(schema = 1
[survey]
scene = "harbour.ply"
seed = 7
[trajectory]
waypoints_m = [[0, 0, -3], [4, 0, -3], [4, 3, -3]]
speed_m_s = 1
[[head]]
name = "fls"
sonar = "p900-45"
range = "1:6"
set = ["sonar.beams=16"]
pitch_deg = -20
rate_hz = 2
[[head]]
name = "turning"
sonar = "ping360"
range = "1:6"
offset_m = [0.5, 0, 0]
[head.scan]
start_deg = 0
stop_deg = 360
step_deg = 45
dwell_s = 0.5
[ping]
noise = true
scatterers_per_cell = 0
)";

/// Surveys of that mission, in blocks of three pings.
class SurveyTest : public ToolTest {
 protected:
  void SetUp() override {
    have("harbour.ply", "make-scene harbour --points 6000");
    write("m.toml", survey_mission);
  }
  void survey(const std::string& run, const std::string& more = "") const {
    succeed("survey m.toml -q --pings-per-block 3 -o " + run + " " + more);
  }
  /// Digests of what a survey gives after merging.
  std::vector<std::string> merged(const std::string& run) const {
    succeed("merge -q " + run);
    std::vector<std::string> digests;
    for (const char* file : {"/fls/cube.h5", "/turning/cube.h5", "/returns.ply", "/manifest.json", "/fls/run.toml"})
      digests.push_back(insonify::sha256_of_file(path(run + file)));
    return digests;
  }
  /// Digests of the cubes of some heads.
  std::vector<std::string> merged_cubes(const std::string& run, const std::vector<std::string>& heads) const {
    succeed("merge -q " + run);
    std::vector<std::string> digests;
    for (const std::string& head : heads)
      digests.push_back(insonify::sha256_of_file(path(run + "/" + head + "/cube.h5")));
    return digests;
  }
  /// Digests of the survey made in one go.
  std::vector<std::string> expected() const {
    survey("whole", "-j1");
    return merged("whole");
  }
  std::vector<std::string> names_in(const std::string& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path(folder)))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }
};
