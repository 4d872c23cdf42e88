#include "core/parallel.hpp"

#include "support/test.hpp"

TEST(ParallelFor, calls_every_index_once_for_any_thread_count) {
  for (const int threads : {1, 2, 7, 64}) {
    std::vector<int> calls(1000, 0);
    parallel_for(calls.size(), threads, [&](std::size_t i) { ++calls[i]; });
    EXPECT_EQ(std::accumulate(calls.begin(), calls.end(), 0), 1000) << threads << " threads";
    EXPECT_EQ(*std::max_element(calls.begin(), calls.end()), 1);
  }
}

TEST(ParallelFor, with_no_indices_does_nothing) {
  parallel_for(0, 4, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, rethrows_the_first_exception) {
  EXPECT_THROW(parallel_for(100, 2,
                            [](std::size_t i) {
                              if (i == 17) fail(ErrorKind::runtime, "ping ", i);
                            }),
               Error);
}

TEST(ParallelBlocks, tile_the_range_without_overlap) {
  std::vector<int> calls(103, 0);
  parallel_blocks(calls.size(), 10, 3, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++calls[i];
  });
  for (const int c : calls) EXPECT_EQ(c, 1);
}
