// SPDX-License-Identifier: BSD-3-Clause
#include "support/files.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <unistd.h>

namespace insonify {
namespace fs = std::filesystem;

namespace {

struct Folder {
  Folder() : path(::testing::TempDir() + "insonify_test_" + std::to_string(getpid())) { fs::create_directories(path); }
  ~Folder() {
    std::error_code ignored;
    if (getpid() == owner) fs::remove_all(path, ignored);  // not the child of a death test
  }
  const std::string path;
  const pid_t owner = getpid();
};

}  // namespace

std::string own_folder() {
  static const Folder program;
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test->test_suite_name()) + "." + test->name();
  std::replace(name.begin(), name.end(), '/', '_');
  const std::string folder = program.path + "/" + name;
  fs::create_directories(folder);
  return folder;
}

std::string own_path(const std::string& name) { return own_folder() + "/" + name; }

std::string own_file(const std::string& name, const std::string& bytes) {
  const std::string path = own_path(name);
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::string file_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

bool file_exists(const std::string& path) { return fs::exists(path); }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto position = text.find(from);
  EXPECT_NE(position, std::string::npos) << from << " is not in: " << text;
  return position == std::string::npos ? text : text.replace(position, from.size(), to);
}

}  // namespace insonify
