// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

// Calls by which files are written, of which one can be made to fail. This program's definitions replace those of the C
// library for all libraries that it uses, so HDF5, VTK, PCL, GDAL and libstdc++ meet the failure where the system would
// report it.
namespace insonify {

/// Failure of the chosen call; full_disk: of all writes from the chosen byte on.
enum class Failure { none, no_space, io_error, no_access, interrupted, short_write, kill, full_disk };

/// Counts calls that concern files below `root`, or of a relative name, from 1 on, and lets number `chosen` fail. A
/// call to which `failure` does not apply (a rename is not short) is left alone. On a full disk `chosen` bytes can be
/// written, the last of them by a short write.
void fail_call(const std::string& root, long chosen, Failure failure);

/// Returns the number of such calls so far, also of processes that were forked after fail_call().
long counted_calls();

/// Returns the number of bytes that these calls wrote.
long counted_bytes();

/// Returns true if a call has failed.
bool has_failed();

}  // namespace insonify
