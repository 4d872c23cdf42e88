// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <fmt/format.h>

#include "core/text.hpp"
#include "tool/dataset/dataset.hpp"
#include "tool/dataset/labelled_image.hpp"

namespace insonify::tool {

bool is_thing(const DatasetOptions& options, const std::vector<std::string>& classes, std::size_t category) {
  const auto names = [&](const std::vector<std::string>& list) {
    return std::find(list.begin(), list.end(), classes[category]) != list.end();
  };
  return category == shadow_class ? names(options.things) : !names(options.stuff);
}

std::string dataset_card(const DatasetCard& of) {
  std::string text = fmt::format(
      "# Simulated sonar images\n\n{} images in two forms, with {} boxes in the polar and {} in the fan ones, made by "
      "insonify {}.\n\nSonars:\n{}\n## Images\n\n`polar/images`: 16 bits, a column for each beam from port to "
      "starboard, the first row is the farthest bin. `fan/images`: 8 bits, true geometry, forward up, starboard right; "
      "`fan_mapping.json` says where. Grey is linear in dB: black {:g} dB or below, white {:g} dB or above, {}. All "
      "images have this one mapping{}.\n\n",
      of.images, of.polar.boxes, of.fan.boxes, INSONIFY_VERSION, of.sonars, of.window.min_db, of.window.max_db,
      of.options.raw ? "levels as received (re 1 uPa)"
                     : fmt::format("levels with a time-varied gain of {:g} log r + 2 a r", of.options.tvg),
      of.options.window.empty() ? ": 60 dB below a multiple of 5 dB that one sample in 1000 of all images exceeds"
                                : "");
  const std::optional<double> least = parse_min_level(of.options.min_level, of.window.min_db);
  text += fmt::format(
      "## Labels\n\nA pixel has the class of a material if visible surface of it lies in the pixel's own cell "
      "(half-power widths of beam and pulse) and at least {:g} of the energy heard there is of it, within the main "
      "lobe; it is shadow if surface of the scene lies there but none is visible from the head; else nothing (water, "
      "or side lobes and multipath stronger than what is there). A pixel of a fan image covers several samples: its "
      "level is that of their mean intensity by area, its class the one that most of the energy comes from. Objects "
      "are the labelled parts of the scene or its field `instance`, with the same number in all images of a scene; the "
      "rest are connected parts of a class, with larger numbers (`found_by`). They have {} pixels of the polar image "
      "at least, and a box if they are {:g} dB above what is around them (`--min-contrast`): `unboxed` in `meta.jsonl` "
      "lists the others, which stay in the masks. Holes of a scan count as nothing{}.\n\n| value | class | polar "
      "pixels | fan pixels |\n|---|---|---|---|\n",
      of.options.share, of.options.least_pixels, of.options.min_contrast,
      least ? fmt::format(", and so do surfaces in pixels below {:g} dB", *least) : "");
  std::vector<std::string> in_masks_alone;
  for (std::size_t k = 0; k < of.classes.size(); ++k) {
    text += fmt::format("| {} | {} | {} | {} |\n", k, of.classes[k], of.polar.pixels[k], of.fan.pixels[k]);
    if (k > 0 && !is_thing(of.options, of.classes, k)) in_masks_alone.push_back(of.classes[k]);
  }
  text += fmt::format(
      "\n`masks`: class; `colours`: the same in the colours of `palette.json`; `instances`: number of the object, 16 "
      "bits; `annotations`: COCO with run lengths; `labels`: YOLO, the classes that have boxes counted from 0 "
      "(`data.yaml`). In masks alone: {}.\n\n",
      in_masks_alone.empty() ? "none" : joined(in_masks_alone));
  const SplitUnit& by = *std::find_if(split_units().begin(), split_units().end(),
                                      [&](const SplitUnit& each) { return of.options.split_by == each.name; });
  text += fmt::format(
      "## Split\n\nBy {}: {}.\n\n| split | images | taken within range of an image of train |\n|---|---|---|\n",
      by.name, by.means);
  for (const auto& [split, images] : of.tally.images())
    text += fmt::format("| {} | {} | {} |\n", split, images,
                        split == "train" ? "" : std::to_string(of.tally.near_train(split)));
  return text +
         "\n`meta.jsonl` has pose, sonar, water, seed and mapping of every image, and by how much it was randomised. "
         "`SHA256SUMS` checks the files: `sha256sum -c SHA256SUMS`.\n\nLevels are those of the simulation; scenes and "
         "their licences are the user's.\n";
}

}  // namespace insonify::tool
