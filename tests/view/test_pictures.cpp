// SPDX-License-Identifier: BSD-3-Clause
#include "view/test_pictures.hpp"

#include <vtkImageData.h>
#include <vtkPNGReader.h>

#include "support/test.hpp"
#include "support/vtk_file.hpp"

namespace insonify {

LevelImage flat_image(std::size_t beams, double field_of_view_deg, std::size_t bins, float level_db, bool port_first) {
  LevelImage image;
  image.fan = make_fan(beams, radians(field_of_view_deg), radians(1), radians(20));
  if (port_first) std::reverse(image.fan.azimuth.begin(), image.fan.azimuth.end());
  image.gate = {1.0, 1.0 + 0.5 * static_cast<double>(bins), 0.5};
  image.unit = "dB re 1 µPa";
  image.level_db =
      Grid<float>::Constant(static_cast<Eigen::Index>(beams), static_cast<Eigen::Index>(image.gate.bins()), level_db);
  return image;
}

Rgb ReadPicture::at(double x, double y) const {
  const auto column = static_cast<std::size_t>(std::clamp(x, 0.0, width - 1.0));
  const auto row = static_cast<std::size_t>(std::clamp(y, 0.0, height - 1.0));
  const std::size_t first = 3 * (row * static_cast<std::size_t>(width) + column);
  return {bytes[first], bytes[first + 1], bytes[first + 2]};
}

ReadPicture read_png(const std::string& path) {
  const auto image = read_vtk<vtkPNGReader>(path);
  ReadPicture picture;
  picture.width = image->GetDimensions()[0], picture.height = image->GetDimensions()[1];
  EXPECT_EQ(image->GetNumberOfScalarComponents(), 3);
  const auto* first = static_cast<const std::uint8_t*>(image->GetScalarPointer());
  picture.bytes.assign(first, first + 3 * picture.width * picture.height);
  return picture;
}

int colour_difference(const Rgb& a, const Rgb& b) {
  int largest = 0;
  for (std::size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(int{a[c]} - int{b[c]}));
  return largest;
}

Blob find_colour(const ReadPicture& picture, const Rgb& colour, double left, double right, double bottom, double top) {
  Blob blob;
  for (int y = std::max(0, static_cast<int>(bottom)); y < std::min<double>(picture.height, top); ++y)
    for (int x = std::max(0, static_cast<int>(left)); x < std::min<double>(picture.width, right); ++x)
      if (colour_difference(picture.at(x, y), colour) <= 2) {
        blob.x += x + 0.5;
        blob.y += y + 0.5;
        ++blob.pixels;
      }
  blob.x /= std::max(blob.pixels, 1);
  blob.y /= std::max(blob.pixels, 1);
  return blob;
}

double line_height(const ReadPicture& picture, double from, double to) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = static_cast<int>(from * picture.width); x < to * picture.width; ++x)
      if (const Rgb colour = picture.at(x, y); colour[2] > colour[0] + 60) sum += y, ++count;
  return count > 0 ? sum / count : -1;
}

}  // namespace insonify
