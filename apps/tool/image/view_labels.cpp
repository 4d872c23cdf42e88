// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "files/pending_file.hpp"
#include "returns/fan_areas.hpp"
#include "store/run_directory.hpp"
#include "tool/dataset/labelled_image.hpp"
#include "tool/image/image.hpp"
#include "view/colour_maps_internal.hpp"
#include "view/label_colours.hpp"

namespace insonify::tool {
namespace {

/// Draws the classes of the pixels in true geometry, as view fan lies, and writes what the colours mean beside it.
void draw_labels(const PictureRequest& job) {
  const Ping& whole = job.run.cube.pings[job.ping];
  if (whole.labels.empty())
    fail(ErrorKind::content, job.run.path, ": ping ", job.ping, " has no labels: make the run with --keep labels");
  const std::string json = std::filesystem::path(job.path).replace_extension(".json").string();
  require_free_file(json, job.options.force, {job.run.path});
  const Ping ping = row_of(whole, rows_of(whole) / 2);
  const std::vector<std::string> classes = class_names(ping.labels);
  const Grid<float> level = level_image(ping, tvg_of(job.options, whole.absorption_db_per_m)).level_db;
  const ColourScale scale = colour_scale(level, job.picture, "image");
  const Grid<std::uint8_t> category = classes_above(classes_of(ping.labels, least_label_share, classes), level,
                                                    parse_min_level(job.options.min_level, scale.min_db));
  const FanRaster raster = fan_raster(ping.fan, ping.gate, job.picture.width);
  const Grid<std::uint16_t> no_objects = Grid<std::uint16_t>::Zero(category.rows(), category.cols());
  const FanPixels shown = pixels_above(fan_pixels({level, category, no_objects}, ping.fan, ping.gate, raster),
                                       parse_min_level(job.options.min_level, scale.min_db));
  nlohmann::ordered_json palette{{"least_share", least_label_share},
                                 {"metres_per_pixel", raster.metres_per_pixel},
                                 {"head_column", raster.head_column},
                                 {"head_row", raster.head_row},
                                 {"classes", palette_json(classes)}};
  for (auto& row : palette["classes"]) row["samples"] = (category == row["value"].get<std::uint8_t>()).count();
  write_files({{json, palette.dump(2) + "\n"}, {job.path, label_png(job.path, shown.category)}});
}

}  // namespace

ViewSpec labels_view() {
  return {.name = "labels",
          .shows = "what every pixel shows by class, in the colours of a .json beside it, of a run with --keep labels",
          .options = {{"--min-level", &ImageOptions::min_level, min_level_help}},
          .draw = draw_labels};
}

}  // namespace insonify::tool
