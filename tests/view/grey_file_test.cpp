// SPDX-License-Identifier: BSD-3-Clause
// Grey pictures as files.
#include "view/grey_file.hpp"

#include "support/test.hpp"
#include "tool/command/reader_server.hpp"

TEST(GreyFile, reads_what_it_wrote_in_8_and_16_bits) {
  Grid<std::uint8_t> eight(2, 3);
  eight << 0, 1, 2, 253, 254, 255;
  save_grey_png(own_path("8.png"), eight);
  EXPECT_EQ(load_grey_png(own_path("8.png")).bits, 8);
  EXPECT_TRUE((load_grey_png(own_path("8.png")).value == eight.cast<std::uint16_t>()).all());
  const Grid<std::uint16_t> sixteen = eight.cast<std::uint16_t>() * 257;
  save_grey_png(own_path("16.png"), sixteen);
  EXPECT_EQ(load_grey_png(own_path("16.png")).bits, 16);
  EXPECT_TRUE((load_grey_png(own_path("16.png")).value == sixteen).all());
  const auto load = [](const std::string& path) { load_grey_png(path); };
  const std::string png = file_bytes(own_path("16.png"));
  EXPECT_THAT(error_of_file(load, "cut.png", png.substr(0, png.size() - 5)),
              HasSubstr("content: cut.png: does not end as a PNG does"));
  EXPECT_THAT(error_of_file(load, "other.png", "GIF89a"),
              HasSubstr("content: other.png: does not begin as a PNG does"));
  EXPECT_THAT(error_with_kind([&] { load("none.png"); }), HasSubstr("file: none.png"));
}

// libpng leaves a damaged file by a jump to where VTK's reader has not been.
TEST(GreyFile, refuses_damaged_files_and_says_why) {
  const Grid<std::uint8_t> grey = Grid<std::uint8_t>::Constant(30, 40, 7);
  save_grey_png(own_path("good.png"), grey);
  const std::string good = file_bytes(own_path("good.png"));
  const tool::ReaderServer server;  // libpng ends its process
  const auto load = [](const std::string& path) { load_grey_png(path); };
  const auto damaged = [&](std::size_t at, const std::string& bytes) {
    return error_of_file(load, "a.png", std::string(good).replace(at, bytes.size(), bytes));
  };
  const std::size_t data = good.find("IDAT") + 4;
  for (const auto& [at, bytes] : {std::pair<std::size_t, std::string>{19, "\x01"},  // width
                                  {24, "\x03"},                                     // bits
                                  {data, "\xff"},
                                  {data + 3, "\xff\xff"},
                                  {12, "IHDX"}})
    EXPECT_THAT(damaged(at, bytes),
                AllOf(HasSubstr("content: a.png: the process that reads the file ended with signal"),
                      HasSubstr("libpng"), HasSubstr("copy or export it again")))
        << at;
  EXPECT_THAT(
      damaged(16, "\x10"),  // 268 million pixels in each row
      AllOf(HasSubstr("content: a.png: its header announces 8053064880 pixels"), HasSubstr("may take 64 MiB at most")));
}
