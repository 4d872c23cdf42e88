// SPDX-License-Identifier: BSD-3-Clause
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

TEST(ParallelFor, within_another_calls_every_index_once) {
  std::vector<std::vector<int>> calls(50, std::vector<int>(40, 0));
  parallel_for(calls.size(), 4,
               [&](std::size_t k) { parallel_for(calls[k].size(), 4, [&, k](std::size_t i) { ++calls[k][i]; }); });
  for (const std::vector<int>& of_loop : calls) EXPECT_THAT(of_loop, testing::Each(1));
}

TEST(ParallelFor, from_several_threads_at_once) {
  std::vector<std::size_t> sums(4, 0);
  {
    std::vector<std::jthread> callers;
    for (std::size_t& sum : sums)
      callers.emplace_back([&sum] {
        for (int loop = 0; loop < 200; ++loop) {
          std::atomic<std::size_t> here{0};
          parallel_for(10, 3, [&](std::size_t i) { here += i; });
          sum += here;
        }
      });
  }
  EXPECT_THAT(sums, testing::Each(200 * 45));
}

TEST(ParallelFor, uses_as_many_threads_as_it_may) {
  // Each call waits for the others, so that all threads must be there at once.
  std::atomic<int> there{0};
  parallel_for(4, 4, [&](std::size_t) {
    ++there;
    while (there < 4) std::this_thread::yield();
  });
  EXPECT_EQ(there, 4);
}

TEST(ParallelFor, in_a_forked_child_works_alone) {
  parallel_for(100, 4, [](std::size_t) {});
  const pid_t child = fork();
  if (child == 0) {
    std::atomic<std::size_t> sum{0};
    parallel_for(100, 4, [&](std::size_t i) { sum += i; });
    _exit(sum == 4950U ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST(ParallelBlocks, tile_the_range_without_overlap) {
  std::vector<int> calls(103, 0);
  parallel_blocks(calls.size(), 10, 3, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++calls[i];
  });
  for (const int c : calls) EXPECT_EQ(c, 1);
}
