// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

// Calls by which files are written, of which one can be made to fail. The definitions of this program stand in the place of
// those of the C library for all libraries that it uses, so HDF5, VTK, PCL, GDAL and libstdc++ meet the failure where the
// system would report it.
namespace insonify {

/// What happens to the chosen call.
enum class Failure { none, no_space, io_error, no_access, interrupted, short_write, kill };

/// Counts calls that concern files below `root`, or of a relative name, from 1 on, and lets number `chosen` fail. A call to
/// which `failure` cannot happen (a rename is not short) is left alone.
void fail_call(const std::string& root, long chosen, Failure failure);

/// Number of such calls so far, also of processes that were forked after fail_call().
long counted_calls();

/// Whether the chosen call has failed.
bool has_failed();

}  // namespace insonify
