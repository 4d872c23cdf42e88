// SPDX-License-Identifier: BSD-3-Clause
// Compares the energy that all beams receive from a direction, by tables, with the sum of their responses.
#include "simulate/received_energy.hpp"

#include "sonar/line_array.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

/// Returns nine beams in three rows.
SonarHead head_of_rows() {
  SonarHead head = line_head({.beams = 9, .elements = 24, .min_range = 2, .max_range = 4});
  head.fan.azimuth = {-0.2, 0, 0.2, -0.2, 0, 0.2, -0.2, 0, 0.2};
  head.fan.elevation = {-0.15, -0.15, -0.15, 0, 0, 0, 0.2, 0.2, 0.2};
  return head;
}

}  // namespace

TEST(ReceivedEnergy, of_a_planar_array_is_the_sum_over_its_rows) {
  SonarHead head = head_of_rows();
  head.fan.row_width = 0.1;
  const double wavelength = 1490 / head.pulse.centre_frequency;
  for (const std::size_t elements : {12, 32}) {
    head.column = LineArray{0.6 * wavelength, uniform_shading(elements)};
    const ReceivedEnergy received(head, wavelength);
    double largest = 0, worst = 0;
    for (double v = -0.7; v <= 0.7; v += 0.013) {
      double rows = 0;
      for (const double elevation : {-0.15, 0.0, 0.2})
        rows += std::norm(array_response(*head.column, wavelength, v, std::sin(elevation)));
      largest = std::max(largest, rows);
      worst = std::max(worst, std::abs(received.at(0.03, v) / received.along_array(0.03) - rows));
    }
    EXPECT_LT(worst, 0.01 * largest) << elements;
  }
}

TEST(ReceivedEnergy, of_rows_without_a_column_is_that_of_their_patterns) {
  const SonarHead head = head_of_rows();
  const double wavelength = 1490 / head.pulse.centre_frequency;
  const ReceivedEnergy received(head, wavelength);
  for (double v = -0.5; v <= 0.5; v += 0.017) {
    double rows = 0;
    for (const double elevation : {-0.15, 0.0, 0.2})
      rows += std::pow(RowResponse(head, wavelength, elevation).at(v), 2);
    EXPECT_NEAR(received.at(0.03, v), received.along_array(0.03) * rows, 0.01 * received.along_array(0.03)) << v;
  }
}
