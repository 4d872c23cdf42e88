// SPDX-License-Identifier: BSD-3-Clause
#include "scene/material_shares.hpp"

#include <gtest/gtest.h>

namespace {

using namespace insonify;

const std::vector<Material> table = {{.name = "sand"}, {.name = "rock"}, {.name = "steel"}};

TEST(MaterialShares, areas_of_materials_that_occur) {
  const std::vector<std::uint16_t> material = {2, 0, 2, 0, 0};
  const std::vector<float> area = {1, 2, 3, 4, 6};
  const std::vector<MaterialShare> shares = material_shares(table, material, area);
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_EQ(shares[0].name, "sand");
  EXPECT_EQ(shares[0].points, 3u);
  EXPECT_DOUBLE_EQ(*shares[0].area, 12);
  EXPECT_DOUBLE_EQ(shares[0].share, 0.75);
  EXPECT_EQ(shares[1].name, "steel");
  EXPECT_DOUBLE_EQ(shares[1].share, 0.25);
}

TEST(MaterialShares, points_are_counted_where_areas_are_not_known) {
  const std::vector<std::uint16_t> material = {7, 1, 1, 1};
  const std::vector<MaterialShare> shares = material_shares(table, material, {});
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_EQ(shares[0].name, "rock");
  EXPECT_FALSE(shares[0].area);
  EXPECT_DOUBLE_EQ(shares[0].share, 0.75);
  EXPECT_EQ(shares[1].name, "label 7");
}

TEST(MaterialShares, no_area_at_all_gives_no_share) {
  const std::vector<MaterialShare> shares =
      material_shares(table, std::vector<std::uint16_t>{0}, std::vector<float>{0});
  EXPECT_EQ(shares.at(0).share, 0);
}

}  // namespace
