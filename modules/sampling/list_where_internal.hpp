// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/parallel.hpp"

namespace insonify {

/// Returns the indices in [0, n) for which test(index) is true, ascending.
template <typename Test>
std::vector<std::uint32_t> list_where(std::size_t n, int threads, Test&& test) {
  constexpr std::size_t block = 1 << 14;
  std::vector<std::vector<std::uint32_t>> sublists((n + block - 1) / block);
  parallel_blocks(n, block, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (test(i)) sublists[begin / block].push_back(static_cast<std::uint32_t>(i));
  });
  std::vector<std::uint32_t> list;
  list.reserve(std::accumulate(sublists.begin(), sublists.end(), std::size_t{0},
                               [](std::size_t sum, const auto& sublist) { return sum + sublist.size(); }));
  for (const auto& sublist : sublists) list.insert(list.end(), sublist.begin(), sublist.end());
  return list;
}

/// Returns the number of indices in [0, n) for which test(index) is true.
template <typename Test>
std::size_t count_where(std::size_t n, int threads, Test&& test) {
  std::atomic<std::size_t> count{0};
  parallel_blocks(n, 1 << 14, threads, [&](std::size_t begin, std::size_t end) {
    std::size_t here = 0;
    for (std::size_t i = begin; i < end; ++i) here += test(i) ? 1 : 0;
    count += here;
  });
  return count;
}

}  // namespace insonify
