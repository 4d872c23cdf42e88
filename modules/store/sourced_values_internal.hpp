// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "store/sourced_number.hpp"
#include "store/toml_tree.hpp"

namespace insonify {

/// Replaces each value {value, status, source} of a table by its value, and returns the sources of all values; plain
/// values have status "user". Throws Error(content) for an unknown key or status.
std::vector<SourcedNumber> take_sources(const std::string& path, TomlValue& table);

}  // namespace insonify
