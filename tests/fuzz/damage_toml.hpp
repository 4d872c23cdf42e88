// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "fuzz/structured.hpp"

namespace insonify {

/// Returns a TOML text with one to four damages of its keys and tables: a number or all numbers of a line become
/// extreme, a table is repeated up to 10 000 times (with names of its own), the entries of a list are, two lines swap
/// their keys, or a line is moved. The text stays below 900 kB.
std::string damage_toml(const std::string& text, const DamageSource& source);

}  // namespace insonify
