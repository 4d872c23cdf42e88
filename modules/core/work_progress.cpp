// SPDX-License-Identifier: BSD-3-Clause
#include "core/work_progress.hpp"

#include <atomic>
#include <chrono>

namespace insonify {
namespace {

using Clock = std::chrono::steady_clock;

std::atomic<bool> observing{false}, loop_runs{false};
std::atomic<const char*> stage_name{""};
std::atomic<std::size_t> calls_done{0}, calls_in_all{0};
std::atomic<Clock::rep> loop_begin{0};

bool take_loop(std::size_t total) {
  return observing.load(std::memory_order_relaxed) && total > 1 && !loop_runs.exchange(true);
}

}  // namespace

void observe_work(bool on) { observing = on; }

void begin_stage(const char* name) { stage_name = name; }

WorkProgress work_progress() {
  const Clock::duration since(Clock::now().time_since_epoch().count() - loop_begin.load());
  return {stage_name, calls_done, calls_in_all, std::chrono::duration<double>(since).count()};
}

ObservedLoop::ObservedLoop(std::size_t total) : counts_(take_loop(total)) {
  if (!counts_) return;
  calls_done = 0;
  loop_begin = Clock::now().time_since_epoch().count();
  calls_in_all = total;
}

ObservedLoop::~ObservedLoop() {
  if (!counts_) return;
  calls_in_all = 0;
  loop_runs = false;
}

void ObservedLoop::count() { calls_done.fetch_add(1, std::memory_order_relaxed); }

}  // namespace insonify
