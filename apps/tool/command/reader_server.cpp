// SPDX-License-Identifier: BSD-3-Clause
#include "tool/command/reader_server.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <mutex>
#include <new>
#include <string>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"
#include "files/memory_limit.hpp"

namespace insonify::tool {
namespace {

constexpr int reader_in_order = 0, reader_failed = 1, reader_without_memory = 2, reader_short = 3;  // exit codes

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool limits_memory = false;  // they take terabytes of addresses
#else
constexpr bool limits_memory = true;
#endif

/// Returns the soft limit of a resource that the user set for this process; RLIM_INFINITY: none.
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

/// The limits of a reader; a limit that the user set lower stays.
struct Allowed {
  std::size_t memory = 0, beyond_server = 0;  // address space, and without that of the server [bytes]
  unsigned seconds = 0;                       // time of the processor [s]
  rlim_t users_memory = RLIM_INFINITY, users_seconds = RLIM_INFINITY;

  bool short_of_memory() const { return users_memory < memory; }
  void set() const {
    constexpr unsigned beside_others = 5;
    if (limits_memory) set_limit(RLIMIT_AS, std::min<rlim_t>(memory, users_memory));
    set_limit(RLIMIT_CPU, std::min<rlim_t>(seconds, users_seconds));
    alarm(beside_others * seconds);
  }
  void expect(double bytes) {
    constexpr double copies = 3, bytes_per_second = 10 << 20;
    memory += static_cast<std::size_t>(copies * bytes);
    beyond_server += static_cast<std::size_t>(copies * bytes);
    seconds += static_cast<unsigned>(bytes / bytes_per_second);
    set();
  }
};
// It is where the reader may raise it, and the asking process reads how far.
static_assert(sizeof(Allowed) <= SharedMemory::head - SharedMemory::of_sender &&
              std::is_trivially_destructible_v<Allowed>);
Allowed& allowed_in(const SharedMemory& memory) {
  return *reinterpret_cast<Allowed*>(memory.start() + SharedMemory::of_sender);
}

/// A request to the server: which function is to read which file, with which shared memory.
struct Request {
  void (*read)(ArrayReceiver&, ArraySender&);
  int memory;  // id of shared memory, from shmget
  std::size_t bytes;
  std::array<char, 4096> path;
};

/// How a reader ended.
struct Answer {
  int status;
  std::array<char, 256> said;  // last words, in brackets, if there are any
};

/// The last line in a file, in brackets, if there is one.
std::string last_words(int file) {
  std::array<char, 4096> end{};
  const off_t size = lseek(file, 0, SEEK_END);
  const ssize_t count = pread(file, end.data(), end.size(), std::max<off_t>(0, size - static_cast<off_t>(end.size())));
  std::string text(end.data(), static_cast<std::size_t>(std::max<ssize_t>(0, count)));
  text.erase(text.find_last_not_of(" \n\r") + 1);
  text.erase(0, text.rfind('\n') + 1);
  return text.empty() ? text : " (" + text.substr(0, 200) + ")";
}

/// Lets this process die alone; what libraries print goes to `said`.
void confine(int said) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGALRM}) std::signal(signal, SIG_DFL);
  std::signal(SIGXFSZ, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  set_limit(RLIMIT_CORE, 0);
  constexpr rlim_t bytes_said = 1 << 20;
  set_limit(RLIMIT_FSIZE, std::min(bytes_said, limit_of(RLIMIT_FSIZE)));
  dup2(said, STDOUT_FILENO);
  dup2(said, STDERR_FILENO);
}

/// Reads, in a process of its own. Returns its exit code.
int run_reader(const Request& request) {
  void* const start = shmat(request.memory, nullptr, 0);
  if (start == reinterpret_cast<void*>(-1)) return reader_short;
  const auto memory = std::make_shared<SharedMemory>(static_cast<char*>(start), request.bytes);
  Allowed& allowed = allowed_in(*memory);
  allowed.memory += address_space();
  allowed.set();
  set_reader_process({.expect = [&](double bytes) { allowed.expect(bytes); }});
  try {
    try {
      ReadTask{request.path.data(), {}, request.read}.run(memory, allowed.beyond_server);
      return reader_in_order;
    } catch (const Error& error) {
      ReadTask::send([&](ArraySender& to) { to(error.kind(), std::string(error.what())); }, *memory);
      return reader_failed;
    }
  } catch (const std::bad_alloc&) {
    return reader_without_memory;
  }
}

/// Serves the socket until the process that asks has gone.
[[noreturn]] void serve(int socket) {
  // Ctrl-C is of the process that asks, with which this one ends.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
  Request request;
  while (recv(socket, &request, sizeof request, 0) == sizeof request) {
    const int said = memfd_create("insonify-said", MFD_CLOEXEC);
    const pid_t reader = said >= 0 ? fork_child() : -1;
    if (reader == 0) {
      confine(said);
      _exit(run_reader(request));
    }
    Answer answer{-1, {}};
    if (reader > 0) waitpid(reader, &answer.status, 0);
    last_words(said).copy(answer.said.data(), answer.said.size() - 1);
    close(said);
    send(socket, &answer, sizeof answer, MSG_NOSIGNAL);
  }
  _exit(0);
}

/// Asks the server, one thread after the other.
Answer ask(int socket, const Request& request) {
  static std::mutex turn;
  const std::lock_guard lock(turn);
  Answer answer{-1, {}};
  if (send(socket, &request, sizeof request, MSG_NOSIGNAL) > 0) recv(socket, &answer, sizeof answer, 0);
  return answer;
}

/// Throws unless the reader ended in order, or with an Error. Returns its exit code.
int exit_code_of_reader(const Answer& answer, const std::string& path, const Allowed& allowed) {
  const char* const damaged = "; it is damaged or cut off: copy or export it again";
  if (answer.status == -1)
    fail(ErrorKind::runtime, path, ": no process can be started to read the file; end other programs, and run again");
  const int code = WIFEXITED(answer.status) ? WEXITSTATUS(answer.status) : -1;
  if (code == reader_in_order || code == reader_failed) return code;
  const int signal = WIFSIGNALED(answer.status) ? WTERMSIG(answer.status) : 0;
  if (signal == SIGXCPU || signal == SIGALRM)
    fail(ErrorKind::content, path, ": reading the file takes more than ", allowed.seconds, " s", damaged);
  // Libraries that get no memory crash as well.
  if (allowed.short_of_memory() || signal == SIGKILL || code == reader_short) throw std::bad_alloc();
  if (signal != 0)
    fail(ErrorKind::content, path, ": the process that reads the file ended with signal ", signal, answer.said.data(),
         damaged);
  fail(ErrorKind::content, path, ": reading the file takes more than ", allowed.beyond_server >> 20, " MiB of memory",
       damaged);
}

/// Has the server read.
std::shared_ptr<SharedMemory> read_by(int socket, const ReadTask& task, const ReadTask::Send& arguments) {
  Request request{task.read, -1, 0, {}};
  // Not a file in memory, for whose size `ulimit -f` holds.
  const auto map = [&](std::size_t bytes) -> char* {
    request.memory = shmget(IPC_PRIVATE, bytes, 0600 | SHM_NORESERVE);
    if (request.memory < 0) return nullptr;
    void* const start = shmat(request.memory, nullptr, 0);
    shmctl(request.memory, IPC_RMID, nullptr);  // it ends with its last user
    return start == reinterpret_cast<void*>(-1) ? nullptr : static_cast<char*>(start);
  };
  auto memory = std::make_shared<SharedMemory>(task.limits.sent, map);
  request.bytes = memory->bytes();
  task.path.copy(request.path.data(), request.path.size() - 1);
  ReadTask::send(arguments, *memory);
  const Allowed& allowed = *new (&allowed_in(*memory)) Allowed{
      task.limits.memory, task.limits.memory, task.limits.seconds, limit_of(RLIMIT_AS), limit_of(RLIMIT_CPU)};
  if (exit_code_of_reader(ask(socket, request), task.path, allowed) == reader_in_order) return memory;
  ErrorKind kind{};
  std::string text;
  ArrayReceiver(task.path, memory)(kind, text);
  throw Error(kind, text);
}

}  // namespace

pid_t fork_child() {
  const pid_t parent = getpid(), child = fork();
  if (child != 0) return child;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);  // it has ended already
  return 0;
}

ReaderServer::ReaderServer() {
  std::array<int, 2> ends = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) == 0) server_ = fork_child();
  if (server_ == 0) {
    close(ends[0]);
    serve(ends[1]);
  }
  socket_ = ends[0];
  close(ends[1]);
  before_ = set_reader_process({.run = [socket = socket_](const ReadTask& task, const ReadTask::Send& arguments) {
    return read_by(socket, task, arguments);
  }});
}

ReaderServer::~ReaderServer() {
  set_reader_process(before_);
  close(socket_);
  if (server_ > 0) waitpid(server_, nullptr, 0);
}

}  // namespace insonify::tool
