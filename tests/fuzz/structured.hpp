// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>
#include <functional>
#include <string>

namespace insonify {

/// Returns the bytes of a file; empty if it cannot be read.
std::string bytes_of(const std::filesystem::path& path);
/// Writes a file in place.
void write_bytes(const std::filesystem::path& path, const std::string& bytes);

/// Source of random damage.
struct DamageSource {
  std::function<std::size_t(std::size_t)> below;                   ///< a number in [0, end), 0 if end is 0
  std::function<std::string(const std::string& bytes)> at_random;  ///< bytes with damage anywhere
};

/// Returns a .tiles file with other values, links and counts, and with checksums that are right.
std::string damage_tiles(const std::string& bytes, const DamageSource& source);

/// Returns files in one, each as a line "NAME SIZE" and its bytes, of which one or two are damaged, cut, zeros, gone,
/// or another one.
std::string damage_folder(const std::string& bytes, const DamageSource& source);
/// Makes these files below `folder`, but for names that lead out of it.
void unpack_folder(const std::string& bytes, const std::string& folder);

}  // namespace insonify
