// SPDX-License-Identifier: BSD-3-Clause
// Pictures drawn under a limit of memory, and by several threads.
#include <thread>

#include <sys/resource.h>

#include "files/memory_limit.hpp"
#include "support/sanitizers.hpp"
#include "support/test.hpp"
#include "view/off_screen_internal.hpp"
#include "view/save_vtk.hpp"
#include "view/show_image.hpp"
#include "view/test_pictures.hpp"

TEST(OffScreen, says_what_memory_a_picture_takes_where_a_limit_leaves_less) {
  if (sanitized) GTEST_SKIP() << "shadow memory is beyond any limit";
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  const rlimit narrow{address_space() + (std::size_t{600} << 20), before.rlim_max};
  setrlimit(RLIMIT_AS, &narrow);
  const std::string said =
      error_with_kind([] { show_fan(flat_image(9, 90, 20, -20), PictureOptions{}, own_path("a.png")); });
  setrlimit(RLIMIT_AS, &before);
  EXPECT_THAT(said, testing::StartsWith("memory: "));
  EXPECT_THAT(said, HasSubstr("too little memory for a picture: the limit (ulimit -v) leaves"));
  EXPECT_FALSE(std::filesystem::exists(own_path("a.png")));
}

// Fans are trimmed by the size of their texts before they are drawn.
TEST(OffScreen, threads_draw_and_save_what_one_does) {
  const auto draw = [](int who) {
    PictureOptions options;
    options.width = 400, options.height = 300, options.trim = true;
    options.title = "The same";
    const std::string picture = own_path(std::to_string(who) + ".png"), lines = own_path(std::to_string(who) + ".vtp");
    show_fan(flat_image(9, 90, 20, -20), options, picture);
    save_lines(lines, {{{{0, 0, 0}, {1, 1, 1}}}, {{"level_db", {-20}}}});
    return file_bytes(picture) + file_bytes(lines);
  };
  const std::string expected = draw(8);
  constexpr int threads = 8, rounds = 3;
  std::vector<std::string> drawn(threads);
  {
    std::vector<std::jthread> all;
    for (int who = 0; who < threads; ++who)
      all.emplace_back([&, who] {
        for (int round = 0; round < rounds; ++round) drawn[static_cast<std::size_t>(who)] = draw(who);
      });
  }
  for (const std::string& bytes : drawn) EXPECT_TRUE(bytes == expected);
}
