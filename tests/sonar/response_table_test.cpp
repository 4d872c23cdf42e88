// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/response_table.hpp"

#include "sonar/shading.hpp"
#include "sonar/sonar_head.hpp"
#include "support/test.hpp"

namespace {

constexpr double table_wavelength = 0.002;

/// Returns shaded arrays of even and odd numbers of elements, half a table_wavelength apart, and wider.
std::vector<LineArray> arrays() {
  std::vector<LineArray> all = {{0.001, {1}}, {0.001, {1, 1}}, {0.0031, {0.5, 2, 0.5}}};
  for (const double width : {8.0, 1.0})
    all.push_back(array_for_beam_width(radians(width), table_wavelength, Shading::taylor, -30));
  all.push_back(all.back());
  all.back().spacing = 0.0027;
  return all;
}

}  // namespace

TEST(ResponseTable, is_the_direct_sum_within_its_stated_error) {
  for (const LineArray& array : arrays()) {
    const ResponseTable table(array, table_wavelength);
    for (int i = -2000; i <= 2000; ++i) {
      const double offset = i / 1000.0, b = array_response(array, table_wavelength, offset, 0).real();
      ASSERT_NEAR(std::sqrt(table.intensity(offset)), std::abs(b), 1e-5) << array.elements() << " at " << offset;
    }
  }
}

TEST(ResponseTable, responds_wherever_the_response_is_above_the_floor) {
  for (const LineArray& array : arrays()) {
    const ResponseTable table(array, table_wavelength);
    const double reach = table.reach(1e-4);
    for (int i = 0; i <= 2000; ++i) {
      const double offset = i / 1000.0;
      if (table.intensity(offset) > 1.01e-4) {
        ASSERT_TRUE(table.responds_to(offset, offset, reach)) << array.elements() << " at " << offset;
        ASSERT_TRUE(table.responds_to(std::max(0.0, offset - 0.1), offset + 0.1, reach));
      }
    }
  }
}

TEST(ResponseTable, does_not_respond_far_from_every_lobe) {
  const LineArray array = array_for_beam_width(radians(1), table_wavelength, Shading::taylor, -30);
  const ResponseTable table(array, table_wavelength);
  const double reach = table.reach(1e-4);
  EXPECT_LT(reach, 0.5);
  EXPECT_FALSE(table.responds_to(0.6, 0.7, reach));
  EXPECT_TRUE(table.responds_to(0.6, 2, reach));
}

TEST(ResponseTable, refuses_an_invalid_wavelength) { EXPECT_THROW(ResponseTable({0.001, {1}}, 0), Error); }
