// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "core/stop_request.hpp"

namespace insonify {

/// Makes items on threads of its own and gives them in order. Memory holds at most two items for each thread.
template <typename Item>
class OrderedWork {
 public:
  /// Starts to make `count` items on `threads` threads (at least 1). Any of these threads calls make(i), which returns
  /// item i.
  OrderedWork(std::size_t count, std::size_t threads, std::function<Item(std::size_t)> make)
      : count_(count), ahead_(2 * threads), make_(std::move(make)) {
    try {
      while (threads_.size() < std::min(threads, count)) threads_.emplace_back(&OrderedWork::work, this);
    } catch (const std::system_error&) {
      if (threads_.empty()) throw;  // the system gives no more threads: work with those that run
    }
  }
  /// Stops the running calls by StopScope and waits for them, about as long as one call of a parallel loop takes.
  ~OrderedWork() { stop(); }
  OrderedWork(const OrderedWork&) = delete;
  OrderedWork& operator=(const OrderedWork&) = delete;

  /// Returns the number of all items.
  std::size_t count() const { return count_; }

  /// Waits for the next item and returns it, or nothing after the last. While it waits, it calls `look` ten times a
  /// second. An exception of `look` or of make(i) ends all work and is thrown here. Several threads may call this
  /// function; it returns each item once.
  std::optional<Item> next(const std::function<void()>& look = [] {}) try {
    std::unique_lock lock(guard_);
    const auto may_continue = [&] { return given_ == count_ || made_.contains(given_); };
    while (!changed_.wait_for(lock, std::chrono::milliseconds(100), may_continue)) {
      lock.unlock();
      look();
      lock.lock();
    }
    if (given_ == count_) return std::nullopt;
    std::future<Item> made = std::move(made_.extract(given_++).mapped());
    lock.unlock();
    changed_.notify_all();
    return made.get();
  } catch (...) {
    stop();
    throw;
  }

 private:
  void work() {
    const StopScope scope(stop_);
    std::unique_lock lock(guard_);
    while (true) {
      changed_.wait(lock, [&] { return stop_ || begun_ == count_ || begun_ < given_ + ahead_; });
      if (stop_ || begun_ == count_) return;
      const std::size_t mine = begun_++;
      lock.unlock();
      std::packaged_task<Item()> task([&] { return make_(mine); });
      std::future<Item> made = task.get_future();
      task();  // exceptions go to the future
      lock.lock();
      made_.emplace(mine, std::move(made));
      changed_.notify_all();
    }
  }

  void stop() {
    std::vector<std::thread> ending;
    {
      const std::scoped_lock lock(guard_);
      stop_ = true;
      given_ = count_;
      ending.swap(threads_);
    }
    changed_.notify_all();
    for (std::thread& thread : ending) thread.join();
  }

  const std::size_t count_, ahead_;
  const std::function<Item(std::size_t)> make_;
  std::atomic<bool> stop_{false};
  std::mutex guard_;  // guards all members below
  std::condition_variable changed_;
  std::size_t begun_ = 0, given_ = 0;
  std::map<std::size_t, std::future<Item>> made_;
  std::vector<std::thread> threads_;
};

}  // namespace insonify
