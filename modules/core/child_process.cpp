#include "core/child_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"
#include "core/memory_limit.hpp"

namespace insonify {
namespace {

constexpr int child_in_order = 0, child_without_memory = 1;

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
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which take terabytes of addresses
  set_limit(RLIMIT_AS, memory);
#else
  static_cast<void>(memory);
#endif
  alarm(limits.seconds);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
}

/// Writes all to a pipe, of which the parent reads the other end.
bool send(int to, const std::string& text) {
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t count = write(to, text.data() + sent, text.size() - sent);
    if (count < 0 && errno != EINTR) return false;
    sent += static_cast<std::size_t>(std::max<ssize_t>(0, count));
  }
  return true;
}

/// Reads until the child ends.
std::string receive(int from) {
  std::string text;
  std::array<char, 4096> some;
  for (ssize_t count = 1; count != 0;) {
    count = read(from, some.data(), some.size());
    if (count < 0 && errno != EINTR) break;
    text.append(some.data(), static_cast<std::size_t>(std::max<ssize_t>(0, count)));
  }
  return text;
}

int run_child(const std::function<std::string()>& read, int to) {
  try {
    return send(to, read()) ? child_in_order : child_without_memory;
  } catch (const std::bad_alloc&) {
    return child_without_memory;
  } catch (const std::exception&) {
  }
  return child_in_order;
}

/// Waits for the child, and throws unless it ended in order.
void require_in_order(pid_t child, const std::string& path, const ChildLimits& limits) {
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

}  // namespace

void try_in_child(const std::string& path, const ChildLimits& limits, const std::function<void()>& read) {
  read_in_child(path, limits, [&] {
    read();
    return std::string();
  });
}

std::string read_in_child(const std::string& path, const ChildLimits& limits,
                          const std::function<std::string()>& read) {
  const std::size_t memory = address_space() + std::min(limits.memory, memory_left().value_or(limits.memory));
  int ends[2];
  const bool piped = pipe2(ends, O_CLOEXEC) == 0;
  const pid_t child = piped ? fork() : -1;
  if (child == 0) {
    confine(limits, memory);
    close(ends[0]);
    _exit(run_child(read, ends[1]));
  }
  if (piped) close(ends[1]);
  const std::string text = child > 0 ? receive(ends[0]) : "";
  if (piped) close(ends[0]);
  if (child < 0) fail(ErrorKind::runtime, path, ": no process can be started to read it; end others, and run again");
  require_in_order(child, path, limits);
  return text;
}

}  // namespace insonify
