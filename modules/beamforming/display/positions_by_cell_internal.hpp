// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <utility>
#include <vector>

namespace insonify {

/// Numbers of items that blocks have in each cell: that of block b in cell c is at [b][c].
using ItemsOfBlocks = std::vector<std::vector<std::size_t>>;

/// Turns numbers of items into the places where the first of them stand in a list by cells: a cell's items are side by side,
/// in the order of the blocks. Returns the place where each cell begins, and behind the last one the number of all items.
inline std::vector<std::size_t> positions_by_cell(ItemsOfBlocks& items, std::size_t cells) {
  std::vector<std::size_t> next(cells, 0), first{0};
  first.reserve(cells + 1);
  for (const auto& of_block : items)
    for (std::size_t cell = 0; cell < cells; ++cell) next[cell] += of_block[cell];
  for (std::size_t& of_cell : next) {
    first.push_back(first.back() + of_cell);
    of_cell = first[first.size() - 2];
  }
  for (auto& of_block : items)
    for (std::size_t cell = 0; cell < cells; ++cell) next[cell] += std::exchange(of_block[cell], next[cell]);
  return first;
}

}  // namespace insonify
