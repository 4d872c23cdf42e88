#include "core/child_process.hpp"

#include <atomic>
#include <csignal>

#include "core/stop_watch.hpp"
#include "support/sanitizers.hpp"
#include "support/test.hpp"

TEST(ChildProcess, lets_pass_what_ends_in_order) {
  bool here = false;
  try_in_child("a.vtk", {}, [&] { here = true; });
  EXPECT_FALSE(here) << "it ran in this process";
  try_in_child("a.vtk", {}, [] { fail(ErrorKind::content, "said again by the caller"); });
}

TEST(ChildProcess, refuses_what_would_end_this_process) {
  expect_error(ErrorKind::content, {"a.vtk: reading it ends with signal 11", "copy"},
               [] { try_in_child("a.vtk", {}, [] { std::raise(SIGSEGV); }); });
  StopWatch watch;
  expect_error(ErrorKind::content, {"more than 1 s"}, [] {
    try_in_child("a.vtk", {.seconds = 1}, [] {
      for (std::atomic<int> i = 0;; ++i) {
      }
    });
  });
  EXPECT_LT(watch.lap(), 5);
}

TEST(ChildProcess, hands_over_what_it_read) {
  const std::string long_text = std::string(300000, 'a') + '\0' + "end";  // more than a pipe holds
  EXPECT_EQ(read_in_child("a.h5", {}, [&] { return long_text; }), long_text);
  EXPECT_EQ(read_in_child("a.h5", {}, []() -> std::string { fail(ErrorKind::content, "said again"); }), "");
  expect_error(ErrorKind::content, {"a.h5: reading it ends with signal 11"}, [] {
    read_in_child("a.h5", {}, []() -> std::string {
      std::raise(SIGSEGV);
      return "";
    });
  });
}

TEST(ChildProcess, holds_to_its_memory) {
  if (sanitized) GTEST_SKIP() << "shadow memory is beyond any limit";
  expect_error(ErrorKind::content, {"more than 100 MiB"},
               [] { try_in_child("a.vtk", {.memory = 100 << 20}, [] { std::string(std::size_t{1} << 30, 'x'); }); });
}
