// SPDX-License-Identifier: BSD-3-Clause
#include "core/ordered_work.hpp"

#include <atomic>

#include "core/parallel.hpp"
#include "support/test.hpp"

TEST(OrderedWork, gives_all_items_in_order_and_holds_two_for_each_thread) {
  for (const std::size_t threads : {1, 3}) {
    std::atomic<int> held{0}, most{0};
    OrderedWork<std::size_t> work(50, threads, [&](std::size_t i) {
      most = std::max<int>(most, ++held);
      std::this_thread::sleep_for(std::chrono::microseconds(i % 7 * 100));
      return i * i;
    });
    for (std::size_t i = 0; i < work.count(); ++i) {
      EXPECT_EQ(work.next(), i * i);
      --held;
    }
    EXPECT_EQ(work.next(), std::nullopt);
    EXPECT_LE(most, static_cast<int>(2 * threads) + 1);
  }
}

TEST(OrderedWork, gives_each_item_once_to_several_threads) {
  OrderedWork<int> work(300, 2, [](std::size_t i) { return static_cast<int>(i); });
  std::atomic<int> sum{0}, given{0};
  const auto take = [&] {
    while (const auto item = work.next()) sum += *item, ++given;
  };
  std::thread other(take);
  take();
  other.join();
  EXPECT_EQ(given, 300);
  EXPECT_EQ(sum, 299 * 150);
}

TEST(OrderedWork, ends_with_the_error_of_an_item_in_its_turn) {
  OrderedWork<int> work(10, 3, [](std::size_t i) {
    if (i == 4) throw std::runtime_error("four");
    return static_cast<int>(i);
  });
  for (int i = 0; i < 4; ++i) EXPECT_EQ(work.next(), i);
  EXPECT_THROW(work.next(), std::runtime_error);
  EXPECT_EQ(work.next(), std::nullopt);
}

TEST(OrderedWork, a_look_that_throws_stops_loops_that_run) {
  const auto endless = [](std::size_t) {
    parallel_for(std::size_t{1} << 40, 1, [](std::size_t) { std::this_thread::yield(); });
    return 0;
  };
  const auto begin = std::chrono::steady_clock::now();
  {
    OrderedWork<int> work(4, 2, endless);
    EXPECT_THROW(work.next([] { throw 1; }), int);
    const OrderedWork<int> left_alone(4, 2, endless);  // its destructor stops the work, too
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}
