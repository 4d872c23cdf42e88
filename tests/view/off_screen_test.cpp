// SPDX-License-Identifier: BSD-3-Clause
// Pictures drawn in a child process, which a limit of memory asks for.
#include <sys/resource.h>

#include "support/sanitizers.hpp"
#include "support/test.hpp"
#include "view/off_screen_internal.hpp"

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
