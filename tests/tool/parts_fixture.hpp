// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "tool/survey_fixture.hpp"

/// Scenes of parts for tests: a harbour with a crate and a diver, and pots scattered over it.
inline const std::string parts_head =
    " --sonar p900-45 --set sonar.beams=64 --range 2:15 --scatterers-per-cell 3 --no-picture -q --pose=0,0,-3,0,10,0";

/// A cube of 0.5 m, corners at 0 and 0.5 of x and y and z.
inline const std::string box_obj =
    "v 0 0 0\nv .5 0 0\nv .5 .5 0\nv 0 .5 0\nv 0 0 .5\nv .5 0 .5\nv .5 .5 .5\nv 0 .5 .5\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

inline const std::string swim = "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,6,-3,-2,0,0,0\n6,6,3,-2,0,0,0\n";

inline const std::string harbour_with_parts = R"(schema = 1
[[part]]
file = "harbour.ply"
[[part]]
name = "crate"
file = "box.obj"
material = "steel"
position_m = [8, 1]
bury_m = 0.1
yaw_deg = 30
[[part]]
name = "diver"
file = "box.obj"
material = "rock"
trajectory = "swim.csv"
)";

inline const std::string strewn_pots = R"([[scatter]]
files = ["box.obj"]
names = ["pot"]
material = "steel"
count = [2, 4]
area_m = [[4, -4], [12, -4], [12, 4], [4, 4]]
min_distance_m = 1
yaw_deg = 180
scale = [0.5, 1]
)";

class PartsOfTool : public SurveyTest {
 protected:
  void SetUp() override {
    SurveyTest::SetUp();
    write("box.obj", box_obj);
    write("swim.csv", swim);
    write("scene.toml", harbour_with_parts);
    write("drawn.toml", harbour_with_parts + strewn_pots);
  }
  /// A mission over a scene of parts.
  void mission_over(const std::string& scene, const std::string& more = "") const {
    write("m.toml", replaced(survey_mission, "harbour.ply", scene) + more);
  }
};

inline const nlohmann::json& named(const nlohmann::json& parts, const std::string& name) {
  for (const auto& part : parts)
    if (part["name"] == name) return part;
  throw std::runtime_error("no part " + name);
}
