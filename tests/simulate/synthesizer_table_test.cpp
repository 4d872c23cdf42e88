// What forms beams is made once for each medium, method and tolerance, and the last few stay.
#include "core/parallel.hpp"
#include "simulate/synthesizer_table_internal.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

using Part = SynthesizerTable::Part;

const SonarHead table_head = line_head({.beams = 9, .elements = 32, .min_range = 2, .max_range = 4});

Medium medium_of_speed(double sound_speed) { return {sound_speed, {0.02, 0, 0}}; }

/// CPU time of the image of one echo [s]: most of it makes tables, if there are none.
double seconds_of_image(const Synthesizer& synthesizer) {
  Echoes echo;
  echo.delay = {2 * 3.0 / 1490}, echo.u = {0.1}, echo.amplitude = {1.0};
  const std::clock_t begin = std::clock();
  EXPECT_GT(synthesizer.pressure(echo).abs().maxCoeff(), 0);
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

}  // namespace

TEST(SynthesizerTable, makes_one_for_each_part_medium_method_and_tolerance) {
  SynthesizerTable table;
  const auto image_of = [&](Part part, double sound_speed, SynthesisMethod method, double tolerance) {
    Echoes echo;
    echo.delay = {2 * 3.0 / 1490}, echo.u = {0.1}, echo.amplitude = {1.0};
    return table.of(part, table_head, medium_of_speed(sound_speed), method, {tolerance, 1}).pressure(echo);
  };
  using enum SynthesisMethod;
  for (int again = 0; again < 2; ++again)
    for (const double c : {1490.0, 1500.0})
      for (const SynthesisMethod method : {gridded, true_delays})
        for (const double tolerance : {1e-2, 1e-3}) {
          Echoes echo;
          echo.delay = {2 * 3.0 / 1490}, echo.u = {0.1}, echo.amplitude = {1.0};
          const ComplexGrid fresh = synthesize(echo, table_head, medium_of_speed(c), method, {tolerance, 1});
          for (const Part part : {Part::whole, Part::port_half})
            EXPECT_TRUE((image_of(part, c, method, tolerance) == fresh).all()) << c << ' ' << tolerance;
        }
}

TEST(SynthesizerTable, keeps_what_the_next_ping_needs) {
  SynthesizerTable table;
  const auto of = [&](double sound_speed) {
    return table.of(Part::whole, table_head, medium_of_speed(sound_speed), SynthesisMethod::true_delays, {1e-4, 1});
  };
  double first = 0, later = 0;
  for (int k = 0; k < 5; ++k) {
    first += seconds_of_image(of(1490 + k));
    later += seconds_of_image(of(1490 + k));
  }
  EXPECT_LT(later, 0.7 * first);
}
