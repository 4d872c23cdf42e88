// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>

#include "tool/tool_runner.hpp"

/// The commands under "next".
inline std::string next_of(const nlohmann::json& info) {
  std::string next;
  for (const nlohmann::json& command : info["next"]) next += command.get<std::string>() + "\n";
  return next;
}

class FirstHour : public ToolTest {
 protected:
  void have_plane() const { have("plane.ply", "make-scene plane --size 8,8 --points 6000"); }
  nlohmann::json info(const std::string& file) const { return json_of("info " + file); }
  // Notes of a ping with a small head over the plane.
  std::string notes(const std::string& options) const {
    std::filesystem::remove_all(path("noted"));
    const ToolResult result =
        run("ping plane.ply --sonar p900-45 --set sonar.beams=8 --no-picture -o noted " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  }
};
