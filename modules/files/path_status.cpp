// SPDX-License-Identifier: BSD-3-Clause
#include "files/path_status.hpp"

namespace insonify {

namespace fs = std::filesystem;

void fail_of(const fs::filesystem_error& error) {
  fail(ErrorKind::file, error.path1().string(), ": cannot be read: ", error.code().message(), "; check the path");
}

bool path_exists(const fs::path& path) {
  return look_at_paths([&] { return fs::exists(path); });
}

bool is_folder(const fs::path& path) {
  return look_at_paths([&] { return fs::is_directory(path); });
}

bool is_file(const fs::path& path) {
  return look_at_paths([&] { return fs::is_regular_file(path); });
}

std::uintmax_t size_of_file(const fs::path& path) {
  return look_at_paths([&] { return fs::file_size(path); });
}

fs::path real_path(const fs::path& path) {
  return look_at_paths([&] { return fs::canonical(path); });
}

}  // namespace insonify
