// SPDX-License-Identifier: BSD-3-Clause
#include "files/path_status.hpp"

#include "files/input_file.hpp"
#include "support/test.hpp"

namespace fs = std::filesystem;

TEST(PathStatus, tells_folders_and_files_from_what_is_not_there) {
  own_file("a.txt", "four");
  EXPECT_TRUE(path_exists(own_path("a.txt")) && is_file(own_path("a.txt")) && !is_folder(own_path("a.txt")));
  EXPECT_TRUE(path_exists(own_folder()) && is_folder(own_folder()) && !is_file(own_folder()));
  EXPECT_FALSE(path_exists(own_path("none")) || is_folder(own_path("none")) || is_file(own_path("none")));
  EXPECT_FALSE(path_exists(own_path("a.txt/below")));
  EXPECT_EQ(size_of_file(own_path("a.txt")), 4U);
  fs::create_symlink(own_path("a.txt"), own_path("link"));
  EXPECT_EQ(real_path(own_path("link")), real_path(own_path("a.txt")));
}

TEST(PathStatus, names_the_path_of_which_nothing_can_be_told) {
  fs::create_symlink("loop", own_path("loop"));
  const std::string loop = own_path("loop"), below = own_path("loop/cube.h5"), longer = own_path(std::string(300, 'a'));
  for (const std::string& path : {loop, below, longer}) {
    const std::vector<std::function<void()>> requested = {
        [&] { path_exists(path); },  [&] { is_folder(path); }, [&] { is_file(path); },
        [&] { size_of_file(path); }, [&] { real_path(path); }, [&] { require_regular_file(path); }};
    for (const auto& ask : requested)
      expect_error(ErrorKind::file, {path + ": cannot be read: ", "check the path"}, ask);
  }
  expect_error(ErrorKind::file, {own_path("none") + ": cannot be read: No such file"},
               [] { size_of_file(own_path("none")); });
}
