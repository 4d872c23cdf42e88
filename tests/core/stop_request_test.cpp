// SPDX-License-Identifier: BSD-3-Clause
#include "core/stop_request.hpp"

#include <optional>

#include "core/parallel.hpp"
#include "support/test.hpp"

TEST(StopRequest, ends_the_loop_that_runs_and_those_that_begin) {
  for (const int threads : {1, 3}) {
    std::atomic<bool> stop{false};
    const StopScope scope(stop);
    std::atomic<int> calls{0};
    EXPECT_THROW(parallel_for(1000000, threads,
                              [&](std::size_t) {
                                ++calls;
                                stop = true;
                              }),
                 Stopped);
    EXPECT_LT(calls, 1000000);
    EXPECT_THROW(parallel_for(1, 1, [&](std::size_t) { calls = -1; }), Stopped);
    EXPECT_NE(calls, -1);
  }
}

TEST(StopRequest, concerns_its_thread_and_its_scope_alone) {
  std::atomic<bool> stop{true}, go_on{false};
  std::optional<StopScope> outer(stop);
  {
    const StopScope inner(go_on);
    EXPECT_NO_THROW(parallel_for(3, 1, [](std::size_t) {}));
  }
  std::thread([] { EXPECT_NO_THROW(parallel_for(3, 1, [](std::size_t) {})); }).join();
  EXPECT_THROW(parallel_for(3, 1, [](std::size_t) {}), Stopped);
  outer.reset();
  EXPECT_NO_THROW(parallel_for(3, 1, [](std::size_t) {}));
}
