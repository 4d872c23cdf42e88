// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/error.hpp"
#include "run/parse_values.hpp"
#include "tool/dataset/labelled_image.hpp"
#include "view/label_colours.hpp"

namespace insonify::tool {
namespace {

/// The rows of `beams` of a map, or nothing of an empty one.
template <typename Map>
Map of_beams(const Map& map, const std::vector<std::size_t>& beams) {
  if (map.size() == 0) return {};
  Map part(static_cast<Eigen::Index>(beams.size()), map.cols());
  for (std::size_t k = 0; k < beams.size(); ++k)
    part.row(static_cast<Eigen::Index>(k)) = map.row(static_cast<Eigen::Index>(beams[k]));
  return part;
}

}  // namespace

std::vector<std::string> class_names(const PixelLabels& labels) {
  std::vector<std::string> classes{"nothing", "shadow"};
  classes.insert(classes.end(), labels.names.begin(), labels.names.end());
  return classes;
}

Grid<std::uint8_t> classes_of(const PixelLabels& labels, double share, const std::vector<std::string>& classes) {
  if (classes.size() > 256)
    fail(ErrorKind::content, "the scenes have ", classes.size() - 2,
         " materials, must be at most 254 for masks of 8 bits");
  std::vector<std::uint8_t> class_of_material;
  for (const std::string& name : labels.names)
    class_of_material.push_back(
        static_cast<std::uint8_t>(std::find(classes.begin() + 2, classes.end(), name) - classes.begin()));
  return material_image(labels, share).unaryExpr([&](std::uint16_t material) {
    if (material == PixelLabels::nothing) return std::uint8_t{0};
    return material == PixelLabels::shadow ? shadow_class : class_of_material.at(material);
  });
}

std::optional<double> parse_min_level(const std::string& text, double black_db) {
  if (text.empty()) return {};
  return text == "black" ? black_db : parse_number("--min-level", text);
}

Grid<std::uint8_t> classes_above(const Grid<std::uint8_t>& classes, const Grid<float>& level_db,
                                 std::optional<double> min_level) {
  if (!min_level) return classes;
  const auto least = static_cast<float>(*min_level);
  return (classes > shadow_class && level_db < least)
      .select(Grid<std::uint8_t>::Zero(classes.rows(), classes.cols()), classes);
}

std::size_t rows_of(const Ping& ping) { return fan_rows(ping.fan).size(); }

Ping row_of(const Ping& ping, std::size_t row) {
  const std::vector<FanRow> rows = fan_rows(ping.fan);
  if (rows.size() == 1) return ping;
  const std::vector<std::size_t>& beams = rows.at(row).beams;
  Ping part{ping, ping.fan, ping.gate, of_beams(ping.pressure, beams)};
  part.expected_level = ping.expected_level, part.display_cells = ping.display_cells;
  part.fan.azimuth.clear(), part.fan.elevation.clear();
  for (const std::size_t beam : beams) {
    part.fan.azimuth.push_back(ping.fan.azimuth[beam]);
    part.fan.elevation.push_back(ping.fan.elevation[beam]);
  }
  part.intensity = of_beams(ping.intensity, beams);
  const PixelLabels& labels = ping.labels;
  part.labels = {of_beams(labels.material, beams),
                 of_beams(labels.id, beams),
                 of_beams(labels.share, beams),
                 labels.names,
                 of_beams(labels.part, beams),
                 labels.part_names,
                 labels.part_labels,
                 labels.views,
                 of_beams(labels.elevation, beams),
                 of_beams(labels.second, beams),
                 of_beams(labels.second_share, beams)};
  return part;
}

nlohmann::ordered_json palette_json(const std::vector<std::string>& classes) {
  nlohmann::ordered_json palette = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < classes.size(); ++k)
    palette.push_back({{"value", k}, {"name", classes[k]}, {"rgb", label_colour(static_cast<std::uint8_t>(k))}});
  return palette;
}

}  // namespace insonify::tool
