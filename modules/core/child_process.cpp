#include "core/child_process.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <fstream>
#include <new>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"

namespace insonify {
namespace {

constexpr int child_in_order = 0, child_without_memory = 1;

// Address space of this process [bytes].
std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void set_limit(decltype(RLIMIT_AS) resource, std::size_t value) {
  const rlimit limit{value, value};
  setrlimit(resource, &limit);
}

// A child that dies alone, and says nothing.
void confine(const ChildLimits& limits, std::size_t memory) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGALRM}) std::signal(signal, SIG_DFL);
  // Ctrl-C is the parent's, with which the child ends.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_CPU, limits.seconds);
#ifndef __SANITIZE_ADDRESS__  // which takes terabytes of addresses
  set_limit(RLIMIT_AS, memory);
#else
  static_cast<void>(memory);
#endif
  alarm(limits.seconds);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
}

int run_child(const std::function<void()>& read) {
  try {
    read();
  } catch (const std::bad_alloc&) {
    return child_without_memory;
  } catch (const std::exception&) {
  }
  return child_in_order;
}

}  // namespace

void try_in_child(const std::string& path, const ChildLimits& limits, const std::function<void()>& read) {
  const std::size_t memory = address_space() + limits.memory;
  const pid_t child = fork();
  if (child < 0) fail(ErrorKind::runtime, path, ": no process can be started to read it; end others, and run again");
  if (child == 0) {
    confine(limits, memory);
    _exit(run_child(read));
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == child_in_order) return;
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  const char* remedy = "; it is damaged or cut off: copy or export it again";
  if (signal == SIGXCPU || signal == SIGALRM || signal == SIGKILL)
    fail(ErrorKind::content, path, ": reading it takes more than ", limits.seconds, " s", remedy);
  if (signal != 0) fail(ErrorKind::content, path, ": reading it ends with signal ", signal, remedy);
  fail(ErrorKind::content, path, ": reading it takes more than ", limits.memory >> 20, " MiB of memory", remedy);
}

}  // namespace insonify
