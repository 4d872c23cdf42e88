// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace insonify {

/// Sorts items by the bits [begin_bit, end_bit) of the 64-bit number key(item), ascending; items of equal bits keep
/// their order. O(n) time for each ten bits in which keys differ; memory for a second array.
template <typename Item, typename Key>
void radix_sort(std::vector<Item>& items, int begin_bit, int end_bit, const Key& key) {
  constexpr int digit_bits = 10;
  std::uint64_t any = 0, all = ~std::uint64_t{0};
  for (const Item& item : items) any |= key(item), all &= key(item);
  std::vector<Item> sorted(items.size());
  for (int shift = begin_bit; shift < end_bit; shift += digit_bits) {
    const int bits = end_bit - shift < digit_bits ? end_bit - shift : digit_bits;
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    if (((any ^ all) >> shift & mask) == 0) continue;
    std::array<std::size_t, (std::size_t{1} << digit_bits) + 1> first{};
    for (const Item& item : items) ++first[(key(item) >> shift & mask) + 1];
    for (std::size_t d = 1; d < first.size(); ++d) first[d] += first[d - 1];
    for (const Item& item : items) sorted[first[key(item) >> shift & mask]++] = item;
    items.swap(sorted);
  }
}

}  // namespace insonify
