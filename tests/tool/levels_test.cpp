// SPDX-License-Identifier: BSD-3-Clause
// Levels through the whole tool.
#include <cstdio>

#include <nlohmann/json.hpp>

#include "store/cube.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

class Levels : public ToolTest {
 protected:
  void write_scatterer(const std::string& name, double range, double azimuth) const {
    char line[200];
    std::snprintf(line, sizeof line, "%.17g,%.17g,0,0.01,1,0\n", range, azimuth);
    write(name, std::string("range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n") + line);
  }
};

// A scatterer of -20 dB on the axis of a beam, at a bin centre: SL - 2 TL + TS within 1e-6 dB, in float32, if so much is
// asked for (1e-8 of the pressure), and within what the default tolerance of 1e-4 allows; with one absorption for the pulse.
TEST_F(Levels, one_scatterer_through_synthesize_is_the_sonar_equation) {
  write_scatterer("first.csv", 10, 0);
  const std::string sonar = " --sonar p900-45 --range 5:15 --no-picture -q";
  succeed("synthesize first.csv -o first" + sonar);
  const Ping axes = cube_of("first").pings[0];
  for (const std::size_t beam : {0, 100, 255})
    for (const std::string method : {"gridded", "gridded --tolerance 1e-8", "direct"}) {
      const double r = axes.gate.centre(400);
      write_scatterer("one.csv", r, axes.fan.azimuth[beam]);
      succeed("synthesize one.csv --force -o one --absorption-order 0 --method " + method + sonar);
      const Cube c = cube_of("one");
      const double expected = c.source_level_db - 2 * (20 * std::log10(r) + c.absorption_db_per_m * r) - 20;
      const auto& p = c.pings[0].pressure;
      EXPECT_NEAR(pressure_level_db(std::abs(std::complex<double>(p(static_cast<int>(beam), 400)))), expected,
                  method == "gridded" ? 20 * std::log10(1 + 1e-4) : 1e-6)
          << method;
      Eigen::Index peak_beam = 0, peak_bin = 0;
      p.abs().maxCoeff(&peak_beam, &peak_bin);
      EXPECT_EQ(peak_beam, static_cast<int>(beam));
      EXPECT_EQ(peak_bin, 400);
    }
}

// Without further options the beams are what the elements receive, to the tolerance, as of a ping: delays across the array
// and absorption over the band where the budget needs them.
TEST_F(Levels, synthesize_computes_what_the_plan_of_a_ping_finds_needed) {
  std::string rows = "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n";
  for (int i = 0; i < 12; ++i)
    rows += std::to_string(4.7 + 0.05 * i) + "," + std::to_string(-0.8 + 0.14 * i) + ",0.02,0.01," +
            (i % 2 == 0 ? "1,0\n" : "0,-1\n");
  write("some.csv", rows);
  const auto pressure = [&](const std::string& run, const std::string& more) {
    succeed("synthesize some.csv -o " + run + " --sonar oculus-m750d --set sonar.beams=40 --no-picture -q " + more);
    return ComplexGrid(cube_of(run).pings[0].pressure.cast<std::complex<double>>());
  };
  const std::string near = "--range 4.5:5.6 ";
  const ComplexGrid planned = pressure("planned", near);
  const ComplexGrid elements = pressure("elements", near + "--method element-exact --absorption-order 2");
  EXPECT_LT(relative_l2(planned, elements), 2e-4);
  EXPECT_GT(relative_l2(pressure("narrow", near + "--method gridded"), elements), 0.1);
  const auto synthesis = [&](const std::string& run) { return manifest_of(run)["synthesis"]; };
  EXPECT_EQ(synthesis("planned")["method"], "true-delays");
  EXPECT_EQ(synthesis("planned")["absorption_order"], 2);
  EXPECT_EQ(synthesis("narrow")["method"], "gridded");
  // A budget of ten times the pressure needs neither.
  pressure("rough", near + "--accuracy-db 20");
  EXPECT_EQ(synthesis("rough")["method"], "gridded");
  EXPECT_EQ(synthesis("rough")["absorption_order"], 0);
  EXPECT_NE(read("rough/run.toml").find("accuracy_db = 20"), std::string::npos);
}

// Flat Lambert bottom 3 m below the head (SL 220 dB, 10 log mu = -27 dB, 1 degree, 29.5 kHz, 900 kHz):
// RL = SL - 40 log r - 2 a r + 10 log mu + 20 log(h/r) + 10 log[(lambda/L) r^2 / sqrt(r^2 - h^2) c tau_e / 2],
// tau_e = 0.469719 / B. A strip of 1 m holds 17 beams x 89 cells: one standard deviation is 0.11 dB.
TEST_F(Levels, flat_bottom_has_the_closed_form_level_from_5_to_40_m) {
  const double h = 3, mu = power_from_db(-27);
  have("plane.ply", "make-scene plane --size 60,40 --points 600000 --mu-db -27");
  succeed(
      "ping plane.ply -o out --sonar p900-45 --pose=0,0,3,0,0,0 --range 4:41 --no-picture -q --set sonar.beams=41 "
      "--set sonar.field_of_view_deg=40 --set sonar.beam_width_deg=1 --set sonar.bandwidth_hz=29500 "
      "--set sonar.source_level_db=220 --set sonar.elevation_shape=sector --set sonar.elevation_width_deg=170 "
      "--set sonar.side_lobe_db=0");
  const Cube c = cube_of("out");
  const Ping& ping = c.pings[0];
  const double wavelength = c.sound_speed / c.centre_frequency;
  // The uniform array of the preset: half a wavelength apart at 1500 m/s, 0.886 wavelengths / width long.
  const double length = std::round(0.885893 / (0.5 * radians(1))) * 0.5 * 1500 / c.centre_frequency;
  for (const double strip : {5.0, 10.0, 20.0, 40.0}) {
    double excess = 0, samples = 0;
    for (std::size_t b = 0; b < ping.fan.beams(); ++b)
      for (std::size_t n = 0; n < ping.gate.bins(); ++n) {
        const double r = ping.gate.centre(n), cell = wavelength / length * r * r / std::sqrt(r * r - h * h) * 0.5 *
                                                     c.sound_speed * 0.469719 / c.bandwidth;
        if (std::abs(ping.fan.azimuth[b]) > radians(8.5) || std::abs(r - strip) > 0.5) continue;
        const double expected = c.source_level_db - 40 * std::log10(r) - 2 * c.absorption_db_per_m * r +
                                db_from_power(mu) + 20 * std::log10(h / r) + db_from_power(cell);
        const std::complex<double> p(ping.pressure(static_cast<int>(b), static_cast<int>(n)));
        excess += power_from_db(pressure_level_db(std::abs(p)) - expected);
        ++samples;
      }
    EXPECT_NEAR(db_from_power(excess / samples), 0, 0.5) << strip << " m";
  }
}
