// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "core/work_progress.hpp"

namespace insonify {

/// Resolves a thread count: `threads` itself if positive, else the number of hardware threads.
inline int thread_count(int threads) {
  return threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

/// Calls work() on this thread and on up to `helpers` threads of a pool, as far as these become free in time. Returns
/// when all calls have returned. The calls divide the work among themselves, and must not throw.
void run_on_pool(std::size_t helpers, const std::function<void()>& work);

/// Calls body(i) once for every i in [0, n), on up to `threads` threads (0: all cores). body(i) must only write to data
/// of index i, so the result does not depend on `threads`. If a call throws, calls not yet started are skipped and the
/// first exception is rethrown.
template <typename Body>
void parallel_for(std::size_t n, int threads, Body&& body) {
  std::atomic<std::size_t> next{0};
  ObservedLoop observed(n);
  std::exception_ptr first;
  std::mutex first_guard;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < n; i = next++) {
        body(i);
        observed.advance();
      }
    } catch (...) {
      const std::scoped_lock lock(first_guard);
      if (!first) first = std::current_exception();
      next = n;
    }
  };
  const std::size_t wanted = std::min(n, static_cast<std::size_t>(thread_count(threads)));
  if (wanted > 1)
    run_on_pool(wanted - 1, std::ref(work));
  else
    work();
  if (first) std::rethrow_exception(first);
}

/// Calls body(begin, end) for consecutive blocks of `block` indices that partition [0, n); otherwise as parallel_for.
template <typename Body>
void parallel_blocks(std::size_t n, std::size_t block, int threads, Body&& body) {
  parallel_for((n + block - 1) / block, threads, [&](std::size_t b) { body(b * block, std::min(n, (b + 1) * block)); });
}

}  // namespace insonify
