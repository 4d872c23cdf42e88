// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace insonify {

/// Returns the largest resident set of this process since its start, or since forget_peak_memory [MiB].
double peak_memory_mib();

/// Forgets the peak so far, where the system allows it (Linux).
void forget_peak_memory();

/// Keeps freed blocks of up to 32 MiB in this process, up to 1 GiB, for later allocations. glibc otherwise returns them
/// to the system, and every ping fetches some 12 000 pages again (4 % of its time). For programs only: the setting
/// applies to the whole process.
void keep_freed_memory();

}  // namespace insonify
