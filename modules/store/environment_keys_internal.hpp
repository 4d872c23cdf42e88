// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "acoustics/environment.hpp"
#include "store/key_table_internal.hpp"

namespace insonify {

/// The keys of an environment, in the order of files, bound to it. Setting one of a part makes the part present.
std::vector<Key> environment_keys(Environment& environment);

/// A [[mirror]] of a file: width and height of a rectangle, that becomes its corners, stand beside it.
struct MirrorEntry {
  Mirror mirror{};
  std::vector<double> size{};  ///< width, height [m]; empty: none
};

/// The keys of a [[mirror]], bound to it.
std::vector<Key> mirror_keys(MirrorEntry& entry);

}  // namespace insonify
