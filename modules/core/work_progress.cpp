// SPDX-License-Identifier: BSD-3-Clause
#include "core/work_progress.hpp"

#include <atomic>
#include <chrono>
#include <utility>

#include "core/stop_request.hpp"

namespace insonify {
namespace {

using Clock = std::chrono::steady_clock;

std::atomic<bool> observing{false}, loop_runs{false};
std::atomic<const char*> stage_name{""};
std::atomic<std::size_t> calls_done{0}, calls_in_all{0};
std::atomic<Clock::rep> loop_begin{0};
thread_local const std::atomic<bool>* stop_of_thread = nullptr;

void throw_if_stopped() {
  if (stop_of_thread && stop_of_thread->load(std::memory_order_relaxed)) throw Stopped{};
}

/// Returns true if a loop is counted: for a display, or because its thread may be asked to stop.
bool take_loop(std::size_t total) {
  throw_if_stopped();
  if (stop_of_thread) return true;
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
  if (!counts_ || stop_of_thread) return;
  calls_done = 0;
  loop_begin = Clock::now().time_since_epoch().count();
  calls_in_all = total;
}

ObservedLoop::~ObservedLoop() {
  if (!counts_ || stop_of_thread) return;
  calls_in_all = 0;
  loop_runs = false;
}

void ObservedLoop::count() {
  throw_if_stopped();
  if (observing.load(std::memory_order_relaxed)) calls_done.fetch_add(1, std::memory_order_relaxed);
}

StopScope::StopScope(const std::atomic<bool>& stop) : outer_(std::exchange(stop_of_thread, &stop)) {}

StopScope::~StopScope() { stop_of_thread = outer_; }

}  // namespace insonify
