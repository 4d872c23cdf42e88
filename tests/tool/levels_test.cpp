// Levels through the whole tool.
#include <cmath>
#include <cstdio>

#include "core/units.hpp"
#include "store/cube.hpp"
#include "tool/tool_runner.hpp"

using namespace insonify;

class Levels : public ToolTest {
 protected:
  Cube cube(const std::string& run) const { return read_cube(path(run + "/cube.h5")); }
  void write_scatterer(const std::string& name, double range, double azimuth) const {
    char line[200];
    std::snprintf(line, sizeof line, "%.17g,%.17g,0,0.01,1,0\n", range, azimuth);
    write(name, std::string("range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n") + line);
  }
};

// A scatterer of -20 dB on the axis of a beam, at a bin centre: SL - 2 TL + TS within 1e-6 dB, in float32.
TEST_F(Levels, one_scatterer_through_synthesize_is_the_sonar_equation) {
  write_scatterer("first.csv", 10, 0);
  const std::string sonar = " --sonar p900-45 --range 5:15 --no-picture -q";
  succeed("synthesize first.csv -o first" + sonar);
  const Ping axes = cube("first").pings[0];
  for (const std::size_t beam : {0, 100, 255})
    for (const std::string method : {"stamped", "direct"}) {
      const double r = axes.gate.centre(400);
      write_scatterer("one.csv", r, axes.fan.azimuth[beam]);
      succeed("synthesize one.csv --force -o one --method " + method + sonar);
      const Cube c = cube("one");
      const double expected = c.source_level_db - 2 * (20 * std::log10(r) + c.absorption_db_per_m * r) - 20;
      const auto& p = c.pings[0].pressure;
      EXPECT_NEAR(pressure_level_db(std::abs(std::complex<double>(p(static_cast<int>(beam), 400)))), expected, 1e-6)
          << method;
      Eigen::Index peak_beam = 0, peak_bin = 0;
      p.abs().maxCoeff(&peak_beam, &peak_bin);
      EXPECT_EQ(peak_beam, static_cast<int>(beam));
      EXPECT_EQ(peak_bin, 400);
    }
}

// Twice the points, the same level: 40 beams x 16 m of independent cells, 0.05 dB of speckle.
TEST_F(Levels, mean_level_does_not_depend_on_density_or_rays) {
  const std::string over = " --sonar p900-45 --pose=0,0,3,0,15,0 --range 4:16 --no-picture -q";
  const auto mean = [&](const std::string& points, const std::string& more) {
    succeed("make-scene plane --force -o plane.ply --size 20,20 --points " + points + " -q");
    succeed("ping plane.ply --force -o out" + over + more);
    const Cube c = cube("out");
    double sum = 0;
    int strips = 0;
    for (double r = 6; r < 14; r += 0.5, ++strips) sum += mean_level_db(c.pings[0], r, r + 0.5);
    return sum / strips;
  };
  const double level = mean("40000", "");
  EXPECT_NEAR(mean("80000", ""), level, 0.25);
  EXPECT_NEAR(mean("160000", ""), level, 0.25);
  const double rays = mean("80000", " --sampling rays --rays-per-beam 1000");
  EXPECT_NEAR(rays, level, 0.35);
  EXPECT_NEAR(mean("80000", " --sampling rays --rays-per-beam 2000"), rays, 0.35);
}
