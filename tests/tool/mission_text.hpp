// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

/// A mission of one head along a straight way; `survey`, `head` and `more` are further lines of its tables.
struct OneHeadMission {
  std::string scene = "bed.obj", survey{}, way{}, speed = "1";
  std::string sonar{}, range{}, head{}, more{};
};
inline std::string text_of(const OneHeadMission& m) {
  return "schema = 1\n[survey]\nscene = \"" + m.scene + "\"\n" + m.survey + "\n[trajectory]\nwaypoints_m = [" + m.way +
         "]\nspeed_m_s = " + m.speed + "\n[[head]]\nsonar = \"" + m.sonar + "\"\nrange = \"" + m.range + "\"\n" +
         m.head + "\n" + m.more + "\n";
}
