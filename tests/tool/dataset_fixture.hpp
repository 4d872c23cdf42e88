// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nlohmann/json.hpp>

#include "tool/tool_runner.hpp"
#include "view/grey_file.hpp"

/// A survey of four pings that keeps contributors, and the data set made of it.
class DatasetRun : public ToolTest {
 protected:
  void SetUp() override {
    have("harbour.ply", "make-scene harbour --points 30000");
    write("mission.toml", mission());
    have("survey", "survey mission.toml");
  }
  static std::string mission(const std::string& keep = "keep = [\"contributors\"]\n") {
    return "schema = 1\n[survey]\nscene = \"harbour.ply\"\nseed = 4\n[trajectory]\nwaypoints_m = [[0, 0, -3], [4, 0, "
           "-3]]\n"
           "speed_m_s = 1\n[[head]]\nname = \"fls\"\nsonar = \"p900-45\"\nset = [\"sonar.beams=48\"]\nrange = "
           "\"2:15\"\n"
           "pitch_deg = -10\nrate_hz = 1\n[randomise]\nsource_level_db = 3\ntemperature_c = 4\nposition_m = "
           "0.2\n"
           "heading_deg = 5\n[ping]\n" +
           keep;
  }
  nlohmann::json coco(const std::string& form) const {
    return nlohmann::json::parse(read("set/" + form + "/annotations/instances_train.json"));
  }
  GreyPicture png(const std::string& name) const { return load_grey_png(path("set/" + name)); }
};
