// SPDX-License-Identifier: BSD-3-Clause
#include "files/child_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <exception>
#include <memory>
#include <new>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"
#include "files/memory_limit.hpp"

namespace insonify {
namespace {

constexpr int child_in_order = 0, child_failed = 1, child_without_memory = 2;  // a child's exit codes
const char* const damaged = "; it is damaged or cut off: copy or export it again";

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool limits_memory = false;  // they take terabytes of addresses
#else
constexpr bool limits_memory = true;
#endif

/// What the user let this process have.
rlim_t limit_of(decltype(RLIMIT_AS) resource) {
  rlimit limit{RLIM_INFINITY, RLIM_INFINITY};
  getrlimit(resource, &limit);
  return limit.rlim_cur;
}

void set_limit(decltype(RLIMIT_AS) resource, rlim_t value) {
  rlimit limit{};
  getrlimit(resource, &limit);
  limit.rlim_cur = std::min(value, limit.rlim_max);
  setrlimit(resource, &limit);
}

/// What a child may have; a limit that the user set lower stays.
struct Allowed {
  std::size_t memory = 0, beyond_parent = 0;  // address space, and without that of the parent [bytes]
  unsigned seconds = 0;                       // of processor
  rlim_t users_memory = RLIM_INFINITY, users_seconds = RLIM_INFINITY;

  bool short_of_memory() const { return users_memory < memory; }
  void set() const {
    constexpr unsigned beside_others = 5;
    if (limits_memory) set_limit(RLIMIT_AS, std::min<rlim_t>(memory, users_memory));
    set_limit(RLIMIT_CPU, std::min<rlim_t>(seconds, users_seconds));
    alarm(beside_others * seconds);
  }
};
Allowed* allowed_here = nullptr;  // in a child

/// A file in memory, or -1.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : file_(memfd_create(name, MFD_CLOEXEC)) {}
  ~MemoryFile() {
    if (file_ >= 0) close(file_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  operator int() const { return file_; }
  /// The last line in it, in brackets, if there is one.
  std::string last_words() const {
    std::array<char, 4096> end{};
    const off_t size = lseek(file_, 0, SEEK_END);
    const ssize_t count =
        pread(file_, end.data(), end.size(), std::max<off_t>(0, size - static_cast<off_t>(end.size())));
    std::string text(end.data(), static_cast<std::size_t>(std::max<ssize_t>(0, count)));
    text.erase(text.find_last_not_of(" \n\r") + 1);
    text.erase(0, text.rfind('\n') + 1);
    return text.empty() ? text : " (" + text.substr(0, 200) + ")";
  }

 private:
  int file_;
};

/// A child that dies alone; what libraries print goes to `said`.
void confine(int said) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGALRM}) std::signal(signal, SIG_DFL);
  // Ctrl-C is the parent's, with which the child ends.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXFSZ}) std::signal(signal, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  set_limit(RLIMIT_CORE, 0);
  constexpr rlim_t bytes_said = 1 << 20;
  set_limit(RLIMIT_FSIZE, std::min(bytes_said, limit_of(RLIMIT_FSIZE)));
  dup2(said, STDOUT_FILENO);
  dup2(said, STDERR_FILENO);
}

int run_child(const std::string& path, const std::function<void(ArraySender&)>& read, const SharedMemory& memory,
              const Allowed& allowed) {
  const auto say = [&](ErrorKind kind, const std::string& text) {
    const std::size_t all = memory.bytes();
    ArraySender sender(memory, all);
    sender(kind, text);
    return child_failed;
  };
  try {
    try {
      ArraySender sender(memory, allowed.beyond_parent);
      read(sender);
      return child_in_order;
    } catch (const Error& error) {
      return say(error.kind(), error.what());
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      return say(ErrorKind::content, path + ": cannot be read (" + error.what() + ")" + damaged);
    }
  } catch (const std::bad_alloc&) {
    return child_without_memory;
  }
}

/// Waits for the child. Throws unless it ended in order, or with an Error.
int end_of(pid_t child, const std::string& path, const Allowed& allowed, const MemoryFile& said) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) != child_without_memory) return WEXITSTATUS(status);
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGXCPU || signal == SIGALRM)
    fail(ErrorKind::content, path, ": reading the file takes more than ", allowed.seconds, " s", damaged);
  // Libraries that get no memory crash as well.
  if (allowed.short_of_memory() || signal == SIGKILL) throw std::bad_alloc();
  if (signal != 0)
    fail(ErrorKind::content, path, ": the process that reads the file ended with signal ", signal, said.last_words(),
         damaged);
  fail(ErrorKind::content, path, ": reading the file takes more than ", allowed.beyond_parent >> 20, " MiB of memory",
       damaged);
}

}  // namespace

ChildLimits limits_of_file(std::size_t bytes) {
  // Of text VTK makes larger numbers, and GDAL loads seventy libraries.
  constexpr std::size_t memory_per_byte = 40, memory_at_least = std::size_t{768} << 20;
  constexpr std::size_t bytes_per_second = 1 << 20, seconds_at_least = limits_memory ? 2 : 20;
  return {memory_per_byte * bytes + memory_at_least,
          static_cast<unsigned>(bytes / bytes_per_second + seconds_at_least)};
}

void expect_from_file(const std::string& path, std::size_t bytes, const Announced& announced) {
  constexpr double least = 0x1p26, per_byte = 1032, mib = 0x1p20;
  const double wanted = announced.count * announced.bytes, most = least + per_byte * static_cast<double>(bytes);
  if (!(wanted <= most))
    fail(ErrorKind::content, path, ": its header announces ", announced.count, " ", announced.what, ", ", wanted / mib,
         " MiB of memory; a file of ", bytes, " bytes may take ", std::floor(most / mib), " MiB at most; ",
         announced.remedy);
  if (!allowed_here) return;
  constexpr double copies = 3, bytes_per_second = 10 << 20;
  allowed_here->memory += static_cast<std::size_t>(copies * wanted);
  allowed_here->beyond_parent += static_cast<std::size_t>(copies * wanted);
  allowed_here->seconds += static_cast<unsigned>(wanted / bytes_per_second);
  allowed_here->set();
}

ArrayReceiver read_in_child(const std::string& path, const ChildLimits& limits,
                            const std::function<void(ArraySender&)>& read) {
  const auto memory = std::make_shared<SharedMemory>(limits.sent);
#ifdef INSONIFY_READ_HERE  // by tests/fuzz.sh
  {
    const std::size_t all = memory->bytes();
    ArraySender sender(*memory, all);
    read(sender);
  }
  return {path, memory};
#endif
  // Where the child may raise it, and this process reads how far.
  static_assert(sizeof(Allowed) <= SharedMemory::head - SharedMemory::of_sender &&
                std::is_trivially_destructible_v<Allowed>);
  Allowed& allowed = *new (memory->start() + SharedMemory::of_sender) Allowed{
      address_space() + limits.memory, limits.memory, limits.seconds, limit_of(RLIMIT_AS), limit_of(RLIMIT_CPU)};
  const MemoryFile said("insonify-said");
  const pid_t child = said >= 0 ? fork() : -1;
  if (child == 0) {
    allowed_here = &allowed;
    confine(said);
    allowed.set();
    _exit(run_child(path, read, *memory, allowed));
  }
  if (child < 0)
    fail(ErrorKind::runtime, path, ": no process can be started to read the file; end other programs, and run again");
  const int end = end_of(child, path, allowed, said);
  ArrayReceiver sent(path, memory);
  if (end == child_in_order) return sent;
  ErrorKind kind{};
  std::string text;
  sent(kind, text);
  throw Error(kind, text);
}

void try_in_child(const std::string& path, const ChildLimits& limits, const std::function<void()>& read) {
  read_in_child(path, limits, [&](ArraySender&) { read(); });
}

}  // namespace insonify
