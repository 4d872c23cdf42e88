// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/message.hpp"
#include "run/parse_values.hpp"
#include "tool/command/progress.hpp"
#include "tool/export/product_run.hpp"
#include "tool/export/sounding_map.hpp"
#include "tool/image/image.hpp"
#include "view/show_depths.hpp"

namespace insonify::tool {
namespace {

constexpr double cells_across = 400, most_cells_across = 4000;
constexpr double soundings_per_cell = 1.5;  // about; the few cells without any are filled from those beside them
constexpr int filling_passes = 2;

/// The soundings of a run.
struct FoundBed {
  std::vector<Eigen::Vector3d> kept;
  std::vector<Eigen::Vector2d> rejected;
  Eigen::AlignedBox2d extent;  ///< extent of those that are kept
  std::size_t pings = 0;
};

void add_head(const ImageOptions& o, const std::string& head, FoundBed& bed, RunPings& last) {
  ProductOptions options;
  options.run = o.run, options.head = head, options.keep_rejected = true;
  PlacedRun run{options, find_run_pings(o.run, head)};
  each_swath(run, [&](const Cube&, const Ping&, const BottomSoundings& found) {
    ++bed.pings;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Eigen::Vector2d place = found.position[i].head<2>();
      if (found.reject[i] != 0) {
        bed.rejected.push_back(place);
        continue;
      }
      bed.kept.push_back(found.position[i]);
      bed.extent.extend(place);
    }
  });
  last = std::move(run.pings);
}

/// The size of cells: --cell, or a round length at which they hold some soundings each.
double cell_of_bed(const ImageOptions& o, const FoundBed& bed) {
  const double side = std::max(bed.extent.sizes().maxCoeff(), 1e-3);
  if (o.cell.empty()) {
    const double area = bed.extent.sizes().prod(), all = static_cast<double>(bed.kept.size());
    const double wanted = std::max(side / cells_across, std::sqrt(soundings_per_cell * area / all)),
                 ten = std::pow(10, std::floor(std::log10(wanted)));
    return ten * (wanted / ten <= 1 ? 1 : wanted / ten <= 2 ? 2 : wanted / ten <= 5 ? 5 : 10);
  }
  const double cell = parse_number("--cell", o.cell);
  if (!(cell > 0 && side / cell <= most_cells_across))
    fail(ErrorKind::argument, "--cell = ", o.cell, " m, must be > 0 and give at most ", most_cells_across,
         " cells over ", side, " m");
  return cell;
}

/// Gives cells with three neighbours at least that have a height their mean.
void fill_beside(Grid<float>& height) {
  const Grid<float> before = height;
  for (Eigen::Index x = 0; x < height.rows(); ++x)
    for (Eigen::Index y = 0; y < height.cols(); ++y) {
      if (std::isfinite(before(x, y))) continue;
      double sum = 0, count = 0;
      for (Eigen::Index i = std::max<Eigen::Index>(0, x - 1); i <= std::min(height.rows() - 1, x + 1); ++i)
        for (Eigen::Index k = std::max<Eigen::Index>(0, y - 1); k <= std::min(height.cols() - 1, y + 1); ++k)
          if (std::isfinite(before(i, k))) sum += static_cast<double>(before(i, k)), count += 1;
      if (count >= 3) height(x, y) = static_cast<float>(sum / count);
    }
}

/// The mean heights of the soundings in cells, with small gaps filled.
DepthMap map_of(const FoundBed& bed, double cell) {
  SoundingMap sums(cell);
  for (const Eigen::Vector3d& position : bed.kept) sums.add(position, 0);
  const GeoGrid grid = sums.grid();
  DepthMap map;
  map.x = grid.west, map.y = grid.south, map.cell = cell;
  map.height = sums.bands().front().values.transpose();
  for (int pass = 0; pass < filling_passes; ++pass) fill_beside(map.height);
  map.rejected = bed.rejected;
  return map;
}

/// Draws the bed that all heads of a survey, or the one of --head, found.
void draw_bathymetry(const ImageOptions& o) {
  std::vector<std::string> heads = o.head.empty() ? head_names(o.run) : std::vector<std::string>{o.head};
  if (heads.empty()) heads = {""};
  Progress progress(o.common, 2);
  progress.step("finding the bottom in " + o.run);
  FoundBed bed;
  RunPings last;
  for (const std::string& head : heads) add_head(o, head, bed, last);
  if (bed.kept.empty())
    fail(ErrorKind::content, o.run, ": has no sounding of the bottom that is not rejected; heads that look down give ",
         "them, with split = true in [ping]");
  DepthMap map = map_of(bed, cell_of_bed(o, bed));
  map.datum = depth_datum(last.water);
  if (!last.system.empty()) map.x_title = last.system + " east [m]", map.y_title = "north [m]";
  PictureOptions picture = o.picture;
  if (picture.colour_map == default_colour_map) picture.colour_map = "viridis";
  if (picture.title.empty())
    picture.title = fmt::format("{} soundings of {} pings{}, cells of {:g} m", bed.kept.size(), bed.pings,
                                heads.front().empty() ? "" : " of " + joined(heads), map.cell);
  if (o.picture.title.empty() && !bed.rejected.empty())
    picture.title += fmt::format("; {} rejected (crosses)", bed.rejected.size());
  progress.step("drawing " + o.output);
  show_depths(map, picture, o.output);
  print_summary(o.common,
                {{"output", o.output},
                 {"view", o.view},
                 {"soundings", bed.kept.size()},
                 {"rejected", bed.rejected.size()},
                 {"cell_m", map.cell}},
                o.output);
}

}  // namespace

ViewSpec bathymetry_view() {
  return {.name = "bathymetry",
          .shows = "depths of a survey or run from above: shaded relief, contours, rejected soundings",
          .options = {{"--cell", &ImageOptions::cell, "[m] size of the cells; default: by the extent"}},
          .of_survey = true,
          .draw_alone = draw_bathymetry};
}

}  // namespace insonify::tool
