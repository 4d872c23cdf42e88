#pragma once

namespace insonify {

/// The largest resident set of this process since its start, or since forget_peak_memory [MiB].
double peak_memory_mib();

/// Forgets the peak so far, where the system allows it (Linux).
void forget_peak_memory();

}  // namespace insonify
