// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstring>
#include <string>

namespace insonify {

/// Writes a number into a file made by a test, as it lies in memory.
void put_at(std::string& bytes, std::size_t at, auto number) { std::memcpy(bytes.data() + at, &number, sizeof number); }

}  // namespace insonify
