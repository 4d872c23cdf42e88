// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <filesystem>

#include "core/error.hpp"

namespace insonify {

/// Throws Error(file) "path: cannot be read: reason; check the path" for what std::filesystem threw.
[[noreturn]] void fail_of(const std::filesystem::filesystem_error& error);

/// Returns what `look` returns, which asks std::filesystem. Where that throws, throws Error(file) with the path: for a
/// link to itself, a name that is too long, a folder that may not be entered.
template <typename Look>
auto look_at_paths(const Look& look) {
  try {
    return look();
  } catch (const std::filesystem::filesystem_error& error) {
    fail_of(error);
  }
}

/// Returns whether there is anything at a path; links are followed, here and below. Errors as look_at_paths.
bool path_exists(const std::filesystem::path& path);
/// Returns whether a path is that of a folder.
bool is_folder(const std::filesystem::path& path);
/// Returns whether a path is that of a regular file.
bool is_file(const std::filesystem::path& path);
/// Returns the size of a file [bytes]; a missing file is an error too.
std::uintmax_t size_of_file(const std::filesystem::path& path);
/// Returns the absolute path of a file or folder without links; a missing one is an error too.
std::filesystem::path real_path(const std::filesystem::path& path);

}  // namespace insonify
