// SPDX-License-Identifier: BSD-3-Clause
// A line of a multibeam straight down over a level bed: where the beams meet it, how loud, and how wide the swath is.
#include "core/units.hpp"
#include "scene/material.hpp"
#include "scene_io/load_scene.hpp"
#include "store/cube.hpp"
#include "support/test.hpp"
#include "tool/mission_text.hpp"
#include "tool/tool_runner.hpp"

namespace {

constexpr double swath_altitude = 4;

class Swath : public ToolTest {
 protected:
  void SetUp() override {
    write("bed.obj", "v -3 -14 -4\nv 3 -14 -4\nv 3 14 -4\nv -3 14 -4\nf 1 2 3\nf 1 3 4\n");
    write("line.toml", text_of({.way = "[-1, 0, 0], [1, 0, 0]",
                                .sonar = "em2040",
                                .range = "2:13",
                                .head = "every_m = 0.9",
                                .more = "[ping]"}));
  }
};

/// Energy of a beam along range, and the range of its middle.
std::pair<double, double> energy_of(const Ping& ping, std::size_t beam) {
  double energy = 0, moment = 0;
  for (std::size_t n = 0; n < ping.gate.bins(); ++n) {
    const double power = std::norm(ping.pressure(static_cast<Eigen::Index>(beam), static_cast<Eigen::Index>(n)));
    energy += power, moment += power * ping.gate.centre(n);
  }
  return {energy, moment / energy};
}

}  // namespace

// A beam at angle t from straight down meets the bed at h / cos t. Its width in direction cosine is the same at every angle,
// so that its footprint is w r^3 / h^2 across and w' r along the way; with Lambert's cos^2 t and spreading r^-4 the energy along range
// is that of the beam straight down times cos^2 t exp(-4 a (r - h)).
TEST_F(Swath, of_an_em2040_over_a_level_bed_has_the_ranges_levels_and_edges_of_its_beams) {
  write("expected.toml", read("line.toml") + "method = \"incoherent\"\n");
  succeed("survey expected.toml -q -o expected");
  succeed("merge -q expected");
  const Cube cube = cube_of("expected/em2040");
  ASSERT_EQ(cube.pings.size(), 3U);
  const Ping& ping = cube.pings[1];
  ASSERT_EQ(ping.fan.beams(), 400U);
  const auto [middle, below] = energy_of(ping, 200);
  EXPECT_NEAR(below, swath_altitude, 0.02);
  for (std::size_t b = 5; b < 400; b += 30) {
    const double angle = ping.fan.azimuth[b], range = swath_altitude / std::cos(angle);
    const auto [energy, reached] = energy_of(ping, b);
    const double expected = 20 * std::log10(std::cos(angle)) - 2 * cube.absorption_db_per_m * (range - swath_altitude);
    EXPECT_NEAR(10 * std::log10(energy / middle), expected, 0.5) << degrees(angle);
    EXPECT_NEAR(reached / range, 1, 0.01) << degrees(angle);
  }

  // Returns lie on the bed, out to where the outermost beams meet it, within half a footprint.
  succeed("survey line.toml -q -o run");
  succeed("merge -q run --mosaic 0.1");
  const double edge = ping.fan.azimuth.back(), range = swath_altitude / std::cos(edge);
  const double footprint = range * ping.fan.beam_width / std::pow(std::cos(edge), 2);
  double port = 0, starboard = 0;
  const Soundings returns = load_soundings(path("run/returns.ply"));
  std::size_t of_bed = 0;
  for (std::size_t i = 0; i < returns.size(); ++i) {
    if (returns.true_surfel[i] == Soundings::none) continue;  // side lobes
    ++of_bed;
    const Eigen::Vector3d& p = returns.position[i];
    port = std::max(port, p.y()), starboard = std::min(starboard, p.y());
    EXPECT_NEAR(p.z(), -swath_altitude, 0.05);
  }
  EXPECT_GT(static_cast<double>(of_bed), 0.9 * static_cast<double>(returns.size()));
  EXPECT_NEAR(port, swath_altitude * std::tan(std::abs(edge)), footprint);
  EXPECT_NEAR(starboard, -swath_altitude * std::tan(std::abs(edge)), footprint);
}
