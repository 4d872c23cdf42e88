#include "returns/label_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace insonify {
namespace {

// Places of surfels as a head sees them.
struct SurfelPlaces {
  std::vector<float> range, u, elevation, radius;
};

SurfelPlaces places_of(const SceneCloud& scene, const Pose& world_from_head) {
  const Pose head_from_world = world_from_head.inverse();
  SurfelPlaces at;
  for (auto* column : {&at.range, &at.u, &at.elevation, &at.radius}) column->resize(scene.size());
  parallel_blocks(scene.size(), 4096, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d p = head_from_world * (scene.origin + scene.point[i].cast<double>());
      const double range = std::max(p.norm(), 1e-9);
      at.range[i] = static_cast<float>(range);
      // Behind the array no beam ahead looks: beyond any direction cosine.
      at.u[i] = static_cast<float>(p.x() >= 0 ? p.y() / range : 2 + std::abs(p.y() / range));
      at.elevation[i] = static_cast<float>(std::asin(p.z() / range));
      at.radius[i] = static_cast<float>(std::sqrt(static_cast<double>(scene.area[i]) / std::numbers::pi));
    }
  });
  return at;
}

double direction_cosine(const BeamFan& fan, std::size_t beam) {
  return std::cos(fan.elevation[beam]) * std::sin(fan.azimuth[beam]);
}

// Whether a contributor lies in the cell of a pixel.
bool in_cell(const PixelCells& cells, const SurfelPlaces& at, std::uint32_t surfel, std::size_t beam, double u,
             double range) {
  const BeamFan& fan = cells.fan;
  const double radius = static_cast<double>(at.radius[surfel]), far = static_cast<double>(at.range[surfel]);
  if (std::abs(far - range) > cells.range_resolution + radius) return false;
  if (std::abs(static_cast<double>(at.u[surfel]) - u) > fan.beam_width + radius / far) return false;
  return fan.row_width == 0 ||
         std::abs(static_cast<double>(at.elevation[surfel]) - fan.elevation[beam]) <= fan.row_width + radius / far;
}

// The material with most energy in the cell of a pixel.
void label_pixel(const Contributors& c, const PixelCells& cells, const SurfelPlaces& at, std::size_t beam,
                 std::size_t bin, PixelLabels& labels) {
  const double u = direction_cosine(cells.fan, beam), range = cells.gate.centre(bin);
  std::map<std::uint16_t, double> own;
  double listed = 0;
  for (std::size_t k = 0; k < c.per_pixel; ++k) {
    const std::size_t i = c.at(beam, bin, k);
    if (c.surfel[i] == Contributors::none) break;
    const double share = static_cast<double>(c.share[i]);
    listed += share;
    if (c.path[i] == PathKind::direct && in_cell(cells, at, c.surfel[i], beam, u, range)) own[c.material[i]] += share;
  }
  if (own.empty() || !(listed > 0)) return;
  const auto most =
      std::max_element(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const auto row = static_cast<Eigen::Index>(beam), column = static_cast<Eigen::Index>(bin);
  labels.material(row, column) = most->first;
  labels.share(row, column) = static_cast<float>(most->second / listed);  // (E125)
  for (std::size_t k = 0; k < c.per_pixel; ++k)
    if (const std::size_t i = c.at(beam, bin, k); c.material[i] == most->first && c.path[i] == PathKind::direct &&
                                                  in_cell(cells, at, c.surfel[i], beam, u, range)) {
      labels.id(row, column) = c.id[i];
      return;
    }
}

// The beams of a row by ascending direction cosine, with half the way to their neighbours.
struct BeamRow {
  double elevation = 0, reach = 0, half_step = 0;
  std::vector<std::pair<double, std::size_t>> beams;
};

std::vector<BeamRow> beam_rows(const BeamFan& fan) {
  const bool planar = fan.row_width > 0;
  std::vector<BeamRow> rows;
  for (const FanRow& fan_row : fan_rows(fan)) {
    BeamRow row{fan_row.elevation, planar ? 0.5 * fan.row_width : 0.5 * fan.elevation_width, 0, {}};
    for (const std::size_t beam : fan_row.beams) row.beams.emplace_back(direction_cosine(fan, beam), beam);
    std::sort(row.beams.begin(), row.beams.end());
    row.half_step = 0.5 * fan.beam_width;
    for (std::size_t b = 1; b < row.beams.size(); ++b)
      row.half_step = std::max(row.half_step, 0.5 * (row.beams[b].first - row.beams[b - 1].first));
    rows.push_back(std::move(row));
  }
  return rows;
}

// Marks as shadow the unlabelled pixels that hold surface.
void mark_shadows(const SurfelPlaces& at, const PixelCells& cells, PixelLabels& labels) {
  const RangeGate& gate = cells.gate;
  const auto bins = static_cast<double>(labels.material.cols());
  const std::vector<BeamRow> rows = beam_rows(cells.fan);
  for (std::size_t i = 0; i < at.range.size(); ++i) {
    const double range = static_cast<double>(at.range[i]), radius = static_cast<double>(at.radius[i]);
    const double first = std::max(0.0, std::floor((range - radius - gate.min_range) / gate.bin_size));
    const double last = std::min(bins - 1, std::floor((range + radius - gate.min_range) / gate.bin_size));
    if (first > last) continue;
    const double u = static_cast<double>(at.u[i]), turn = radius / range;
    for (const BeamRow& row : rows) {
      if (std::abs(static_cast<double>(at.elevation[i]) - row.elevation) > row.reach + turn) continue;
      const double reach = std::max(row.half_step, turn);
      auto beam = std::lower_bound(row.beams.begin(), row.beams.end(), std::pair(u - reach, std::size_t{0}));
      for (; beam != row.beams.end() && beam->first <= u + reach; ++beam)
        for (double n = first; n <= last; ++n) {
          auto& material = labels.material(static_cast<Eigen::Index>(beam->second), static_cast<Eigen::Index>(n));
          if (material == PixelLabels::nothing) material = PixelLabels::shadow;
        }
    }
  }
}

}  // namespace

Grid<std::uint16_t> material_image(const PixelLabels& labels, double least_share) {
  Grid<std::uint16_t> image = labels.material;
  for (Eigen::Index i = 0; i < image.size(); ++i)
    if (image(i) != PixelLabels::shadow && static_cast<double>(labels.share(i)) < least_share)
      image(i) = PixelLabels::nothing;
  return image;
}

Grid<std::uint32_t> instance_image(const PixelLabels& labels, double least_share) {
  Grid<std::uint32_t> image = labels.id;
  for (Eigen::Index i = 0; i < image.size(); ++i)
    if (static_cast<double>(labels.share(i)) < least_share) image(i) = PixelLabels::no_id;
  return image;
}

PixelLabels label_pixels(const SceneCloud& scene, const Contributors& contributors, const PixelCells& cells) {
  require_valid(contributors, "label_pixels");
  if (contributors.beams != cells.fan.beams() || contributors.bins != cells.gate.bins())
    fail(ErrorKind::argument, "label_pixels: contributors of ", contributors.beams, " beams x ", contributors.bins,
         " bins, must be of ", cells.fan.beams(), " x ", cells.gate.bins());
  for (const std::uint32_t surfel : contributors.surfel)
    if (surfel != Contributors::none && surfel >= scene.size())
      fail(ErrorKind::argument, "label_pixels: surfel ", surfel, " is not in the scene of ", scene.size());
  const auto beams = static_cast<Eigen::Index>(contributors.beams), bins = static_cast<Eigen::Index>(contributors.bins);
  PixelLabels labels{Grid<std::uint16_t>::Constant(beams, bins, PixelLabels::nothing),
                     Grid<std::uint32_t>::Constant(beams, bins, PixelLabels::no_id),
                     Grid<float>::Zero(beams, bins),
                     {}};
  for (const Material& material : scene.materials) labels.names.push_back(material.name);
  const SurfelPlaces at = places_of(scene, cells.world_from_head);
  for (std::size_t beam = 0; beam < contributors.beams; ++beam)
    for (std::size_t bin = 0; bin < contributors.bins; ++bin) label_pixel(contributors, cells, at, beam, bin, labels);
  mark_shadows(at, cells, labels);
  return labels;
}

}  // namespace insonify
