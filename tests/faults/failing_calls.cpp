// SPDX-License-Identifier: BSD-3-Clause
#include "faults/failing_calls.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <vector>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

using insonify::Failure;

namespace {

// State shared with forked processes.
struct Plan {
  std::atomic<long> calls{0}, bytes{0}, chosen{0};
  std::atomic<bool> failed{false};
  Failure failure = Failure::none;
  char root[1024] = {};
};

Plan* plan = nullptr;

bool is_watched(const char* path) {
  return plan && path && (path[0] != '/' || std::strncmp(path, plan->root, std::strlen(plan->root)) == 0);
}

bool is_watched(int file) {
  if (!plan || file <= STDERR_FILENO) return false;
  char link[64], target[1024] = {};
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  return readlink(link, target, sizeof target - 1) > 0 && is_watched(target) && target[0] == '/';
}

enum CallKind { is_write = 1, is_sync = 2, is_name = 4 };  // what the call does; is_name: open, rename, mkdir

// Returns 0, or the error that this call is to report; -1: it shall write less.
int error_of_call(CallKind kind) {
  ++plan->calls;
  if (plan->failure == Failure::full_disk || plan->calls != plan->chosen) return 0;
  plan->failed = true;
  switch (plan->failure) {
    case Failure::kill:
      std::raise(SIGKILL);
      return 0;
    case Failure::no_space:
      return ENOSPC;
    case Failure::io_error:
      return EIO;
    case Failure::no_access:
      if (kind == is_name) return EACCES;
      break;
    case Failure::interrupted:
      if (kind != is_name) return EINTR;
      break;
    case Failure::short_write:
      if (kind == is_write) return -1;
      break;
    case Failure::full_disk:
    case Failure::none:
      break;
  }
  plan->failed = false;
  return 0;
}

template <typename Function>
Function* next(Function*, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool writes(int flags) { return (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0; }

// Fails with `errno`, or makes the call.
template <typename Result, typename Call>
Result failing(bool watched, CallKind kind, Result failed, const Call& call) {
  const int error = watched ? error_of_call(kind) : 0;
  if (error <= 0) return call();
  errno = error;
  return failed;
}

// Returns how many of `count` bytes fit on the disk.
std::size_t bytes_on_disk(std::size_t count) {
  const long before = plan->bytes.fetch_add(static_cast<long>(count));
  if (plan->failure != Failure::full_disk) return count;
  const std::size_t room = static_cast<std::size_t>(std::max(0L, plan->chosen - before));
  if (room < count) plan->failed = true;
  return std::min(room, count);
}

// Fails with `errno`, or writes, perhaps less than `count` bytes.
template <typename Write>
ssize_t writing(int file, std::size_t count, const Write& write) {
  if (!is_watched(file)) return write(count);
  int error = error_of_call(is_write);
  const std::size_t held = error == 0 ? bytes_on_disk(count) : (count + 1) / 2;
  if (held == 0 && count > 0) error = ENOSPC;
  if (error <= 0) return write(held);
  errno = error;
  return -1;
}

}  // namespace

namespace insonify {

void fail_call(const std::string& root, long chosen, Failure failure) {
  if (!plan) plan = new (mmap(nullptr, sizeof(Plan), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) Plan;
  plan->calls = 0, plan->bytes = 0, plan->chosen = chosen, plan->failed = false, plan->failure = failure;
  std::snprintf(plan->root, sizeof plan->root, "%s", root.c_str());
}

long counted_calls() { return plan->calls; }

long counted_bytes() { return plan->bytes; }

bool has_failed() { return plan->failed; }

}  // namespace insonify

#define NEXT(function) static auto* const on = next(&::function, #function)

extern "C" {

ssize_t write(int file, const void* bytes, size_t count) {
  NEXT(write);
  return writing(file, count, [&](size_t n) { return on(file, bytes, n); });
}

ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
  NEXT(pwrite);
  return writing(file, count, [&](size_t n) { return on(file, bytes, n, at); });
}

ssize_t pwrite64(int file, const void* bytes, size_t count, off64_t at) {
  NEXT(pwrite64);
  return writing(file, count, [&](size_t n) { return on(file, bytes, n, at); });
}

ssize_t writev(int file, const iovec* parts, int count) {
  NEXT(writev);
  std::vector<iovec> held(parts, parts + count);
  std::size_t all = 0;
  for (const iovec& part : held) all += part.iov_len;
  return writing(file, all, [&](size_t room) {
    for (iovec& part : held) room -= part.iov_len = std::min(part.iov_len, room);
    return on(file, held.data(), count);
  });
}

ssize_t sendfile(int to, int from, off_t* at, size_t count) noexcept {
  NEXT(sendfile);
  return writing(to, count, [&](size_t n) { return on(to, from, at, n); });
}

size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file) {
  NEXT(fwrite);
  if (!plan || !file) return on(bytes, size, count, file);
  const ssize_t written = writing(fileno(file), size * count, [&](size_t n) {
    const size_t put = on(bytes, 1, n, file);
    if (n < size * count) errno = ENOSPC;
    return static_cast<ssize_t>(put);
  });
  return written < 0 || size == 0 ? 0 : static_cast<size_t>(written) / size;
}

int fsync(int file) {
  NEXT(fsync);
  return failing(is_watched(file), is_sync, -1, [&] { return on(file); });
}

int ftruncate(int file, off_t size) noexcept {
  NEXT(ftruncate);
  return failing(is_watched(file), is_write, -1, [&] { return on(file, size); });
}

int ftruncate64(int file, off64_t size) noexcept {
  NEXT(ftruncate64);
  return failing(is_watched(file), is_write, -1, [&] { return on(file, size); });
}

int rename(const char* from, const char* to) noexcept {
  NEXT(rename);
  return failing(is_watched(to), is_name, -1, [&] { return on(from, to); });
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
  NEXT(renameat2);
  return failing(is_watched(to), is_name, -1, [&] { return on(from_folder, from, to_folder, to, flags); });
}

int mkdir(const char* path, mode_t mode) noexcept {
  NEXT(mkdir);
  return failing(is_watched(path), is_name, -1, [&] { return on(path, mode); });
}

// Defines both names of a function that opens.
#define OPENING(open)                                                                                      \
  int open(const char* path, int flags, ...) {                                                             \
    NEXT(open);                                                                                            \
    va_list rest;                                                                                          \
    va_start(rest, flags);                                                                                 \
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(rest, mode_t) : 0;                   \
    va_end(rest);                                                                                          \
    return failing(writes(flags) && is_watched(path), is_name, -1, [&] { return on(path, flags, mode); }); \
  }
OPENING(open)
OPENING(open64)

#define OPENING_STREAM(fopen)                                                              \
  FILE* fopen(const char* path, const char* mode) {                                        \
    NEXT(fopen);                                                                           \
    return failing<FILE*>(std::strpbrk(mode, "wa+") && is_watched(path), is_name, nullptr, \
                          [&] { return on(path, mode); });                                 \
  }
OPENING_STREAM(fopen)
OPENING_STREAM(fopen64)

}  // extern "C"
