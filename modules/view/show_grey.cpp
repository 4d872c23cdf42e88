// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <limits>

#include "core/error.hpp"
#include "core/text.hpp"
#include "files/pending_file.hpp"
#include "returns/picture_grid.hpp"
#include "view/grey_file.hpp"
#include "view/show_image.hpp"

namespace insonify {
namespace {

// Writes sixteen bits with the high byte first.
template <typename Grey>
void write_pgm(const Grid<Grey>& picture, const std::string& path) {
  std::string bytes = "P5\n" + std::to_string(picture.cols()) + " " + std::to_string(picture.rows()) + "\n" +
                      std::to_string(std::numeric_limits<Grey>::max()) + "\n";
  for (const unsigned value : picture.template reshaped<Eigen::RowMajor>()) {
    if (sizeof(Grey) == 2) bytes += static_cast<char>(value >> 8);
    bytes += static_cast<char>(value & 0xFF);
  }
  write_file(path, bytes);
}

template <typename Grey>
void write_grey(const Grid<Grey>& grey, const BeamFan& fan, const std::string& path) {
  constexpr const char* who = "show_grey";
  if (grey.size() == 0 || static_cast<std::size_t>(grey.rows()) != fan.beams())
    fail(ErrorKind::argument, who, ": picture of ", grey.rows(), " beams x ", grey.cols(), " bins for a fan of ",
         fan.beams(), " beams, must have as many and one bin at least");
  const std::string ending = lower_case(std::filesystem::path(path).extension().string());
  if (ending == ".png")
    save_grey_png(path, polar_picture(grey, fan));
  else if (ending == ".pgm")
    write_pgm(polar_picture(grey, fan), path);
  else
    fail(ErrorKind::argument, who, ": ", path, " must end with .png or .pgm");
}

}  // namespace

void show_grey(const Grid<std::uint8_t>& grey, const BeamFan& fan, const std::string& path) {
  write_grey(grey, fan, path);
}

void show_grey(const Grid<std::uint16_t>& grey, const BeamFan& fan, const std::string& path) {
  write_grey(grey, fan, path);
}

}  // namespace insonify
