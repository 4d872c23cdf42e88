// SPDX-License-Identifier: BSD-3-Clause
#include "files/child_arrays.hpp"

#include <algorithm>
#include <new>

#include <sys/mman.h>
#include <unistd.h>

#include "core/error.hpp"
#include "files/memory_limit.hpp"

namespace insonify {
namespace {

constexpr std::size_t page = 4096, alignment = 16;
constexpr std::size_t aligned(std::size_t bytes, std::size_t to) { return (bytes + to - 1) / to * to; }
constexpr std::size_t head = SharedMemory::head;

}  // namespace

SharedMemory::SharedMemory(std::size_t most)
    : SharedMemory(most, [](std::size_t bytes) -> char* {
        constexpr int kind = MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE;
        void* const start = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, kind, -1, 0);
        return start == MAP_FAILED ? nullptr : static_cast<char*>(start);
      }) {}

SharedMemory::SharedMemory(std::size_t most, const Map& map) {
  constexpr std::size_t least = std::size_t{1} << 20;
  const std::size_t left = memory_left().value_or(2 * most);
  // Where memory is not promised twice, as much as is left.
  bytes_ = std::min(most, left / 2) / page * page;
  while (bytes_ >= least && !(start_ = map(bytes_))) bytes_ = bytes_ / 2 / page * page;
  if (!start_) throw std::bad_alloc();
}

SharedMemory::~SharedMemory() { munmap(start_, bytes_); }

std::size_t SharedMemory::end_of_sent() const {
  std::size_t used = 0;
  std::memcpy(&used, start_, sizeof used);
  return head + std::min(used, bytes_ - head);
}

void SharedMemory::keep_sent() {
  const std::size_t kept = std::clamp(aligned(end_of_sent(), page), page, bytes_);
  if (kept < bytes_) munmap(start_ + kept, bytes_ - kept);
  bytes_ = kept;
  mprotect(start_, bytes_, PROT_READ);
  madvise(start_, bytes_, MADV_POPULATE_READ);  // else memory of shmget costs a page fault for each page
}

void SharedMemory::give_back(std::size_t begin, std::size_t end) const {
  const std::size_t first = aligned(begin, page), last = end / page * page;
  if (first < last) madvise(start_ + first, last - first, MADV_REMOVE);
}

ArraySender::~ArraySender() { std::memcpy(memory_.start(), &used_, sizeof used_); }

char* ArraySender::take(std::size_t bytes) {
  const std::size_t begin = head + used_, most = std::min(most_, memory_.bytes());
  if (bytes > most || begin > most - bytes) throw std::bad_alloc();
  used_ = std::min(aligned(begin + bytes, alignment), memory_.bytes()) - head;
  return memory_.start() + begin;
}

ArrayReceiver::ArrayReceiver(std::string path, std::shared_ptr<SharedMemory> memory)
    : path_(std::move(path)), memory_(std::move(memory)), at_(head), end_(memory_->end_of_sent()) {}

std::size_t ArrayReceiver::bytes_of(std::size_t count, std::size_t size) const {
  if (size > 0 && count > (end_ - at_) / size)
    fail(ErrorKind::content, path_, ": reading it handed over less than it announced; copy or export it again");
  return count * size;
}

const char* ArrayReceiver::take(std::size_t bytes) {
  const char* const offset = memory_->start() + at_;
  at_ = std::min(aligned(at_ + bytes_of(bytes, 1), alignment), end_);
  return offset;
}

void ArrayReceiver::copy(void* to, std::size_t bytes) {
  constexpr std::size_t large = std::size_t{1} << 20;
  if (bytes == 0) return;
  const std::size_t begin = at_;
  std::memcpy(to, take(bytes), bytes);
  if (bytes >= large) memory_->give_back(begin, at_);
}

}  // namespace insonify
