// SPDX-License-Identifier: BSD-3-Clause
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "files/memory_limit.hpp"
#include "tool/command/program.hpp"
#include "tool/command/reader_server.hpp"

namespace insonify::tool {
namespace {

int say_out_of_memory(const char* how, int number, std::size_t left, const char* less) {
  std::fprintf(stderr,
               "insonify: out of memory (%s %d): the limit of ulimit -v left %zu MiB; raise that limit, or %s\n", how,
               number, left >> 20, less);
  return exit_code_of(ErrorKind::memory);
}

/// Waits for the child, and passes on what only this process was sent. Ctrl-C reaches both from the terminal.
int wait_for(pid_t child, const sigset_t& signals) {
  int status = 0;
  while (waitpid(child, &status, WNOHANG) != child) {
    siginfo_t info{};
    const int signal = sigwaitinfo(&signals, &info);
    if (signal > 0 && signal != SIGCHLD && info.si_code <= 0) kill(child, signal);
  }
  return status;
}

/// Ends this process by the signal that ended its child.
[[noreturn]] void end_by(int signal) {
  std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  raise(signal);
  std::_Exit(128 + signal);
}

bool is_of_memory(int signal) {
  for (const int each : {SIGSEGV, SIGBUS, SIGABRT, SIGILL, SIGFPE, SIGTRAP})
    if (signal == each) return true;
  return false;
}

}  // namespace

int under_memory_guard(const std::function<int()>& run, const char* less) {
  const auto run_with_readers = [&] {
    const ReaderServer readers;
    return run();
  };
  const auto left = memory_left();
  if (!left) return run_with_readers();

  // The child notes here that `run` returned: a library may end the process with any exit code.
  void* const page = mmap(nullptr, sizeof(bool), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) return say_out_of_memory("error", errno, *left, less);
  auto* const returned = static_cast<volatile bool*>(page);

  // Signals wait until there is a child that gets them.
  sigset_t signals, before;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, &before);
  const pid_t child = fork_child();
  if (child < 0) return say_out_of_memory("error", errno, *left, less);
  if (child == 0) {
    sigprocmask(SIG_SETMASK, &before, nullptr);
    const int exit_code = run_with_readers();
    *returned = true;
    return exit_code;
  }
  const int status = wait_for(child, signals);
  const bool ended = *returned || WEXITSTATUS(status) == exit_interrupted;  // which ends without returning
  if (WIFEXITED(status) && ended) return WEXITSTATUS(status);
  if (WIFEXITED(status)) return say_out_of_memory("a library ended with code", WEXITSTATUS(status), *left, less);
  if (is_of_memory(WTERMSIG(status))) return say_out_of_memory("signal", WTERMSIG(status), *left, less);
  end_by(WTERMSIG(status));
}

}  // namespace insonify::tool
