// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>

namespace insonify {

/// Throws Error(file) unless `path` names a regular file. It refuses a missing file, a folder, and a pipe or device,
/// which may have no end.
void require_regular_file(const std::string& path);
/// Throws Error(file) unless `path` is a regular file that can be opened; Error(content) if it is empty.
void require_readable(const std::string& path);

/// Returns the size of a file [bytes]; 0 if it cannot be found out.
std::size_t file_size_of(const std::string& path);
/// Returns the whole file. Throws Error(file) if it cannot be read.
std::string read_whole_file(const std::string& path);
/// Returns the first bytes of the file, at most `count`. Throws as read_whole_file.
std::string read_beginning(const std::string& path, std::size_t count);
/// Returns what a file begins with, for messages: "binary data", or "text beginning with '...'".
std::string beginning_of(const std::string& path);

}  // namespace insonify
