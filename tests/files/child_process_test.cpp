// SPDX-License-Identifier: BSD-3-Clause
#include "files/child_process.hpp"

#include <atomic>
#include <csignal>
#include <new>
#include <stdexcept>

#include <sys/resource.h>

#include "core/grid.hpp"
#include "support/sanitizers.hpp"
#include "support/test.hpp"

TEST(ChildProcess, lets_pass_what_ends_in_order) {
  bool here = false;
  try_in_child("a.vtk", {}, [&] { here = true; });
  EXPECT_FALSE(here) << "it ran in this process";
}

TEST(ChildProcess, refuses_what_would_end_this_process) {
  expect_error(ErrorKind::content, {"a.vtk: the process that reads the file ended with signal 11", "copy"},
               [] { try_in_child("a.vtk", {}, [] { std::raise(SIGSEGV); }); });
  const auto of_children = [] {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
  };
  const double before = of_children();
  expect_error(ErrorKind::content, {"more than 1 s"}, [] {
    try_in_child("a.vtk", {.seconds = 1}, [] {
      for (std::atomic<int> i = 0;; ++i) {
      }
    });
  });
  EXPECT_LT(of_children() - before, 5);  // seconds of processor, also beside others
}

namespace {

struct Handed {
  std::string text;
  std::vector<double> numbers;
  std::vector<std::string> names;
  Grid<float> grid;
  std::optional<int> here, absent;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

template <typename Stream>
void pass(Stream& stream, Handed& h) {
  stream(h.text, h.numbers, h.names, h.grid, h.here, h.absent, h.pose);
}

}  // namespace

TEST(ChildProcess, hands_over_what_it_read) {
  Handed sent{std::string(3000000, 'a') + '\0' + "end", {1, 2, 3}, {"", "x"}, Grid<float>::Random(3, 5), 7, {}};
  sent.pose.translate(Eigen::Vector3d(1, 2, 3));
  Handed got;
  std::size_t count = 0;
  ArrayReceiver receiver = read_in_child("a.h5", {}, [&](ArraySender& to) {
    to(sent, 'c');
    std::fill_n(to.take_array<double>(1000000), 1000000, 0.5);
    to(std::string("last"));
  });
  char letter = 0;
  receiver(got, letter);
  EXPECT_EQ(got.text, sent.text);
  EXPECT_EQ(got.numbers, sent.numbers);
  EXPECT_EQ(got.names, sent.names);
  EXPECT_TRUE((got.grid == sent.grid).all());
  EXPECT_EQ(got.here, 7);
  EXPECT_FALSE(got.absent);
  EXPECT_EQ(got.pose.matrix(), sent.pose.matrix());
  EXPECT_EQ(letter, 'c');
  const double* const halves = receiver.take_array<double>(count);
  EXPECT_EQ(count, 1000000U);
  EXPECT_EQ(std::count(halves, halves + count, 0.5), 1000000);
  std::string last;
  receiver(last);
  EXPECT_EQ(last, "last");
  expect_error(ErrorKind::content, {"a.h5: reading it handed over less"}, [&] { receiver(got); });
}

TEST(ChildProcess, hands_over_errors) {
  EXPECT_EQ(error_with_kind([] {
              read_in_child("a.h5", {}, [](ArraySender& to) {
                to(std::vector<int>(100000));
                fail(ErrorKind::file, "a.h5: is a folder");
              });
            }),
            "file: a.h5: is a folder");
  expect_error(ErrorKind::content, {"a.h5: cannot be read (odd)", "copy"},
               [] { try_in_child("a.h5", {}, [] { throw std::runtime_error("odd"); }); });
}

TEST(ChildProcess, judges_what_a_file_announces) {
  expect_from_file("a.png", 100, {1e6, "pixels", 1});
  expect_from_file("a.png", 1 << 20, {1e9, "pixels", 1});
  expect_error(
      ErrorKind::content,
      {"a.png: its header announces 100000000 pixels, 95.367", "file of 100 bytes may take 64 MiB at most", "crop it"},
      [] {
        expect_from_file("a.png", 100, {1e8, "pixels", 1, "crop it"});
      });
  // Reading a file as large as it states may take memory and time in proportion.
  std::size_t count = 0;
  read_in_child("a.png", {.memory = 1 << 20}, [](ArraySender& to) {
    expect_from_file("a.png", 1 << 20, {3e8, "pixels", 1});
    to.take_array<char>(300000000);
  }).take_array<char>(count);
  EXPECT_EQ(count, 300000000U);
}

TEST(ChildProcess, holds_to_its_memory) {
  if (sanitized) GTEST_SKIP() << "shadow memory is beyond any limit";
  expect_error(ErrorKind::content, {"more than 100 MiB"},
               [] { try_in_child("a.vtk", {.memory = 100 << 20}, [] { std::string(std::size_t{1} << 30, 'x'); }); });
}

TEST(ChildProcess, says_what_it_was_allowed) {
  if (sanitized) GTEST_SKIP() << "shadow memory is beyond any limit";
  expect_error(ErrorKind::content, {"more than 130 MiB"}, [] {
    try_in_child("a.vtk", {.memory = 100 << 20}, [] {
      expect_from_file("a.vtk", 0, {10 << 20, "points", 1});
      std::string(std::size_t{1} << 30, 'x');
    });
  });
}

TEST(ChildProcess, is_short_of_memory_with_its_parent) {
  if (sanitized) GTEST_SKIP() << "shadow memory is beyond any limit";
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  const rlimit narrow{std::size_t{4} << 30, before.rlim_max};
  setrlimit(RLIMIT_AS, &narrow);
  const auto take = [] { std::string(std::size_t{5} << 30, 'x'); };
  EXPECT_THROW(try_in_child("a.vtk", {.memory = std::size_t{8} << 30}, take), std::bad_alloc);
  setrlimit(RLIMIT_AS, &before);
}

TEST(ChildProcess, hands_over_arrays_where_files_must_be_small) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit narrow{1024, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &narrow);
  std::string text;
  read_in_child("a.h5", {}, [](ArraySender& to) { to(std::string(5000000, 'x')); })(text);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(text.size(), 5000000U);
}
