// SPDX-License-Identifier: BSD-3-Clause
#include "core/positions_by_group.hpp"

#include <algorithm>

#include "core/random.hpp"
#include "support/test.hpp"

TEST(PositionsByGroup, put_items_where_a_stable_sort_puts_them) {
  constexpr std::size_t groups = 7, block = 10;
  std::vector<std::size_t> group;
  for (std::uint64_t i = 0; i < 95; ++i)
    group.push_back(
        static_cast<std::size_t>(6 * random_uniform(3, RandomStage::noise, {i, 0, 0})[0]));  // the last is empty
  ItemsOfBlocks items((group.size() + block - 1) / block, std::vector<std::size_t>(groups, 0));
  for (std::size_t i = 0; i < group.size(); ++i) ++items[i / block][group[i]];

  const std::vector<std::size_t> first = positions_by_group(items, groups);
  std::vector<std::size_t> list(group.size()), sorted(group.size());
  for (std::size_t i = 0; i < group.size(); ++i) list[items[i / block][group[i]]++] = sorted[i] = i;
  std::stable_sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) { return group[a] < group[b]; });
  EXPECT_EQ(list, sorted);
  ASSERT_EQ(first.size(), groups + 1);
  for (std::size_t g = 0; g < groups; ++g)
    EXPECT_EQ(first[g + 1] - first[g], static_cast<std::size_t>(std::count(group.begin(), group.end(), g))) << g;
}

TEST(PositionsByGroup, of_no_blocks_are_zero) {
  ItemsOfBlocks none;
  EXPECT_EQ(positions_by_group(none, 3), std::vector<std::size_t>(4, 0));
}
