#include "core/child_arrays.hpp"

#include <algorithm>
#include <new>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.hpp"

namespace insonify {
namespace {

constexpr std::size_t alignment = 16;
constexpr std::size_t aligned(std::size_t bytes) { return (bytes + alignment - 1) / alignment * alignment; }

}  // namespace

ArraySender::~ArraySender() { static_cast<void>(ftruncate(memory_, static_cast<off_t>(used_)) == 0); }

char* ArraySender::take(std::size_t bytes) {
  constexpr std::size_t most = std::size_t{1} << 46, step = std::size_t{1} << 24;
  if (bytes > most) throw std::bad_alloc();
  const std::size_t begin = used_, end = begin + aligned(bytes);
  if (end > held_) {
    const std::size_t held = end + std::min(end, step);
    if (ftruncate(memory_, static_cast<off_t>(held)) != 0) throw std::bad_alloc();
    void* const start = start_ ? mremap(start_, held_, held, MREMAP_MAYMOVE)
                               : mmap(nullptr, held, PROT_READ | PROT_WRITE, MAP_SHARED, memory_, 0);
    if (start == MAP_FAILED) throw std::bad_alloc();
    start_ = static_cast<char*>(start), held_ = held;
  }
  used_ = end;
  return start_ + begin;
}

struct ArrayReceiver::Mapping {
  int memory;
  std::size_t bytes = 0;
  char* start = nullptr;

  explicit Mapping(int file) : memory(file) {
    struct stat status {};
    if (fstat(memory, &status) == 0) bytes = static_cast<std::size_t>(status.st_size);
    void* const mapped = bytes == 0 ? nullptr : mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE, memory, 0);
    if (mapped != MAP_FAILED) start = static_cast<char*>(mapped);
  }
  ~Mapping() {
    if (start) munmap(start, bytes);
    close(memory);
  }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
};

ArrayReceiver::ArrayReceiver(std::string path, int memory)
    : path_(std::move(path)), mapping_(std::make_shared<const Mapping>(memory)) {
  if (mapping_->bytes > 0 && !mapping_->start) throw std::bad_alloc();
}

std::size_t ArrayReceiver::bytes_of(std::size_t count, std::size_t size) const {
  if (size > 0 && count > (mapping_->bytes - at_) / size)
    fail(ErrorKind::content, path_, ": reading it handed over less than it announced; copy or export it again");
  return count * size;
}

const char* ArrayReceiver::take(std::size_t bytes) {
  const char* const place = mapping_->start + at_;
  at_ = std::min(at_ + aligned(bytes_of(bytes, 1)), mapping_->bytes);
  return place;
}

void ArrayReceiver::copy(void* to, std::size_t bytes) {
  constexpr std::size_t page = 4096, large = std::size_t{1} << 20;
  if (bytes == 0) return;
  const std::size_t begin = at_;
  std::memcpy(to, take(bytes), bytes);
  if (bytes < large) return;
  const std::size_t first = (begin + page - 1) / page * page, end = at_ / page * page;
  fallocate(mapping_->memory, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(first),
            static_cast<off_t>(end - first));
}

}  // namespace insonify
