// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace insonify {

/// Whether this build checks itself (tests/sanitize.sh): several times slower, with shadow memory that no limit and no
/// measurement of memory knows of.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

}  // namespace insonify
