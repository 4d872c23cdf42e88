// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace insonify {

/// True in builds with sanitizers (tests/sanitize.sh). They are several times slower, and their shadow memory is in no
/// limit and no measurement of memory.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

}  // namespace insonify
