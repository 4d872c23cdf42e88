#pragma once
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.hpp"

namespace insonify {

/// A folder of this process, removed when it ends.
class OwnFolder {
 public:
  OwnFolder() : path_(std::filesystem::path(::testing::TempDir()) / ("insonify_store_" + std::to_string(::getpid()))) {}
  ~OwnFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A path unique to the running test.
inline std::string own_path(const std::string& name) {
  static const OwnFolder own;
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto folder = own.path() / (std::string(test->test_suite_name()) + "_" + test->name());
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

/// Writes `text` to a file of the running test, returns its path.
inline std::string own_file(const std::string& name, const std::string& text) {
  const std::string path = own_path(name);
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// The error of a call as "kind: text"; fails the test if it does not throw.
template <typename Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    const char* kinds[] = {"runtime", "argument", "content", "file"};
    return std::string(kinds[static_cast<int>(error.kind())]) + ": " + error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

/// Replaces the first occurrence of `from`, which must be there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

}  // namespace insonify
