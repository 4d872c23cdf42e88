// SPDX-License-Identifier: BSD-3-Clause
#include "files/read_apart.hpp"

#include <new>
#include <stdexcept>

#include <unistd.h>

#include "core/grid.hpp"
#include "support/test.hpp"

namespace {

struct HandedOver {
  std::string text;
  std::vector<double> numbers;
  std::vector<std::string> names;
  Grid<float> grid;
  std::optional<int> here, absent;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

template <typename Stream>
void pass(Stream& stream, HandedOver& h) {
  stream(h.text, h.numbers, h.names, h.grid, h.here, h.absent, h.pose);
}

}  // namespace

TEST(ReadApart, reads_in_this_process_unless_a_program_sets_another) {
  pid_t reader = 0;
  read_apart("a.vtk", {}, [](ArraySender& to) { to(getpid()); })(reader);
  EXPECT_EQ(reader, getpid());
}

TEST(ReadApart, hands_over_arguments_and_what_it_read) {
  HandedOver sent{std::string(3000000, 'a') + '\0' + "end", {1, 2, 3}, {"", "x"}, Grid<float>::Random(3, 5), 7, {}};
  sent.pose.translate(Eigen::Vector3d(1, 2, 3));
  HandedOver got;
  std::size_t count = 0;
  const auto read = [](ArraySender& to, HandedOver& given, char letter) {
    to(given, letter);
    std::fill_n(to.take_array<double>(1000000), 1000000, 0.5);
    to(std::string("last"));
  };
  ArrayReceiver receiver = read_apart("a.h5", {}, read, sent, 'c');
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

TEST(ReadApart, throws_what_the_reader_throws) {
  EXPECT_EQ(error_with_kind([] {
              read_apart("a.h5", {}, [](ArraySender& to) {
                to(std::vector<int>(100000));
                fail(ErrorKind::file, "a.h5: is a folder");
              });
            }),
            "file: a.h5: is a folder");
  expect_error(ErrorKind::content, {"a.h5: cannot be read (odd)", "copy"},
               [] { read_apart("a.h5", {}, [](ArraySender&) { throw std::runtime_error("odd"); }); });
  EXPECT_THROW(read_apart("a.h5", {}, [](ArraySender&) { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_THROW(read_apart("a.h5", {.sent = 1 << 20}, [](ArraySender& to) { to.take(2 << 20); }), std::bad_alloc);
}

TEST(ReadApart, judges_what_a_file_announces) {
  expect_from_file("a.png", 100, {1e6, "pixels", 1});
  expect_from_file("a.png", 1 << 20, {1e9, "pixels", 1});
  expect_error(
      ErrorKind::content,
      {"a.png: its header announces 100000000 pixels, 95.367", "file of 100 bytes may take 64 MiB at most", "crop it"},
      [] {
        expect_from_file("a.png", 100, {1e8, "pixels", 1, "crop it"});
      });
}
