// SPDX-License-Identifier: BSD-3-Clause
#include "files/memory_limit.hpp"

#include <fstream>

#include <sys/resource.h>
#include <unistd.h>

namespace insonify {

std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::optional<std::size_t> memory_left() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
  const std::size_t taken = address_space();
  return limit.rlim_cur > taken ? limit.rlim_cur - taken : 0;
}

}  // namespace insonify
