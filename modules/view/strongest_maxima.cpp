#include "view/strongest_maxima.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "view/drawn_cells_internal.hpp"
#include "view/ticks_internal.hpp"

namespace insonify {
namespace {

constexpr const char* who = "strongest_maxima";
constexpr double least_distance = 0.05;  // between marks, as a fraction of the outer range

struct Maximum {
  Eigen::Index row = 0, bin = 0;
  float level_db = 0;
};

// Of equal neighbours only the first is a maximum.
bool is_maximum(const Grid<float>& level_db, Eigen::Index row, Eigen::Index bin) {
  const float level = level_db(row, bin);
  for (Eigen::Index r = std::max<Eigen::Index>(0, row - 1); r <= std::min(row + 1, level_db.rows() - 1); ++r)
    for (Eigen::Index b = std::max<Eigen::Index>(0, bin - 1); b <= std::min(bin + 1, level_db.cols() - 1); ++b) {
      const bool before = r < row || (r == row && b < bin);
      if (level_db(r, b) > level || (before && level_db(r, b) == level)) return false;
    }
  return true;
}

// Strongest first; of equal ones the first of the image.
std::vector<Maximum> local_maxima(const Grid<float>& level_db, double within_db) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const float level : level_db.reshaped<Eigen::RowMajor>())
    if (std::isfinite(level)) {
      lowest = std::min<double>(lowest, level);
      highest = std::max<double>(highest, level);
    }
  std::vector<Maximum> maxima;
  for (Eigen::Index row = 0; row < level_db.rows(); ++row)
    for (Eigen::Index bin = 0; bin < level_db.cols(); ++bin) {
      const float level = level_db(row, bin);
      if (level > lowest && level >= highest - within_db && is_maximum(level_db, row, bin))
        maxima.push_back({row, bin, level});
    }
  std::stable_sort(maxima.begin(), maxima.end(),
                   [](const Maximum& a, const Maximum& b) { return a.level_db > b.level_db; });
  return maxima;
}

std::string name_of(double bearing, double range, double bin_size, double level_db) {
  std::string text = number_text(range, std::clamp(round_step(bin_size), 0.01, 0.1));
  text += " m, ";
  text += bearing_text(degrees(bearing), 0.1);
  text += ", ";
  return text + number_text(level_db, 0.1) + " dB";
}

double distance(const Mark& a, const Mark& b) {
  const double squared =
      a.range * a.range + b.range * b.range - 2 * a.range * b.range * std::cos(a.bearing - b.bearing);
  return std::sqrt(std::max(0.0, squared));
}

}  // namespace

std::vector<Mark> strongest_maxima(const LevelImage& image, std::size_t count, double within_db) {
  require_drawable(image, {}, who);
  if (!(within_db > 0)) fail(ErrorKind::argument, who, ": within_db = ", within_db, " dB, must be > 0");
  const BeamCells cells = order_beams(image);
  const double apart = least_distance * image.gate.max_range;
  std::vector<Mark> marks;
  for (const Maximum& maximum : local_maxima(cells.level_db, within_db)) {
    if (marks.size() == count) break;
    const auto row = static_cast<std::size_t>(maximum.row);
    const double bearing = (cells.edges[row] + cells.edges[row + 1]) / 2;
    const double range = image.gate.centre(static_cast<std::size_t>(maximum.bin));
    const Mark mark{bearing, range, name_of(bearing, range, image.gate.bin_size, maximum.level_db)};
    if (std::all_of(marks.begin(), marks.end(), [&](const Mark& other) { return distance(mark, other) >= apart; }))
      marks.push_back(mark);
  }
  return marks;
}

}  // namespace insonify
