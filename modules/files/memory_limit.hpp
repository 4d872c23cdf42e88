// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>

namespace insonify {

/// Returns the address space of this process [bytes].
std::size_t address_space();

/// Returns the address space that the limit of this process (ulimit -v) still allows [bytes]; nothing without a limit.
std::optional<std::size_t> memory_left();

/// Returns the memory that the machine has available and the limit of this process allows [bytes]; infinite if unknown.
double available_memory();

}  // namespace insonify
