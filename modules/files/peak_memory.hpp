// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace insonify {

/// The largest resident set of this process since its start, or since forget_peak_memory [MiB].
double peak_memory_mib();

/// Forgets the peak so far, where the system allows it (Linux).
void forget_peak_memory();

/// Lets blocks of up to 32 MiB that are freed stay with this process, up to 1 GiB, for what it takes next; glibc gives
/// them back to the system, and every ping fetches some 12 000 pages again (4 % of its time). For programs: it holds
/// for all that runs in the process.
void keep_freed_memory();

}  // namespace insonify
