#include <filesystem>
#include <limits>
#include <numeric>
#include <vector>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "files/pending_file.hpp"
#include "returns/picture_grid.hpp"
#include "view/off_screen_internal.hpp"
#include "view/show_image.hpp"

namespace insonify {
namespace {

constexpr const char* show_grey_name = "show_grey";

// Row 0 is the nearest bin: VTK's origin is the lower left corner.
template <typename Grey>
void write_png(const Grid<Grey>& grey, const std::vector<Eigen::Index>& columns, const std::string& path) {
  const VtkMessages messages;
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(grey.rows()), static_cast<int>(grey.cols()), 1);
  image->AllocateScalars(sizeof(Grey) == 1 ? VTK_UNSIGNED_CHAR : VTK_UNSIGNED_SHORT, 1);
  auto* pixel = static_cast<Grey*>(image->GetScalarPointer());
  for (Eigen::Index n = 0; n < grey.cols(); ++n)
    for (const Eigen::Index beam : columns) *pixel++ = grey(beam, n);

  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  write_png(writer, path, messages, show_grey_name);
}

// Rows from the farthest bin down; sixteen bits with the high byte first.
template <typename Grey>
void write_pgm(const Grid<Grey>& grey, const std::vector<Eigen::Index>& columns, const std::string& path) {
  std::string bytes = "P5\n" + std::to_string(grey.rows()) + " " + std::to_string(grey.cols()) + "\n" +
                      std::to_string(std::numeric_limits<Grey>::max()) + "\n";
  for (Eigen::Index n = grey.cols(); n-- > 0;)
    for (const Eigen::Index beam : columns) {
      const unsigned value = grey(beam, n);
      if (sizeof(Grey) == 2) bytes += static_cast<char>(value >> 8);
      bytes += static_cast<char>(value & 0xFF);
    }
  write_file(path, bytes);
}

template <typename Grey>
void write_grey(const Grid<Grey>& grey, const BeamFan& fan, const std::string& path) {
  if (grey.size() == 0 || static_cast<std::size_t>(grey.rows()) != fan.beams())
    fail(ErrorKind::argument, show_grey_name, ": picture of ", grey.rows(), " beams x ", grey.cols(),
         " bins for a fan of ", fan.beams(), " beams, must have as many and one bin at least");
  const std::string ending = lower_case(std::filesystem::path(path).extension().string());
  if (ending == ".png")
    write_png(grey, columns_from_port(fan), path);
  else if (ending == ".pgm")
    write_pgm(grey, columns_from_port(fan), path);
  else
    fail(ErrorKind::argument, show_grey_name, ": ", path, " must end with .png or .pgm");
}

}  // namespace

void show_grey(const Grid<std::uint8_t>& grey, const BeamFan& fan, const std::string& path) {
  write_grey(grey, fan, path);
}

void show_grey(const Grid<std::uint16_t>& grey, const BeamFan& fan, const std::string& path) {
  write_grey(grey, fan, path);
}

void save_grey(const Grid<std::uint8_t>& pixels, const std::string& path) {
  if (pixels.size() == 0) fail(ErrorKind::argument, "save_grey: ", path, ": the picture has no pixel");
  std::vector<Eigen::Index> columns(static_cast<std::size_t>(pixels.cols()));
  std::iota(columns.begin(), columns.end(), 0);
  write_png(Grid<std::uint8_t>(pixels.transpose().rowwise().reverse()), columns, path);
}

}  // namespace insonify
