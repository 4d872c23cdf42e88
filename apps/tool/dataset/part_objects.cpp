// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "tool/dataset/labelled_image.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

/// Marks the samples within the extents of a part: at least one in either direction.
Grid<std::uint8_t> samples_within(const PartView& view, const Ping& ping) {
  const auto bins = static_cast<double>(ping.gate.bins());
  const auto bin_of = [&](double range) {
    return static_cast<Eigen::Index>(
        std::clamp(std::floor((range - ping.gate.min_range) / ping.gate.bin_size), 0.0, bins - 1));
  };
  const std::vector<double>& azimuth = ping.fan.azimuth;
  // Cubes of earlier versions lack the beams.
  const PartView::Extent& beam_azimuth = std::isnan(view.beam_azimuth.least) ? view.azimuth : view.beam_azimuth;
  const auto off = [&](std::size_t beam) {
    return std::max({0.0, beam_azimuth.least - azimuth[beam], azimuth[beam] - beam_azimuth.most});
  };
  double nearest = off(0);
  for (std::size_t b = 1; b < azimuth.size(); ++b) nearest = std::min(nearest, off(b));
  const Eigen::Index first = bin_of(view.range.least), count = bin_of(view.range.most) - first + 1;
  Grid<std::uint8_t> within =
      Grid<std::uint8_t>::Zero(static_cast<Eigen::Index>(azimuth.size()), static_cast<Eigen::Index>(ping.gate.bins()));
  for (std::size_t b = 0; b < azimuth.size(); ++b)
    if (off(b) <= nearest) within.row(static_cast<Eigen::Index>(b)).segment(first, count).setOnes();
  return within;
}

/// The box about all pixels that are not 0; empty if all are.
std::optional<PixelBox> box_of_marks(const Grid<std::uint8_t>& shown) {
  int left = static_cast<int>(shown.cols()), top = static_cast<int>(shown.rows()), right = -1, bottom = -1;
  for (int row = 0; row < shown.rows(); ++row)
    for (int column = 0; column < shown.cols(); ++column)
      if (shown(row, column)) {
        left = std::min(left, column), right = std::max(right, column);
        top = std::min(top, row), bottom = std::max(bottom, row);
      }
  if (right < 0) return std::nullopt;
  return PixelBox{left, top, right - left + 1, bottom - top + 1};
}

/// The pixels from the first to the last one, of `count`: two positions in pixels from the first one's side. None: beyond.
std::optional<std::pair<int, int>> pixels_between(double low, double high, Eigen::Index count) {
  const double most = static_cast<double>(count) - 1, first = std::floor(low), last = std::floor(high);
  if (!(last >= 0 && first <= most)) return std::nullopt;
  return std::pair(static_cast<int>(std::max(first, 0.0)), static_cast<int>(std::min(last, most)));
}

/// The box about the positions where a fan draws a part; empty beyond the picture, and for cubes without these positions.
std::optional<PixelBox> box_of_positions(const PartView& view, const FanRaster& fan) {
  const double m = fan.metres_per_pixel;
  const auto across = pixels_between(fan.head_column - view.port.most / m, fan.head_column - view.port.least / m,
                                     fan.beam.cols()),
             along = pixels_between(fan.head_row - view.ahead.most / m, fan.head_row - view.ahead.least / m,
                                    fan.beam.rows());
  if (!across || !along) return std::nullopt;
  return PixelBox{across->first, along->first, across->second - across->first + 1, along->second - along->first + 1};
}

ordered_json box_json(const std::optional<PixelBox>& box) {
  if (!box) return nullptr;
  return *box;
}

}  // namespace

ordered_json numbers_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

ordered_json pose_json(const Pose& pose) {
  ordered_json rows = ordered_json::array();
  for (const auto& row : pose.matrix().rowwise()) rows.push_back(std::vector<double>(row.begin(), row.end()));
  return rows;
}

std::optional<PixelBox> whole_box(const PartView& view, const PictureOf& picture) {
  if (!(view.visible_share >= 0)) return std::nullopt;
  if (picture.fan) return box_of_positions(view, *picture.fan);
  return box_of_marks(polar_picture(samples_within(view, picture.ping), picture.ping.fan));
}

std::map<std::uint16_t, std::size_t> parts_of_objects(const PixelLabels& labels, double least_share,
                                                      const Grid<std::uint16_t>& instance) {
  std::map<std::uint16_t, std::size_t> parts;
  if (labels.part.size() == 0) return parts;
  const Grid<std::uint16_t> part = part_image(labels, least_share);
  for (Eigen::Index i = 0; i < instance.size(); ++i)
    if (instance(i) != 0 && part(i) != PixelLabels::no_part && !labels.part_labels[part(i)].empty())
      parts.emplace(instance(i), part(i));
  return parts;
}

ordered_json part_objects_json(const PixelLabels& labels, const std::map<std::uint16_t, std::size_t>& parts,
                               const PictureOf& polar, const PictureOf& fan) {
  ordered_json objects = ordered_json::array();
  for (std::size_t p = 0; p < labels.views.size(); ++p) {
    const PartView& view = labels.views[p];
    if (labels.part_labels[p].empty()) continue;
    const auto object = std::find_if(parts.begin(), parts.end(), [p](const auto& entry) { return entry.second == p; });
    // A part that lies just beyond the fan may still have pixels: its numbers are null.
    if (!(view.visible_share >= 0) && object == parts.end()) continue;
    objects.push_back({{"part", labels.part_names[p]},
                       {"class", labels.part_labels[p]},
                       {"instance", object == parts.end() ? ordered_json() : ordered_json(object->first)},
                       {"world_from_part", pose_json(view.world_from_part)},
                       {"scale", view.scale},
                       {"size_m", numbers_json(view.size)},
                       {"visible_share", view.visible_share},
                       {"azimuth_rad", {view.azimuth.least, view.azimuth.most}},
                       {"range_m", {view.range.least, view.range.most}},
                       {"polar_bbox_whole", box_json(whole_box(view, polar))},
                       {"fan_bbox_whole", box_json(whole_box(view, fan))}});
  }
  return objects;
}

}  // namespace insonify::tool
