#pragma once
#include <cstddef>
#include <string>

namespace insonify {

/// Writes the bytes to `path`.tmp and renames it, so that `path` is never incomplete.
/// Throws Error(file); then neither file remains.
void write_file_atomically(const std::string& path, const unsigned char* bytes, std::size_t count, const char* who);

}  // namespace insonify
