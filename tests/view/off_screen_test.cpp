// SPDX-License-Identifier: BSD-3-Clause
// Pictures drawn in a child process, which a limit of memory asks for.
#include <thread>

#include <sys/resource.h>

#include "support/sanitizers.hpp"
#include "support/test.hpp"
#include "view/off_screen_internal.hpp"
#include "view/save_vtk.hpp"
#include "view/show_image.hpp"
#include "view/test_pictures.hpp"

TEST(OffScreen, what_a_drawing_refuses_is_no_lack_of_memory) {
  if (sanitized) GTEST_SKIP() << "shadow memory is beyond any limit";
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  const rlimit narrow{std::size_t{8} << 30, before.rlim_max};
  setrlimit(RLIMIT_AS, &narrow);
  const auto refuse = [](const VtkMessages&) -> std::string { fail(ErrorKind::content, "a.pcd: has no point"); };
  EXPECT_EQ(error_with_kind([&] { save_drawing(own_path("a.png"), "show", refuse); }), "content: a.pcd: has no point");
  const auto crash = [](const VtkMessages&) -> std::string { std::abort(); };
  EXPECT_THAT(error_with_kind([&] { save_drawing(own_path("a.png"), "show", crash); }),
              HasSubstr("memory: show: too little memory for a picture"));
  setrlimit(RLIMIT_AS, &before);
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
