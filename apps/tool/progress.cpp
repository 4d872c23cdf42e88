#include "tool/progress.hpp"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/pending_path.hpp"

namespace insonify::tool {
namespace {

constexpr const char* nothing_kept = "nothing was written";
std::atomic<bool> interrupted{false}, ending{false};
std::atomic<const char*> kept_at_once{nothing_kept};
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

void print_summary(const CommonOptions& common, const nlohmann::ordered_json& result, const std::string& line) {
  if (common.json)
    fmt::print("{}\n", result.dump(2));
  else if (!common.quiet)
    fmt::print("{}\n", line);
}

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

void Progress::step(const std::string& what) {
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
