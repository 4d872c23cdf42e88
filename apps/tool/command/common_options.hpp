// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

namespace insonify::tool {

/// Options of every verb.
struct CommonOptions {
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  int threads = 0;  ///< 0: all cores
  std::uint64_t seed = 1;
};

}  // namespace insonify::tool
