#include "view/grey_file.hpp"

#include <fstream>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>

#include "core/error.hpp"
#include "view/off_screen_internal.hpp"

namespace insonify {
namespace {

// VTK's origin is the lower left corner.
template <typename Grey>
void save_png_of(const std::string& path, const Grid<Grey>& grey) {
  if (grey.size() == 0)
    fail(ErrorKind::argument, "save_grey_png: ", path, ": picture of ", grey.rows(), " x ", grey.cols(),
         " values, must have one at least");
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

}  // namespace insonify
