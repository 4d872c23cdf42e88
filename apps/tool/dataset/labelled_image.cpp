// SPDX-License-Identifier: BSD-3-Clause
#include "tool/dataset/labelled_image.hpp"

#include <utility>

#include "core/error.hpp"
#include "returns/fan_areas.hpp"
#include "tool/dataset/box_contrast.hpp"
#include "tool/dataset/label_pictures.hpp"
#include "tool/dataset/part_objects.hpp"

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

}  // namespace insonify::tool
