// SPDX-License-Identifier: BSD-3-Clause
#include "tool/command/reader_server.hpp"

#include <atomic>
#include <csignal>
#include <fstream>
#include <new>
#include <stdexcept>
#include <thread>

#include <sys/resource.h>
#include <unistd.h>

#include "files/read_apart.hpp"
#include "support/sanitizers.hpp"
#include "support/test.hpp"

using tool::ReaderServer;

namespace {

pid_t reading_process() {
  pid_t reader = 0;
  read_apart("a.vtk", {}, [](ArraySender& to) { to(getpid()); })(reader);
  return reader;
}

constexpr auto take_a_gigabyte = [](ArraySender&) { std::string(std::size_t{1} << 30, 'x'); };

}  // namespace

TEST(ReaderServer, reads_each_file_in_a_process_of_its_own) {
  {
    const ReaderServer server;
    const pid_t first = reading_process(), second = reading_process();
    EXPECT_NE(first, getpid());
    EXPECT_NE(first, second);
  }
  EXPECT_EQ(reading_process(), getpid());
}

TEST(ReaderServer, refuses_what_would_end_this_process) {
  const auto seconds_of_children = [] {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
  };
  const double before = seconds_of_children();
  {
    const ReaderServer server;
    expect_error(ErrorKind::content, {"a.vtk: the process that reads the file ended with signal 11", "copy"},
                 [] { read_apart("a.vtk", {}, [](ArraySender&) { std::raise(SIGSEGV); }); });
    expect_error(ErrorKind::content, {"signal 6 (out of order); it is damaged"}, [] {
      read_apart("a.vtk", {}, [](ArraySender&) {
        std::fputs("what went before\nout of order\n", stderr);
        std::abort();
      });
    });
    expect_error(ErrorKind::content, {"more than 1 s"}, [] {
      read_apart("a.vtk", {.seconds = 1}, [](ArraySender&) {
        for (std::atomic<int> i = 0;; ++i) {
        }
      });
    });
  }
  EXPECT_LT(seconds_of_children() - before, 5);  // of processor, also beside others
}

TEST(ReaderServer, hands_over_arrays_and_errors) {
  const ReaderServer server;
  std::string text;
  std::vector<double> numbers;
  read_apart(
      "a.h5", {},
      [](ArraySender& to, const std::string& given, int count) {
        to(given + "b", std::vector<double>(static_cast<std::size_t>(count), 0.5));
      },
      std::string(3000000, 'a'), 1000000)(text, numbers);
  EXPECT_EQ(text, std::string(3000000, 'a') + "b");
  EXPECT_EQ(numbers, std::vector<double>(1000000, 0.5));
  EXPECT_EQ(error_with_kind([] {
              read_apart("a.h5", {}, [](ArraySender& to) {
                to(std::vector<int>(100000));
                fail(ErrorKind::file, "a.h5: is a folder");
              });
            }),
            "file: a.h5: is a folder");
  expect_error(ErrorKind::content, {"a.h5: cannot be read (odd)", "copy"},
               [] { read_apart("a.h5", {}, [](ArraySender&) { throw std::runtime_error("odd"); }); });
}

TEST(ReaderServer, allows_what_a_file_rightly_announces) {
  const ReaderServer server;
  std::size_t count = 0;
  read_apart("a.png", {.memory = 1 << 20}, [](ArraySender& to) {
    expect_from_file("a.png", 1 << 20, {3e8, "pixels", 1});
    to.take_array<char>(300000000);
  }).take_array<char>(count);
  EXPECT_EQ(count, 300000000U);
}

TEST(ReaderServer, serves_threads_that_hold_locks_and_memory) {
  const ReaderServer server;
  std::atomic<bool> done = false;
  std::atomic<int> wrong = 0;
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      while (!done) std::string(100000, 'x').append("y");  // takes the locks of the heap all the time
    });
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 100; ++i) {
        std::string text;
        read_apart(
            "a.h5", {}, [](ArraySender& to, int length) { to(std::string(static_cast<std::size_t>(length), 'z')); },
            1000 * t + i)(text);
        wrong += text != std::string(static_cast<std::size_t>(1000 * t + i), 'z');
      }
    });
  for (int t = 4; t < 8; ++t) threads[static_cast<std::size_t>(t)].join();
  done = true;
  EXPECT_EQ(wrong, 0);
}

TEST(ReaderServer, ends_with_the_process_that_asks) {
  int ends[2] = {-1, -1};
  ASSERT_EQ(pipe(ends), 0);
  const pid_t asking = fork();
  if (asking == 0) {
    const ReaderServer server;
    pid_t parent_of_reader = 0;
    read_apart("a.vtk", {}, [](ArraySender& to) { to(getppid()); })(parent_of_reader);
    if (write(ends[1], &parent_of_reader, sizeof parent_of_reader) > 0) raise(SIGKILL);
    _exit(1);
  }
  pid_t serving = 0;
  ASSERT_EQ(read(ends[0], &serving, sizeof serving), static_cast<ssize_t>(sizeof serving));
  close(ends[0]), close(ends[1]);
  int status = 0;
  waitpid(asking, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  const auto lives = [&] {  // a process that ended, and that nobody has waited for, has the state Z
    std::ifstream file("/proc/" + std::to_string(serving) + "/stat");
    std::string number, name, state;
    return file >> number >> name >> state && state != "Z";
  };
  for (int i = 0; i < 500 && lives(); ++i) usleep(10000);
  EXPECT_FALSE(lives());
}

TEST(ReaderServer, holds_to_its_memory) {
  if (sanitized) GTEST_SKIP() << "shadow memory is beyond any limit";
  const ReaderServer server;
  expect_error(ErrorKind::content, {"more than 100 MiB"},
               [] { read_apart("a.vtk", {.memory = 100 << 20}, take_a_gigabyte); });
  expect_error(ErrorKind::content, {"more than 130 MiB"}, [] {
    read_apart("a.vtk", {.memory = 100 << 20}, [](ArraySender& to) {
      expect_from_file("a.vtk", 0, {10 << 20, "points", 1});
      take_a_gigabyte(to);
    });
  });
}

TEST(ReaderServer, is_short_of_memory_with_its_program) {
  if (sanitized) GTEST_SKIP() << "shadow memory is beyond any limit";
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  const rlimit narrow{std::size_t{4} << 30, before.rlim_max};
  setrlimit(RLIMIT_AS, &narrow);
  {
    const ReaderServer server;
    const auto take = [](ArraySender&) { std::string(std::size_t{5} << 30, 'x'); };
    EXPECT_THROW(read_apart("a.vtk", {.memory = std::size_t{8} << 30}, take), std::bad_alloc);
  }
  setrlimit(RLIMIT_AS, &before);
}

TEST(ReaderServer, hands_over_arrays_where_files_must_be_small) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit narrow{1024, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &narrow);
  std::string text;
  {
    const ReaderServer server;
    read_apart("a.h5", {}, [](ArraySender& to) { to(std::string(5000000, 'x')); })(text);
  }
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(text.size(), 5000000U);
}
