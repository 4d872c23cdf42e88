#pragma once
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.hpp"
#include "scene_io/load_scene.hpp"

namespace insonify::test {

/// A folder of this process, removed with all its files at the end.
struct TemporaryFolder {
  TemporaryFolder() : path(::testing::TempDir() + "insonify_scene_io_" + std::to_string(getpid())) {
    std::filesystem::create_directories(path);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  std::string path;
};

inline const std::string& temporary_folder() {
  static const TemporaryFolder folder;
  return folder.path;
}

/// A name in the temporary folder that no other test uses.
inline std::string temporary(const std::string& name) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string test = std::string(info->test_suite_name()) + "_" + info->name();
  std::replace(test.begin(), test.end(), '/', '_');
  return temporary_folder() + "/" + test + "_" + name;
}

inline std::string write_file(const std::string& name, const std::string& bytes) {
  const std::string path = temporary(name);
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

inline std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

/// Bytes of a number, most significant first if `big`.
template <typename T>
std::string bytes_of(T value, bool big = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// Runs `call`, which must throw Error of `kind` with all `parts` in one line of text.
template <typename Call>
void expect_error(ErrorKind kind, const std::vector<std::string>& parts, const Call& call) {
  try {
    call();
    ADD_FAILURE() << "no error thrown; expected one with '" << parts.front() << "'";
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.kind()), static_cast<int>(kind)) << error.what();
    for (const std::string& part : parts) EXPECT_THAT(error.what(), ::testing::HasSubstr(part));
    EXPECT_THAT(error.what(), ::testing::Not(::testing::HasSubstr("\n")));
  }
}

inline Eigen::Vector3d world(const SceneCloud& scene, std::size_t i) {
  return scene.origin + scene.point[i].cast<double>();
}

inline double total_area(const SceneCloud& scene) {
  double sum = 0;
  for (const float area : scene.area) sum += area;
  return sum;
}

/// Text of a square plate of `side` x `side` points in z = `height`, `spacing` apart, from (x0, y0).
inline std::string plate_text(int side, double spacing, double x0 = 0, double y0 = 0, double height = 0) {
  std::ostringstream text;
  text.precision(17);
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) text << x0 + i * spacing << ' ' << y0 + j * spacing << ' ' << height << '\n';
  }
  return text.str();
}

inline bool has_note(const LoadReport& report, const std::string& part) {
  return std::any_of(report.notes.begin(), report.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

}  // namespace insonify::test
