// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "acoustics/environment.hpp"
#include "store/key_table_internal.hpp"

namespace insonify {

/// The keys of an environment, in the order of files, bound to it. Setting one of a part makes the part present.
std::vector<Key> environment_keys(Environment& environment);

}  // namespace insonify
