#include "view/grey_file.hpp"

#include <fstream>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>

#include "core/error.hpp"
#include "view/label_colours.hpp"
#include "view/off_screen_internal.hpp"
#include "view/scene_colours_internal.hpp"

namespace insonify {
namespace {

// VTK's origin is the lower left corner.
template <typename Value>
void require_pixels(const Grid<Value>& picture, const std::string& path, const char* who) {
  if (picture.size() == 0)
    fail(ErrorKind::argument, who, ": ", path, ": picture of ", picture.rows(), " x ", picture.cols(),
         " values, must have one at least");
}

template <typename Grey>
void save_png_of(const std::string& path, const Grid<Grey>& grey) {
  require_pixels(grey, path, "save_grey_png");
  const VtkMessages messages;
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(grey.cols()), static_cast<int>(grey.rows()), 1);
  image->AllocateScalars(sizeof(Grey) == 1 ? VTK_UNSIGNED_CHAR : VTK_UNSIGNED_SHORT, 1);
  Eigen::Map<Grid<Grey>>(static_cast<Grey*>(image->GetScalarPointer()), grey.rows(), grey.cols()) =
      grey.colwise().reverse();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  write_png(writer, path, messages, "save_grey_png");
}

template <typename Grey>
Grid<std::uint16_t> values_of(vtkImageData* image) {
  const int* size = image->GetDimensions();
  return Eigen::Map<const Grid<Grey>>(static_cast<const Grey*>(image->GetScalarPointer()), size[1], size[0])
      .colwise()
      .reverse()
      .template cast<std::uint16_t>();
}

// VTK's reader draws the rest of a truncated file as black: the file must end as a PNG does.
void require_whole_png(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(ErrorKind::file, path, ": cannot be read");
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n")) fail(ErrorKind::content, path, ": does not begin as a PNG does");
  if (bytes.size() < 20 || bytes.find("IEND", bytes.size() - 20) == bytes.npos)
    fail(ErrorKind::content, path, ": does not end as a PNG does; the file is truncated, copy it again");
}

}  // namespace

GreyPicture load_grey_png(const std::string& path) {
  require_whole_png(path);
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

void save_grey_png(const std::string& path, const Grid<std::uint8_t>& grey) { save_png_of(path, grey); }
void save_grey_png(const std::string& path, const Grid<std::uint16_t>& grey) { save_png_of(path, grey); }

std::array<std::uint8_t, 3> label_colour(std::uint8_t category) {
  if (category == 0) return {0, 0, 0};
  return category == 1 ? Rgb{42, 66, 138} : material_colours[(category - 2U) % std::size(material_colours)];
}

void save_label_png(const std::string& path, const Grid<std::uint8_t>& category) {
  require_pixels(category, path, "save_label_png");
  const VtkMessages messages;
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(category.cols()), static_cast<int>(category.rows()), 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* pixel = static_cast<std::uint8_t*>(image->GetScalarPointer());
  for (Eigen::Index row = category.rows() - 1; row >= 0; --row)
    for (Eigen::Index column = 0; column < category.cols(); ++column)
      for (const std::uint8_t channel : label_colour(category(row, column))) *pixel++ = channel;
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  write_png(writer, path, messages, "save_label_png");
}

}  // namespace insonify
