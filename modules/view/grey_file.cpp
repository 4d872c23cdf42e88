// SPDX-License-Identifier: BSD-3-Clause
#include "view/grey_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkTypeTraits.h>

#include "core/error.hpp"
#include "files/input_file.hpp"
#include "files/pending_file.hpp"
#include "files/read_apart.hpp"
#include "view/label_colours.hpp"
#include "view/off_screen_internal.hpp"
#include "view/scene_colours_internal.hpp"

namespace insonify {
namespace {

// Returns a PNG of so many channels, rows from the top, filled by `put`. VTK's origin is the lower left corner.
template <typename Value, typename Put>
std::string png_of_pixels(Eigen::Index rows, Eigen::Index columns, int channels, const char* who, const Put& put) {
  if (rows * columns == 0)
    fail(ErrorKind::argument, who, ": picture of ", rows, " x ", columns, " values, must have one at least");
  const VtkMessages messages;
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(columns), static_cast<int>(rows), 1);
  image->AllocateScalars(vtkTypeTraits<Value>::VTK_TYPE_ID, channels);
  auto* pixel = static_cast<Value*>(image->GetScalarPointer());
  for (Eigen::Index row = rows; row-- > 0;)
    for (Eigen::Index column = 0; column < columns; ++column, pixel += channels) put(row, column, pixel);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  return bytes_of_png(writer, messages, who);
}

template <typename Grey>
void save_grey(const std::string& path, const Grid<Grey>& grey) {
  const auto put = [&](Eigen::Index row, Eigen::Index column, Grey* pixel) { *pixel = grey(row, column); };
  write_png(path, png_of_pixels<Grey>(grey.rows(), grey.cols(), 1, "save_grey_png", put));
}

template <typename Grey>
Grid<std::uint16_t> values_of(vtkImageData* image) {
  const int* size = image->GetDimensions();
  return Eigen::Map<const Grid<Grey>>(static_cast<const Grey*>(image->GetScalarPointer()), size[1], size[0])
      .colwise()
      .reverse()
      .template cast<std::uint16_t>();
}

/// The head of a PNG (Portable Network Graphics 1.2, 11.2.2). The end of the file is checked, too: VTK's reader draws
/// the rest of a truncated file as black.
struct PngHead {
  std::size_t bytes = 0;  ///< size of the file
  double width = 0, height = 0;
  int bits = 0, channels = 1;
};

PngHead png_head(const std::string& path) {
  require_regular_file(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(ErrorKind::file, path, ": cannot be read");
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n")) fail(ErrorKind::content, path, ": does not begin as a PNG does");
  if (bytes.size() < 45 || bytes.find("IEND", bytes.size() - 20) == bytes.npos)
    fail(ErrorKind::content, path, ": does not end as a PNG does; the file is truncated, copy it again");
  const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(bytes[at]); };
  const auto number = [&](std::size_t at) {
    return ((byte(at) * 256.0 + byte(at + 1)) * 256 + byte(at + 2)) * 256 + byte(at + 3);
  };
  constexpr std::array channels = {1, 1, 3, 1, 2, 3, 4};  // by type of colours
  return {bytes.size(), number(16), number(20), byte(24), byte(25) < channels.size() ? channels[byte(25)] : 4};
}

GreyPicture read_png(const std::string& path) {
  const VtkMessages messages;
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  if (reader->GetErrorCode() != 0 || image->GetNumberOfPoints() < 1)
    fail(ErrorKind::content, path, ": is a damaged PNG; copy it again");
  if (image->GetNumberOfScalarComponents() != 1)
    fail(ErrorKind::content, path, ": has ", image->GetNumberOfScalarComponents(),
         " channels, must have one: a grey value for each beam and bin");
  if (image->GetScalarType() == VTK_UNSIGNED_SHORT) return {16, values_of<std::uint16_t>(image)};
  return {8, values_of<std::uint8_t>(image)};
}

}  // namespace

GreyPicture load_grey_png(const std::string& path) {
  const PngHead head = png_head(path);
  const auto read = [](ArraySender& to, const std::string& name, std::size_t bytes, double pixels, double bytes_each) {
    expect_from_file(name, bytes, {pixels, "pixels", bytes_each, "crop it"});
    const GreyPicture picture = read_png(name);
    to(picture.bits, picture.value);
  };
  GreyPicture picture;
  read_apart(path, limits_of_file(head.bytes), read, path, head.bytes, head.width * head.height,
             head.channels * (head.bits > 8 ? 2.0 : 1.0))(picture.bits, picture.value);
  return picture;
}

void save_grey_png(const std::string& path, const Grid<std::uint8_t>& grey) { save_grey(path, grey); }
void save_grey_png(const std::string& path, const Grid<std::uint16_t>& grey) { save_grey(path, grey); }

std::array<std::uint8_t, 3> label_colour(std::uint8_t category) {
  if (category == 0) return {0, 0, 0};
  return category == 1 ? Rgb{42, 66, 138} : material_colours[(category - 2U) % std::size(material_colours)];
}

void save_rgb_png(const std::string& path, const Grid<std::uint32_t>& rgb) {
  const auto put = [&](Eigen::Index row, Eigen::Index column, std::uint8_t* pixel) {
    for (int k = 0; k < 3; ++k) pixel[k] = static_cast<std::uint8_t>(rgb(row, column) >> (16 - 8 * k));
  };
  write_png(path, png_of_pixels<std::uint8_t>(rgb.rows(), rgb.cols(), 3, "save_rgb_png", put));
}

std::string label_png(const std::string& path, const Grid<std::uint8_t>& category) {
  require_png_name(path);
  const auto put = [&](Eigen::Index row, Eigen::Index column, std::uint8_t* pixel) {
    const auto colour = label_colour(category(row, column));
    std::copy(colour.begin(), colour.end(), pixel);
  };
  return png_of_pixels<std::uint8_t>(category.rows(), category.cols(), 3, "label_png", put);
}

void save_label_png(const std::string& path, const Grid<std::uint8_t>& category) {
  write_file(path, label_png(path, category));
}

}  // namespace insonify
