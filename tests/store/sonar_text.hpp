// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "store/sonar_file.hpp"
#include "support/test.hpp"

namespace insonify {

inline const std::string plain =
    "schema = 1\n"                     // line 1
    "name = \"mine\"\n"                // 2
    "centre_frequency_hz = 900_000\n"  // 3
    "bandwidth_hz = 30e3\n"            // 4
    "source_level_db = 210\n"          // 5
    "beams = 128\n"                    // 6
    "field_of_view_deg = 90\n"         // 7
    "beam_width_deg = 1.5\n"           // 8
    "elevation_width_deg = 20\n"       // 9
    "min_range_m = 0.5\n"              // 10
    "max_range_m = 30\n";              // 11

inline SonarFile load_sonar(const std::string& text) { return load_sonar_file(own_file("s.toml", text)); }

inline std::string error_of_sonar(const std::string& text) { return error_of_file(load_sonar_file, "s.toml", text); }

inline void refuses_sonar(const std::string& text, const std::string& what) {
  EXPECT_EQ(error_of_sonar(text), "content: s.toml:" + what);
}

inline void expect_same_bits(const SonarSpec& a, const SonarSpec& b) {
  const auto fields = [](const SonarSpec& x) {
    return std::tie(x.name, x.centre_frequency, x.bandwidth, x.source_level_db, x.beams, x.field_of_view, x.beam_width,
                    x.elevation, x.elevation_width, x.elevation_shape, x.side_lobe_db, x.min_range, x.max_range,
                    x.bin_size, x.azimuths, x.elevations, x.column_beam_width, x.transmit_width, x.pulse,
                    x.pulse_length, x.replica_window);
  };
  EXPECT_EQ(fields(a), fields(b));
  EXPECT_EQ(shading_of(a), shading_of(b));
}

}  // namespace insonify
