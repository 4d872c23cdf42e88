// SPDX-License-Identifier: BSD-3-Clause
// Compares a planar array, gridded in time, u and v at once, with the sum over echoes.
#include "beamforming/gridded/gridded_engine.hpp"
#include "core/random.hpp"
#include "sonar/shading.hpp"
#include "support/echo_chunks.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

constexpr double planar_c = 1500, planar_wavelength = planar_c / 750e3;

struct PlanarCase {
  std::size_t elements = 24, column = 17, beams = 9, rows = 7;
  double row_field = 30;     ///< [deg]
  double row_spacing = 0.5;  ///< spacing of the column [wavelengths]
  bool slope = false, moving = false;
  double low_v = -0.9, high_v = 0.9;
  std::size_t echoes = 1500;

  SonarHead head() const {
    SonarHead head;
    head.pulse = {750e3, 60e3, 220};
    head.gate = {1, 2, default_bin_size(head.pulse, planar_c)};
    head.array = {planar_wavelength / 2, taylor_shading(elements, -30)};
    head.column = LineArray{row_spacing * planar_wavelength, taylor_shading(column, -30)};
    head.elevation_shape = ElevationShape::sector;
    head.fan.beam_width = array_beam_width(head.array, planar_wavelength);
    head.fan.row_width = array_beam_width(*head.column, planar_wavelength);
    head.fan.elevation_width = radians(60);
    for (const double elevation : make_fan(rows, radians(row_field), 1, 1).azimuth)
      for (const double azimuth : make_fan(beams, radians(40), 1, 1).azimuth)
        head.fan.azimuth.push_back(azimuth), head.fan.elevation.push_back(elevation);
    return head;
  }
  Medium medium() const { return {planar_c, {0.1, slope ? 2e-6 : 0, slope ? 2e-12 : 0}}; }
  Echoes crowd() const {
    Echoes e;
    for (std::uint64_t i = 0; i < echoes; ++i) {
      const auto x = random_uniform(3, RandomStage::scene_points, {i, 0, 0});
      const auto y = random_uniform(4, RandomStage::scene_points, {i, 0, 0});
      e.delay.push_back(2 * (0.95 + 1.1 * x[0]) / planar_c);  // some begin or end outside the gate
      e.u.push_back(-0.9 + 1.8 * x[1]);
      e.v.push_back(low_v + (high_v - low_v) * y[0]);
      e.amplitude.push_back(std::polar(std::pow(10, -2 * x[2]), 2 * pi * x[3]));
      if (moving) e.doppler.push_back(2000 * (2 * y[1] - 1));
    }
    return e;
  }
};

void expect_promise_of(const PlanarCase& c) {
  const SonarHead head = c.head();
  const Echoes echoes = c.crowd();
  const ComplexGrid exact = synthesize(echoes, head, c.medium(), SynthesisMethod::direct);
  for (const double tolerance : {1e-1, 1e-2, 1e-4, 1e-6, 1e-9, 1e-12})
    EXPECT_LT(relative_l2(GriddedEngine(head, c.medium(), {tolerance, 2}).pressure(echoes), exact), tolerance)
        << tolerance;
}

}  // namespace

TEST(PlanarEngine, keeps_its_tolerance_against_the_referee) { expect_promise_of({}); }

// The signs of whole cycles and of the ends of the grid: half-integer places of elements along the column, too.
TEST(PlanarEngine, keeps_its_tolerance_for_an_even_column) { expect_promise_of({.elements = 25, .column = 18}); }

TEST(PlanarEngine, keeps_its_tolerance_where_the_column_has_grating_lobes) {
  expect_promise_of({.column = 12, .row_spacing = 1.3});
}

TEST(PlanarEngine, keeps_its_tolerance_for_one_echo) { expect_promise_of({.echoes = 1}); }

TEST(PlanarEngine, keeps_its_tolerance_where_each_echo_has_its_own_pulse) {
  expect_promise_of({.slope = true, .moving = true, .echoes = 4000});
}

// Only side lobes receive the echoes. The image shows that, and is repeated more accurately.
TEST(PlanarEngine, keeps_its_tolerance_above_all_rows) { expect_promise_of({.low_v = 0.6, .high_v = 0.8}); }

// More rows than are formed at a time, and a grid of several blocks of columns.
TEST(PlanarEngine, keeps_its_tolerance_for_many_rows) {
  const PlanarCase c{.elements = 70, .beams = 2, .rows = 53};
  const SonarHead head = c.head();
  const Echoes echoes = c.crowd();
  ASSERT_TRUE(GriddedEngine::suits(head));
  EXPECT_LT(relative_l2(synthesize(echoes, head, c.medium(), SynthesisMethod::gridded, {1e-4, 2}),
                        synthesize(echoes, head, c.medium(), SynthesisMethod::direct)),
            1e-4);
}

TEST(PlanarEngine, gives_the_same_bytes_for_any_threads_stored_or_in_chunks) {
  const PlanarCase c{.slope = true, .echoes = 4000};
  const SonarHead head = c.head();
  const Echoes echoes = c.crowd();
  const GriddedEngine one(head, c.medium(), {1e-4, 1}), other(head, c.medium(), {1e-4, 3});
  const ComplexGrid image = one.pressure(echoes);
  EXPECT_TRUE((image == other.pressure(echoes)).all());
  EXPECT_TRUE((image == one.pressure(echoes)).all()) << "working memory is used again";
  EXPECT_TRUE((image == other.pressure(EchoChunks(echoes, planar_c))).all());
  EXPECT_TRUE(
      (image == synthesize(EchoChunks(echoes, planar_c), head, c.medium(), SynthesisMethod::gridded, {1e-4, 2})).all());
}

TEST(PlanarEngine, adds_a_hundred_thousand_echoes_of_one_place_in_single_precision) {
  const PlanarCase c{.beams = 3, .rows = 3};
  const SonarHead head = c.head();
  Echoes hot;
  hot.delay.assign(100000, 2 * head.gate.centre(50) / planar_c);
  hot.u.assign(100000, 0.1), hot.v.assign(100000, 0.05), hot.amplitude.assign(100000, {1, 0});
  const Echoes one{{hot.delay[0]}, {0.1}, {{1e5, 0}}, {0.05}};
  EXPECT_LT(relative_l2(GriddedEngine(head, c.medium(), {1e-4, 0}).pressure(hot),
                        synthesize(one, head, c.medium(), SynthesisMethod::direct)),
            1e-4);
}
