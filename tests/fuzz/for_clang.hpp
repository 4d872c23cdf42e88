// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Included before every source by tests/fuzz.sh: clang does not know GCC's shuffle, of kernels that no reader calls.
#ifdef __clang__
#define __builtin_shuffle(first, ...) (first)
#endif
