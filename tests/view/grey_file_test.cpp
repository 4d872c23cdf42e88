// Grey pictures as files.
#include "view/grey_file.hpp"

#include "support/test.hpp"

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
