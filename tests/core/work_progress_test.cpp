// SPDX-License-Identifier: BSD-3-Clause
#include "core/work_progress.hpp"

#include "core/parallel.hpp"
#include "support/test.hpp"

namespace {

class WorkProgressTest : public testing::Test {
 protected:
  void SetUp() override { observe_work(true); }
  void TearDown() override { observe_work(false); }
};

}  // namespace

TEST_F(WorkProgressTest, counts_the_calls_of_the_outermost_loop) {
  begin_stage("counting");
  for (const int threads : {1, 3}) {
    std::atomic<std::size_t> most{0};
    std::atomic<bool> in_order{true};
    parallel_for(20, threads, [&](std::size_t) {
      parallel_for(1000, 2, [](std::size_t) {});  // inner loops do not count
      const WorkProgress now = work_progress();
      if (now.total != 20 || now.done > 19) in_order = false;
      most = std::max(most.load(), now.done);
    });
    EXPECT_TRUE(in_order);
    EXPECT_GE(most, 20U - static_cast<std::size_t>(threads) - 1);
    EXPECT_EQ(work_progress().total, 0U);
  }
  EXPECT_STREQ(work_progress().stage, "counting");
}

TEST_F(WorkProgressTest, ends_with_a_loop_that_throws) {
  EXPECT_THROW(parallel_for(5, 2, [](std::size_t) { throw 1; }), int);
  EXPECT_EQ(work_progress().total, 0U);
}

TEST(WorkProgressOff, counts_nothing) {
  parallel_for(5, 1, [](std::size_t) { EXPECT_EQ(work_progress().total, 0U); });
}
