// SPDX-License-Identifier: BSD-3-Clause
#include "support/heads.hpp"

#include "core/units.hpp"
#include "sonar/shading.hpp"

namespace insonify {

SonarSpec small_sonar(const SmallSonar& sonar) {
  SonarSpec s;
  s.name = "test";
  s.centre_frequency = 450e3, s.bandwidth = 20e3;
  s.source_level_db = sonar.source_level_db;
  s.beams = sonar.beams, s.field_of_view = radians(sonar.field_of_view_deg);
  s.beam_width = radians(sonar.beam_width_deg), s.elevation_width = radians(sonar.elevation_width_deg);
  s.min_range = sonar.min_range, s.max_range = sonar.max_range;
  return s;
}

SonarHead small_head(const SmallSonar& sonar, double speed) {
  return make_head(small_sonar(sonar), speed > 0 ? speed : sound_speed(Water{}));
}

SonarSpec nine_beams() {
  return small_sonar({.beams = 9,
                      .field_of_view_deg = 40,
                      .beam_width_deg = 4,
                      .elevation_width_deg = 40,
                      .min_range = 1,
                      .max_range = 12});
}

SonarHead nine_beam_head() { return make_head(nine_beams(), c0); }

SonarHead line_head(const LineHead& line) {
  SonarHead head;
  head.name = "test";
  head.pulse = {line.frequency, line.bandwidth, line.source_level_db};
  head.fan = make_fan(line.beams, radians(line.field_of_view_deg), radians(line.beam_width_deg),
                      radians(line.elevation_width_deg));
  head.gate = {line.min_range, line.max_range, default_bin_size(head.pulse, line.sound_speed)};
  head.array = {0.5 * line.sound_speed / line.frequency,
                line.elements > 4 ? taylor_shading(line.elements, -30) : uniform_shading(line.elements)};
  return head;
}

}  // namespace insonify
