// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "core/vector_functions.hpp"
#include "view/drawn_cells_internal.hpp"

namespace insonify {
namespace {

constexpr int least_pixels = 240,
              most_pixels = 8192;  // smaller pictures have no room for labels; larger ones exceed GL's frame buffers
constexpr std::size_t max_rows = 8192;  // largest patch: GL guarantees no larger textures
constexpr double same_bearing = 1e-9;   // [rad]

// Returns the mean power of a block of levels; NaN counts as zero power.
template <typename Block>
float mean_power_db(const Block& level_db) {
  double power = 0;
  for (Eigen::Index row = 0; row < level_db.rows(); ++row)
    for (Eigen::Index column = 0; column < level_db.cols(); ++column) {
      const double level = level_db(row, column);
      power += level == level ? vec::exp(level * (std::numbers::ln10 / 10)) : 0;
    }
  return static_cast<float>(db_from_power(power / static_cast<double>(level_db.size())));
}

// Combines rows x columns blocks by mean power; the last row and column of blocks may be smaller.
Grid<float> combine(const Grid<float>& level_db, Eigen::Index first_column, Eigen::Index end_column, Eigen::Index rows,
                    Eigen::Index columns) {
  const Eigen::Index width = end_column - first_column;
  Grid<float> combined((level_db.rows() + rows - 1) / rows, (width + columns - 1) / columns);
  parallel_for(static_cast<std::size_t>(combined.rows()), 0, [&](std::size_t g) {
    const Eigen::Index row = static_cast<Eigen::Index>(g);
    const Eigen::Index first_row = row * rows, row_count = std::min(rows, level_db.rows() - first_row);
    if (rows == 1 && columns == 1) {
      combined.row(row) = level_db.row(row).segment(first_column, width);
      return;
    }
    for (Eigen::Index column = 0; column < combined.cols(); ++column) {
      const Eigen::Index first = first_column + column * columns;
      combined(row, column) =
          mean_power_db(level_db.block(first_row, first, row_count, std::min(columns, end_column - first)));
    }
  });
  return combined;
}

// Returns the number of neighbours to combine so that a group is at least half a pixel long.
Eigen::Index bins_per_group(double bin_pixels) {
  return std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::ceil(0.5 / bin_pixels - 1e-9)));
}

CellPatch make_patch(const BeamCells& cells, const RangeGate& gate, Eigen::Index first_bin, Eigen::Index end_bin,
                     std::size_t beams, Eigen::Index bins) {
  CellPatch patch;
  patch.level_db = combine(cells.level_db, first_bin, end_bin, static_cast<Eigen::Index>(beams), bins);
  patch.beams_per_row = beams;
  patch.min_range = gate.min_range + static_cast<double>(first_bin) * gate.bin_size;
  patch.max_range = gate.min_range + static_cast<double>(end_bin) * gate.bin_size;
  patch.columns = static_cast<double>(end_bin - first_bin) / static_cast<double>(bins);
  return patch;
}

// Beams ordered by bearing along the circle, which is cut at its widest gap.
struct OrderedBearings {
  std::vector<std::size_t> beam;
  std::vector<double> bearing;  // ascending, unwrapped
  double gap = 0;               // the widest gap, where the circle was cut
};
OrderedBearings order_bearings(const BeamFan& fan) {
  const std::size_t n = fan.beams();
  std::vector<double> bearing(n);
  for (std::size_t b = 0; b < n; ++b) bearing[b] = std::remainder(-fan.azimuth[b], 2 * pi);
  OrderedBearings ordered;
  ordered.beam.resize(n);
  std::iota(ordered.beam.begin(), ordered.beam.end(), 0);
  std::stable_sort(ordered.beam.begin(), ordered.beam.end(),
                   [&](std::size_t a, std::size_t b) { return bearing[a] < bearing[b]; });

  // Among equal gaps cut the one after the last beam, across the stern, which rotates nothing.
  const auto& order = ordered.beam;
  std::size_t first = 0;
  ordered.gap = bearing[order.front()] + 2 * pi - bearing[order.back()];
  for (std::size_t i = 1; i < n; ++i) {
    const double gap = bearing[order[i]] - bearing[order[i - 1]];
    if (gap > ordered.gap + same_bearing) {
      ordered.gap = gap;
      first = i;
    }
  }
  for (std::size_t i = 0; i < first; ++i) bearing[order[i]] += 2 * pi;
  std::rotate(ordered.beam.begin(), ordered.beam.begin() + static_cast<std::ptrdiff_t>(first), ordered.beam.end());

  // Bring a fan that lies wholly across the stern back by a whole turn.
  const double middle = (bearing[ordered.beam.front()] + bearing[ordered.beam.back()]) / 2;
  const double turn = middle > pi + same_bearing ? -2 * pi : 0;
  for (const std::size_t b : ordered.beam) ordered.bearing.push_back(bearing[b] + turn);
  return ordered;
}

// Returns the edges between distinct bearings; a full circle closes without overlap.
std::vector<double> cell_edges(const std::vector<double>& bearing, double gap, double lone_width) {
  if (bearing.size() == 1) return {bearing[0] - lone_width / 2, bearing[0] + lone_width / 2};
  const std::size_t n = bearing.size();
  std::vector<double> edges(n + 1);
  for (std::size_t b = 1; b < n; ++b) edges[b] = (bearing[b - 1] + bearing[b]) / 2;
  edges[0] = bearing[0] - std::min(bearing[1] - bearing[0], gap) / 2;
  edges[n] = bearing[n - 1] + std::min(bearing[n - 1] - bearing[n - 2], gap) / 2;
  return edges;
}

// Returns the largest difference of bearings within one cell. Beams of a regular grid of rows have equal bearings; with
// staggered rows or an unordered table, each cell spans half a beam width.
double cell_reach(const BeamFan& fan, const std::vector<double>& ascending_bearing) {
  std::size_t distinct = 1;
  for (std::size_t i = 1; i < ascending_bearing.size(); ++i)
    distinct += ascending_bearing[i] - ascending_bearing[i - 1] > same_bearing;
  const std::size_t rows = fan_rows(fan).size();
  return rows == 1 || distinct * rows == fan.beams() ? same_bearing : std::max(same_bearing, fan.beam_width / 2);
}

}  // namespace

void require_picture_size(const PictureOptions& options, const char* who) {
  for (const int pixels : {options.width, options.height})
    if (pixels < least_pixels || pixels > most_pixels)
      fail(ErrorKind::argument, who, ": options.width x height = ", options.width, " x ", options.height,
           " pixels, must be ", least_pixels, " to ", most_pixels, " either way");
}

void require_drawable(const LevelImage& image, const PictureOptions& options, const char* who) {
  require_valid(image.fan, who);
  require_valid(image.gate, who);
  const auto rows = static_cast<std::size_t>(image.level_db.rows());
  const auto columns = static_cast<std::size_t>(image.level_db.cols());
  if (rows != image.fan.beams() || columns != image.gate.bins())
    fail(ErrorKind::argument, who, ": image.level_db is ", rows, " x ", columns,
         ", must be beams x bins = ", image.fan.beams(), " x ", image.gate.bins());
  require_picture_size(options, who);
}

BeamCells order_beams(const LevelImage& image) {
  const OrderedBearings ordered = order_bearings(image.fan);
  const double reach = cell_reach(image.fan, ordered.bearing);
  std::vector<double> low, high;
  std::vector<std::vector<std::size_t>> beams;  // by cell
  for (std::size_t i = 0; i < ordered.beam.size(); ++i) {
    if (low.empty() || ordered.bearing[i] - low.back() > reach) {
      low.push_back(ordered.bearing[i]);
      beams.emplace_back();
    }
    high.resize(low.size());
    high.back() = ordered.bearing[i];
    beams.back().push_back(ordered.beam[i]);
  }

  BeamCells cells;
  cells.elevations = fan_rows(image.fan).size();
  std::vector<double> bearing;
  for (std::size_t c = 0; c < low.size(); ++c)
    bearing.push_back(high[c] - low[c] > same_bearing ? (low[c] + high[c]) / 2 : low[c]);
  const double lone_width = image.fan.beam_width > 0 ? std::min(image.fan.beam_width, 2 * pi) : radians(2);
  cells.edges = cell_edges(bearing, ordered.gap, lone_width);
  cells.level_db.resize(static_cast<Eigen::Index>(bearing.size()), image.level_db.cols());
  parallel_for(bearing.size(), 0, [&](std::size_t cell) {
    auto row = cells.level_db.row(static_cast<Eigen::Index>(cell));
    row = image.level_db.row(static_cast<Eigen::Index>(beams[cell][0]));
    for (const std::size_t b : beams[cell]) {
      const auto other = image.level_db.row(static_cast<Eigen::Index>(b));
      row = (other > row || row.isNaN()).select(other, row);
    }
  });
  return cells;
}

std::string unit_text(const std::string& unit, const BeamCells& cells) {
  if (cells.elevations < 2) return unit;
  return unit + ", strongest of " + std::to_string(cells.elevations) + " elevations";
}

std::vector<CellPatch> fan_patches(const BeamCells& cells, const RangeGate& gate, double pixels_per_metre) {
  const auto beams = static_cast<std::size_t>(cells.level_db.rows());
  const Eigen::Index bins = bins_per_group(gate.bin_size * pixels_per_metre);
  const double width_per_metre = cells.mean_width() * pixels_per_metre;  // mean width of a beam [pixels]

  // Go inwards from the outer arc: each ring extends to the range where its groups of beams become too narrow.
  std::vector<CellPatch> patches;
  std::size_t group = 1;
  while (beams / group > max_rows) group *= 2;
  for (Eigen::Index end = cells.level_db.cols(); end > 0; group *= 2) {
    const double too_narrow = 0.5 / (width_per_metre * static_cast<double>(group));  // at this range [m]
    const double first = std::ceil((too_narrow - gate.min_range) / gate.bin_size);
    const Eigen::Index begin =
        group >= beams
            ? 0
            : std::clamp<Eigen::Index>(static_cast<Eigen::Index>(std::max(0.0, std::min(first, 1e9))), 0, end);
    if (begin < end) patches.push_back(make_patch(cells, gate, begin, end, group, bins));
    end = begin;
  }
  return patches;
}

CellPatch rect_patch(const BeamCells& cells, const RangeGate& gate, double width, double height) {
  const double beam_pixels = width / static_cast<double>(cells.level_db.rows());
  const double bin_pixels = height / static_cast<double>(cells.level_db.cols());
  return make_patch(cells, gate, 0, cells.level_db.cols(), static_cast<std::size_t>(bins_per_group(beam_pixels)),
                    bins_per_group(bin_pixels));
}

}  // namespace insonify
