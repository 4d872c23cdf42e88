// SPDX-License-Identifier: BSD-3-Clause
#include "files/memory_limit.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

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

double available_memory() {
  double available = std::numeric_limits<double>::infinity(), kibibytes = 0;
  std::ifstream file("/proc/meminfo");
  for (std::string word; file >> word;)
    if (word == "MemAvailable:" && file >> kibibytes) available = 1024 * kibibytes;
  if (const auto left = memory_left()) available = std::min(available, static_cast<double>(*left));
  return available;
}

}  // namespace insonify
