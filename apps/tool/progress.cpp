#include "tool/progress.hpp"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include <unistd.h>

namespace insonify::tool {
namespace {
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);
}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, [](int) { interrupted = true; });
  std::signal(SIGTERM, [](int) { interrupted = true; });
}

bool is_interrupted() { return interrupted; }

Progress::Progress(const CommonOptions& common, int steps)
    : quiet_(common.quiet),
      verbose_(common.verbose),
      bar_(!common.quiet && !common.verbose && isatty(STDERR_FILENO) != 0),
      steps_(steps) {}

Progress::~Progress() { clear_bar(); }

void Progress::clear_bar() {
  if (bar_shown_) std::fputs("\r\033[K", stderr);
  bar_shown_ = false;
}

void Progress::check() const {
  if (interrupted) throw Interrupted{};
}

void Progress::step(const std::string& what) {
  check();
  if (verbose_) std::fprintf(stderr, "[%d/%d] %s\n", done_ + 1, steps_, what.c_str());
  show(static_cast<double>(done_) / steps_, what);
  ++done_;
}

void Progress::show(double part, const std::string& what) {
  if (!bar_) return;
  constexpr int width = 24;
  const int filled = static_cast<int>(width * part);
  const std::string full(static_cast<std::size_t>(filled), '#'), empty(static_cast<std::size_t>(width - filled), '.');
  std::fprintf(stderr, "\r\033[K[%s%s] %s", full.c_str(), empty.c_str(), what.c_str());
  std::fflush(stderr);
  bar_shown_ = true;
}

void Progress::note(const std::string& sentence) {
  if (quiet_) return;
  clear_bar();
  std::fprintf(stderr, "insonify: %s\n", sentence.c_str());
}

}  // namespace insonify::tool
