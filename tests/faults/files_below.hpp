// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "faults/fault_cases.hpp"

namespace insonify {

/// Bytes of all files below a folder by name; a folder has "/".
using Files = std::map<std::string, std::string>;

std::string bytes_of(const std::filesystem::path& path);

Files files_in(const std::filesystem::path& folder);

/// Returns true if the files are equal. Run times, peak memory and dates are in manifest.json and in marks of a
/// survey's blocks: of these only the end is compared, as of all files of a case that is timed.
bool same(const Files& a, const Files& b, FaultCase::Kind kind);

/// Returns the names that differ: + is there in addition, - is missing, ~ has other bytes.
std::string difference(const Files& found, const Files& expected);

}  // namespace insonify
