#include "tool/sounding_map.hpp"

#include "support/test.hpp"

using tool::cell_of, tool::SoundingMap;

// The cells of a grid are half open: an edge belongs to the cell that begins there, whatever its coordinate is rounded to.
TEST(SoundingMap, gives_a_sounding_on_an_edge_to_the_cell_that_begins_there) {
  for (const double cell : {0.1, 0.25, 0.3, 0.5, 1.0})
    for (const double zero : {-100000.0, 0.0, 54000.0, 5654000.0})
      for (int k = 0; k < 300; ++k) {
        const double edge = std::round((zero + k) * cell * 1e6) / 1e6;  // as written in decimal
        const auto number = static_cast<std::int64_t>(zero) + k;
        EXPECT_EQ(cell_of(edge, cell), number) << edge << " by " << cell;
        EXPECT_EQ(cell_of(edge - 2e-6, cell), number - 1) << edge << " by " << cell;
        EXPECT_EQ(cell_of(edge + cell - 2e-6, cell), number) << edge << " by " << cell;
      }
  // Four soundings on corners of cells: one in each.
  SoundingMap map(0.1);
  for (const double x : {565400.1, 565400.2})
    for (const double y : {5995100.3, 5995100.4}) map.add({x, y, -10 * x - y}, 1);
  const std::vector<GeoBand> bands = map.bands();
  ASSERT_EQ(bands[2].values.rows(), 2);
  ASSERT_EQ(bands[2].values.cols(), 2);
  EXPECT_TRUE((bands[2].values == 1).all());
  EXPECT_NEAR(map.grid().west, 565400.1, 1e-9);
  EXPECT_NEAR(map.grid().south, 5995100.3, 1e-9);
}
