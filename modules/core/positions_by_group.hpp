// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

namespace insonify {

/// Numbers of items that blocks of a list have in each group: that of block b in group g is at [b][g].
using ItemsOfBlocks = std::vector<std::vector<std::size_t>>;

/// Turns numbers of items into the positions at which the first of them go in a list by groups: a group's items stand side
/// by side, in the order of the blocks, and each thread can put the items of a block by itself.
/// Returns the position where each group begins, and behind the last one the number of all items.
inline std::vector<std::size_t> positions_by_group(ItemsOfBlocks& items, std::size_t groups) {
  std::vector<std::size_t> next(groups, 0), first{0};
  first.reserve(groups + 1);
  for (const auto& of_block : items)
    for (std::size_t group = 0; group < groups; ++group) next[group] += of_block[group];
  for (std::size_t& of_group : next) {
    first.push_back(first.back() + of_group);
    of_group = first[first.size() - 2];
  }
  for (auto& of_block : items)
    for (std::size_t group = 0; group < groups; ++group) next[group] += std::exchange(of_block[group], next[group]);
  return first;
}

}  // namespace insonify
