// SPDX-License-Identifier: BSD-3-Clause
#include "tool/dataset/labelled_image.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "returns/fan_areas.hpp"

namespace insonify::tool {
namespace {

/// The objects of a ping's samples: by the scene's own instances, else connected parts of a class. `stuff` has none.
Grid<std::uint16_t> objects_of(const ObjectKeys& keys, const Grid<std::uint8_t>& category, const ImageRules& rules) {
  const Grid<std::uint32_t> kind = category.unaryExpr(
      [&](std::uint8_t value) { return value != 0 && !rules.stuff.contains(value) ? std::uint32_t{value} : 0; });
  const Grid<std::uint32_t> objects = number_objects(kind, keys.id, keys.instances, rules.least_pixels);
  if (objects.size() > 0 && objects.maxCoeff() > 65535)
    fail(ErrorKind::content, "an image has an object with the number ", objects.maxCoeff(),
         ", above 65535: objects without an instance count from the largest instance, ", keys.instances.most,
         "; give smaller instances, or ask for larger objects with --least-pixels");
  return objects.cast<std::uint16_t>();
}

}  // namespace

LabelledSamples labelled_samples(const Ping& ping, Grid<float> level_db, const SceneInstances& instances,
                                 const std::vector<std::string>& classes, const ImageRules& rules) {
  LabelledSamples samples{std::move(level_db), {}, {}, {}};
  samples.category = classes_above(classes_of(ping.labels, rules.share, classes), samples.level_db, rules.min_level);
  const ObjectKeys keys = object_keys(ping.labels, instances, rules.share);
  samples.instance = objects_of(keys, samples.category, rules);
  samples.objects = {parts_of_objects(ping.labels, rules.share, samples.instance), keys.instances.most};
  for (const Annotation& a :
       annotations_of({polar_picture(samples.category, ping.fan), polar_picture(samples.instance, ping.fan)}))
    samples.objects.classes[a.instance] = a.category;
  return samples;
}

LabelledImage polar_image(const LabelledSamples& samples, const BeamFan& fan) {
  return {polar_picture(samples.level_db, fan),
          {polar_picture(samples.category, fan), polar_picture(samples.instance, fan)}};
}

LabelledImage fan_image(const LabelledSamples& samples, const Ping& ping, const FanRaster& raster,
                        const ImageRules& rules) {
  FanPixels seen = pixels_above(
      fan_pixels({samples.level_db, samples.category, samples.instance}, ping.fan, ping.gate, raster), rules.min_level);
  return {std::move(seen.level_db), {std::move(seen.category), std::move(seen.instance)}};
}

std::optional<double> contrast_db(const Grid<float>& level_db, const Grid<std::uint16_t>& instance,
                                  const Annotation& object, const FanRaster* fan) {
  constexpr int least_ring = 2;  // pixels
  const int across = std::max(least_ring, object.width), along = std::max(least_ring, object.height);
  const Eigen::Index top = std::max(0, object.top - along), left = std::max(0, object.left - across);
  const Eigen::Index bottom = std::min<Eigen::Index>(level_db.rows(), object.top + object.height + along);
  const Eigen::Index right = std::min<Eigen::Index>(level_db.cols(), object.left + object.width + across);
  double own = 0, ring = 0;
  std::size_t own_pixels = 0, ring_pixels = 0;
  for (Eigen::Index row = top; row < bottom; ++row)
    for (Eigen::Index column = left; column < right; ++column) {
      const std::uint16_t number = instance(row, column);
      const double intensity = std::pow(10, static_cast<double>(level_db(row, column)) / 10);
      if (number == object.instance)
        own += intensity, ++own_pixels;
      else if (number == 0 && (!fan || fan->beam(row, column) >= 0))
        ring += intensity, ++ring_pixels;
    }
  if (own_pixels == 0 || ring_pixels == 0 || !(ring > 0)) return {};
  return 10 * std::log10(own / static_cast<double>(own_pixels) * static_cast<double>(ring_pixels) / ring);  // (E169)
}

FanPixels pixels_above(FanPixels pixels, std::optional<double> min_level) {
  pixels.category = classes_above(pixels.category, pixels.level_db, min_level);
  pixels.instance = (pixels.category == 0).select(std::uint16_t{0}, pixels.instance);
  return pixels;
}

}  // namespace insonify::tool
