// SPDX-License-Identifier: BSD-3-Clause
#include "core/hidden_internal.hpp"

namespace insonify {
struct TimeAxis {
  int first() {
    int bins = 1;
    bins += bins;
    return bins;
  }
};
}  // namespace insonify
