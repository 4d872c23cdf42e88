// SPDX-License-Identifier: BSD-3-Clause
#include <vtkImageData.h>
#include <vtkPNGReader.h>
#include <vtkPNMReader.h>

#include "support/test.hpp"
#include "support/vtk_file.hpp"
#include "view/show_image.hpp"
#include "view/test_pictures.hpp"

namespace {

// Returns values that all differ.
template <typename Grey>
Grid<Grey> values(Eigen::Index beams, Eigen::Index bins, unsigned step) {
  Grid<Grey> grey(beams, bins);
  for (Eigen::Index i = 0; i < grey.size(); ++i) grey(i) = static_cast<Grey>(static_cast<unsigned>(i) * step);
  return grey;
}

BeamFan fan_of(std::size_t beams, bool port_first) {
  BeamFan fan = make_fan(beams, 1, 0.02, 0.3);
  std::sort(fan.azimuth.begin(), fan.azimuth.end());
  if (port_first) std::reverse(fan.azimuth.begin(), fan.azimuth.end());
  return fan;
}

// Reads a picture back; calls check(column, row from below, value) for every pixel.
template <typename Reader, typename Check>
void read_back(const std::string& path, int width, int height, int scalar_type, const Check& check) {
  const auto image = read_vtk<Reader>(path);
  ASSERT_EQ(image->GetDimensions()[0], width);
  ASSERT_EQ(image->GetDimensions()[1], height);
  ASSERT_EQ(image->GetNumberOfScalarComponents(), 1);
  ASSERT_EQ(image->GetScalarType(), scalar_type);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) check(x, y, image->GetScalarComponentAsDouble(x, y, 0, 0));
}

}  // namespace

TEST(ShowGrey, writes_every_value_as_it_is_with_starboard_right_and_range_upwards) {
  const auto grey8 = values<std::uint8_t>(12, 20, 1);
  const auto grey16 = values<std::uint16_t>(12, 20, 273);
  for (const bool port_first : {true, false}) {
    const BeamFan fan = fan_of(12, port_first);
    const auto beam = [&](int x) { return port_first ? x : 11 - x; };
    const auto check8 = [&](int x, int y, double value) { EXPECT_EQ(value, grey8(beam(x), y)); };
    const auto check16 = [&](int x, int y, double value) { EXPECT_EQ(value, grey16(beam(x), y)); };
    show_grey(grey8, fan, own_path("grey.png"));
    read_back<vtkPNGReader>(own_path("grey.png"), 12, 20, VTK_UNSIGNED_CHAR, check8);
    show_grey(grey16, fan, own_path("grey.png"));
    read_back<vtkPNGReader>(own_path("grey.png"), 12, 20, VTK_UNSIGNED_SHORT, check16);
    show_grey(grey8, fan, own_path("grey.pgm"));
    read_back<vtkPNMReader>(own_path("grey.pgm"), 12, 20, VTK_UNSIGNED_CHAR, check8);
  }
}

// VTK reads only 8-bit PGM, so the bytes are checked against the format (netpbm, pgm(5)).
TEST(ShowGrey, writes_sixteen_bits_of_a_pgm_with_the_high_byte_first) {
  Grid<std::uint16_t> grey(2, 2);
  grey << 0x0102, 0x0304, 0x0506, 0xFFFE;  // rows are beams, port first
  const std::string path = own_path("grey16.PGM");
  show_grey(grey, fan_of(2, true), path);
  const std::string expected("P5\n2 2\n65535\n\x03\x04\xFF\xFE\x01\x02\x05\x06", 21);
  EXPECT_EQ(file_bytes(path), expected);
}

TEST(ShowGrey, writes_a_single_pixel) {
  show_grey(Grid<std::uint16_t>(Grid<std::uint16_t>::Constant(1, 1, 40000)), fan_of(1, true), own_path("one.png"));
  read_back<vtkPNGReader>(own_path("one.png"), 1, 1, VTK_UNSIGNED_SHORT,
                          [](int, int, double value) { EXPECT_EQ(value, 40000); });
}

TEST(ShowGrey, refuses_other_endings_and_sizes) {
  const auto grey = values<std::uint8_t>(3, 2, 1);
  EXPECT_EQ(error_of([&] { show_grey(grey, fan_of(3, true), "x.jpg"); }),
            "show_grey: x.jpg must end with .png or .pgm");
  EXPECT_EQ(error_of([&] { show_grey(grey, fan_of(4, true), "x.png"); }),
            "show_grey: picture of 3 beams x 2 bins for a fan of 4 beams, must have as many and one bin at least");
  EXPECT_NE(error_of([&] { show_grey(grey, fan_of(3, true), "/no/such/folder/x.png"); }, ErrorKind::file), "no error");
  EXPECT_FALSE(file_exists("x.jpg"));
}
