// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "acoustics/environment.hpp"
#include "store/key_table.hpp"

namespace insonify {

/// Returns the keys of an environment, in the order of files, bound to it. Setting a key of a part makes the part
/// present.
std::vector<Key> environment_keys(Environment& environment);

/// A [[mirror]] of a file. `size` holds the width and height of a rectangle, from which the corners follow.
struct MirrorEntry {
  Mirror mirror{};
  std::vector<double> size{};  ///< width, height [m]; empty: none
};

/// Returns the keys of a [[mirror]], bound to `entry`.
std::vector<Key> mirror_keys(MirrorEntry& entry);

}  // namespace insonify
