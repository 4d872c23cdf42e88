// SPDX-License-Identifier: BSD-3-Clause
#include "tool/command/progress.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/work_progress.hpp"
#include "files/pending_path.hpp"
#include "tool/command/program.hpp"

namespace insonify::tool {
namespace {

constexpr const char* nothing_kept = "nothing was written";
std::atomic<bool> interrupted{false}, ending{false};
std::atomic<const char*> kept_at_once{nothing_kept};
Progress* shown_progress = nullptr;  // the last that was made, of which there is one at a time
static_assert(std::atomic<bool>::is_always_lock_free);

// Signals that ask for an end, but for those that the caller has the program ignore, as nohup does.
sigset_t interrupts() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN) sigaddset(&set, signal);
  }
  return set;
}

// Waits for interrupts, in a thread of its own, so that libraries which take long or never return do not matter.
void wait_for_interrupts() {
  const sigset_t set = interrupts();
  int signal = 0;
  while (sigwait(&set, &signal) != 0) {
  }
  interrupted = true;
  if (kept_at_once.load() != nothing_kept)
    while (sigwait(&set, &signal) != 0) {
    }
  ending = true;
  discard_pending_paths();
  std::fprintf(stderr, "%sinsonify: interrupted; %s\n", isatty(STDERR_FILENO) ? "\r\033[K" : "", kept_at_once.load());
  _exit(130);
}

}  // namespace

void end_on_interrupt() {
  const sigset_t set = interrupts();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  std::thread(wait_for_interrupts).detach();
}

void finish_on_interrupt(const char* kept) { kept_at_once = kept; }

void wait_for_end() {
  while (ending) pause();
}

bool is_interrupted() { return interrupted; }

void end_progress() {
  if (Progress* const shown = shown_progress) shown->finish();
}

void print_summary(const CommonOptions& common, const nlohmann::ordered_json& result, const std::string& line) {
  end_progress();
  if (common.json)
    fmt::print("{}\n", result.dump(2));
  else if (!common.quiet)
    fmt::print("{}\n", line);
}

std::string time_text(double seconds) {
  const long s = std::lround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{}:{:02} min", s / 60, s % 60);
  return fmt::format("{}:{:02} h", s / 3600, s / 60 % 60);
}

Progress::Progress(const CommonOptions& common, int steps)
    : quiet_(common.quiet),
      verbose_(common.verbose),
      bar_(!common.quiet && !common.verbose && isatty(STDERR_FILENO) != 0),
      steps_(steps) {
  if (!bar_) return;
  shown_progress = this;
  observe_work(true);
  watcher_ = std::jthread([this](const std::stop_token& end) { watch_loops(end); });
}

Progress::~Progress() {
  finish();
  if (shown_progress == this) shown_progress = nullptr;
}

void Progress::finish() {
  if (!watcher_.joinable()) return;
  observe_work(false);
  watcher_.request_stop();
  watcher_.join();
  clear_bar();
}

void Progress::watch_loops(const std::stop_token& end) {
  std::unique_lock lock(guard_);
  while (!ended_.wait_for(lock, end, std::chrono::milliseconds(250), [] { return false; }) && !end.stop_requested())
    if (bar_shown_ && shows_loops_) draw_bar();
}

void Progress::draw_bar() {
  constexpr int width = 24;
  constexpr double shown_from = 0.7;  // seconds that a loop runs before it is worth a word
  const WorkProgress work = work_progress();
  std::string text = what_;
  double share = part_;
  if (shows_loops_ && work.total > 1 && work.loop_seconds > shown_from) {
    const double of_loop = static_cast<double>(work.done) / static_cast<double>(work.total);
    share += of_loop / steps_;
    text += fmt::format(": {}{:.0f} %", *work.stage ? std::string(work.stage) + " " : "", 100 * of_loop);
    if (of_loop > 0.02) text += fmt::format(", {} left", time_text(work.loop_seconds * (1 / of_loop - 1)));
  }
  const auto filled = static_cast<std::size_t>(width * std::min(1.0, share));
  fmt::print(stderr, "\r\033[K[{}{}] {}", std::string(filled, '#'), std::string(width - filled, '.'), text);
  std::fflush(stderr);
  bar_shown_ = true;
}

void Progress::clear_bar() {
  if (bar_shown_) std::fputs("\r\033[K", stderr);
  bar_shown_ = false;
}

void Progress::step(const std::string& what) {
  const std::scoped_lock lock(guard_);
  if (verbose_) std::fprintf(stderr, "[%d/%d] %s\n", done_ + 1, steps_, what.c_str());
  part_ = static_cast<double>(done_) / steps_;
  what_ = what;
  shows_loops_ = true;
  ++done_;
  begin_stage("");
  if (bar_) draw_bar();
}

void Progress::show(double share, const std::string& what) {
  const std::scoped_lock lock(guard_);
  part_ = share;
  what_ = what;
  shows_loops_ = false;
  if (bar_) draw_bar();
}

void Progress::note(const std::string& sentence) {
  if (quiet_) return;
  const std::scoped_lock lock(guard_);
  clear_bar();
  print_error(sentence);
}

}  // namespace insonify::tool
