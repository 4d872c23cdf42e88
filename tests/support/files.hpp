// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace insonify {

/// Returns the folder of the running test, empty at its begin; removed with all its files when the program ends.
std::string own_folder();

/// Returns a path in this folder.
std::string own_path(const std::string& name);

/// Writes `bytes` to own_path(name). Returns that path.
std::string own_file(const std::string& name, const std::string& bytes);

std::string file_bytes(const std::string& path);
bool file_exists(const std::string& path);

/// Returns `text` with the first `from` replaced, which must be there.
std::string replaced(std::string text, const std::string& from, const std::string& to);

}  // namespace insonify
