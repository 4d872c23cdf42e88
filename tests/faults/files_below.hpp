// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "faults/fault_cases.hpp"

namespace insonify {

/// Bytes of all files below a folder by their names; a folder's are "/".
using Files = std::map<std::string, std::string>;

std::string bytes_of(const std::filesystem::path& path);

Files files_in(const std::filesystem::path& folder);

/// Whether files are the same. Run times, peak memory and dates are in manifest.json and in marks of a survey's blocks,
/// which are compared by their end alone, as are all files of a case that is timed.
bool same(const Files& a, const Files& b, FaultCase::Kind kind);

/// The names that differ: + is there in addition, - is missing, ~ has other bytes.
std::string difference(const Files& found, const Files& expected);

}  // namespace insonify
