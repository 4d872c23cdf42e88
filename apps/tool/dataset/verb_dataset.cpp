// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/message.hpp"
#include "files/peak_memory.hpp"
#include "run/parse_values.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/compare/compared_files.hpp"
#include "tool/dataset/dataset.hpp"
#include "tool/dataset/labelled_image.hpp"
#include "tool/dataset/level_counts.hpp"

namespace insonify::tool {
namespace {

void add_options(OptionList list, DatasetOptions& o) {
  list.add("RUN", &o.runs,
           "runs, surveys or cubes made with --keep labels (missions: keep = [\"labels\"] under [ping])",
           {.required = true});
  list.add("-o,--output", &o.output, "folder that is made", {.required = true});
  list.add(
      "--window", &o.window,
      "MIN:MAX [dB] of black and white in all images; default: 60 dB that end where one sample in 1000 of all images "
      "is brighter");
  list.add("--tvg", &o.tvg, "[dB per decade of range] time-varied gain, to which absorption is added");
  list.add("--raw", &o.raw, "take levels as received, without time-varied gain",
           {.excludes = "--tvg", .shown_as = " "});
  list.add("--share", &o.share,
           "least share of a pixel's energy from one material within the pixel's own cell; that material is then the "
           "class of the pixel");
  list.add("--min-level", &o.min_level, min_level_help);
  list.add("--least-pixels", &o.least_pixels, "least number of pixels of an object in the polar image",
           {.within = std::pair(1, 1 << 30), .shown_as = "INT"});
  list.add("--min-contrast", &o.min_contrast,
           "[dB] least level of an object over that of the ring around it, for a box; masks keep all; below 0: darker "
           "objects have boxes, too");
  list.add("--columns", &o.columns, "[pixels] width of fan images", {.within = std::pair(16, 8192), .shown_as = "INT"});
  list.add("--stuff", &o.stuff, "classes without boxes, separated by commas, e.g. sand; shadow has none at all",
           {.comma_separated = true});
  list.add("--things", &o.things, "shadow: draw boxes round shadows, too",
           {.words = {"shadow"}, .comma_separated = true});
  list.add("--polygons", &o.polygons, "write COCO with outlines too, holes filled: annotations/polygons_SPLIT.json");
  list.add("--row", &o.row,
           "row of beams of a head with several rows: its number from 0 at the bottom, or all for an image of each; "
           "default: the middle row");
  list.add("--split", &o.split, "TRAIN:VAL:TEST, shares of the units of --split-by");
  std::vector<std::string> units;
  std::string means = "unit that stays together in train, val or test";
  for (const SplitUnit& unit : split_units())
    units.push_back(unit.name), means += std::string("; ") + unit.name + ": " + unit.means;
  list.add("--split-by", &o.split_by, means, {.words = units});
  list.add("--force", &o.force, "replace an existing data set");
  add_common(list, o.common);
}

std::vector<double> parse_split(const std::string& text) {
  std::string commas = text;
  std::replace(commas.begin(), commas.end(), ':', ',');
  const std::vector<double> shares = parse_numbers("--split", commas, 3, "TRAIN:VAL:TEST");
  if (!(shares[0] > 0 && shares[1] >= 0 && shares[2] >= 0))
    fail(ErrorKind::argument, "--split = ", text, ", must be three shares, the first > 0, e.g. 80:10:10");
  return shares;
}

/// The rows of beams of a ping that become images.
std::vector<std::size_t> chosen_rows(const Ping& ping, const DatasetOptions& o) {
  const std::size_t rows = rows_of(ping);
  std::vector<std::size_t> chosen;
  if (o.row == "all") {
    for (std::size_t r = 0; r < rows; ++r) chosen.push_back(r);
  } else if (o.row.empty()) {
    chosen.push_back(rows / 2);
  } else {
    const double row = parse_number("--row", o.row);
    if (!(row >= 0 && row < static_cast<double>(rows) && row == std::floor(row)))
      fail(ErrorKind::argument, "--row = ", o.row, ", must be all or from 0 and below ", rows,
           ", the number of rows of beams");
    chosen.push_back(static_cast<std::size_t>(row));
  }
  return chosen;
}

/// Classes that a ping may have boxes of: those of as many pixels as an object must have.
std::set<std::string> shown_classes(const Ping& ping, const DatasetOptions& o) {
  std::vector<int> pixels(ping.labels.names.size());
  const Grid<std::uint16_t> image = material_image(ping.labels, o.share);
  for (const std::uint16_t material : image.reshaped())
    if (material < PixelLabels::shadow) ++pixels.at(material);
  std::set<std::string> shown;
  for (std::size_t k = 0; k < pixels.size(); ++k)
    if (pixels[k] >= o.least_pixels && std::ranges::find(o.stuff, ping.labels.names[k]) == o.stuff.end())
      shown.insert(ping.labels.names[k]);
  return shown;
}

/// Settings that all images of a data set share.
struct CommonOfImages {
  std::vector<std::string> classes{"nothing", "shadow"};  ///< then those of the sources, in their order
  GreyWindow window;
};

/// The window of 60 dB whose top, a multiple of 5 dB, one sample in 1000 of all images exceeds.
GreyWindow window_of(const LevelCounts& levels) {
  const double max_db = 5 * std::ceil(levels.exceeded_by(0.001) / 5);
  return {max_db - 60, max_db};
}

/// Reads all pings once: lists the classes that each shows, and returns the classes of all with the window.
CommonOfImages survey_images(std::vector<DatasetSource>& sources, const DatasetOptions& o) {
  CommonOfImages common;
  std::vector<std::string>& classes = common.classes;
  LevelCounts levels;
  for (DatasetSource& source : sources)
    for_each_labelled_ping(source, [&](const Cube&, const Ping& ping, std::size_t index) {
      for (const std::string& name : ping.labels.names)
        if (index == 0 && std::ranges::find(classes, name) == classes.end()) classes.push_back(name);
      std::set<std::string>& shown = source.shows.emplace_back();
      for (const std::size_t row : chosen_rows(ping, o)) {
        const bool whole = rows_of(ping) == 1;
        const Ping part = whole ? Ping{} : row_of(ping, row);
        const Ping& image = whole ? ping : part;
        shown.merge(shown_classes(image, o));
        if (o.window.empty()) levels.add(dataset_levels(image, o));
      }
    });
  for (const std::string& name : o.stuff)
    if (std::find(classes.begin() + 1, classes.end(), name) == classes.end())
      fail(ErrorKind::argument, "--stuff = ", name, " is no class of the runs; they have ",
           shortened_list(std::span(classes).subspan(1)));
  common.window = o.window.empty() ? window_of(levels) : parse_window("--window", o.window);
  return common;
}

/// A line for each class: its boxes in the fan images of each part.
std::string class_counts(const nlohmann::ordered_json& boxes) {
  std::string lines;
  for (const auto& [name, parts] : boxes.items()) {
    std::string counts;
    for (const auto& [split, forms] : parts.items())
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", forms["fan"].get<std::size_t>(), split);
    lines += fmt::format("\n  boxes of {}: {}", name, counts);
  }
  return lines;
}

void dataset(const DatasetOptions& o) {
  if (!(o.share > 0 && o.share <= 1)) fail(ErrorKind::argument, "--share = ", o.share, ", must be > 0 and at most 1");
  const std::vector<double> shares = parse_split(o.split);
  if (!std::isfinite(o.min_contrast)) fail(ErrorKind::argument, "--min-contrast must be a finite number [dB]");
  (void)parse_min_level(o.min_level, 0);  // before any work
  if (!o.window.empty()) (void)parse_window("--window", o.window);
  std::vector<DatasetSource> sources = dataset_sources(o.runs);
  Progress progress(o.common, static_cast<int>(sources.size()) + 2);
  progress.step("reading");
  const auto [classes, window] = survey_images(sources, o);
  split_pings(sources, o.split_by, shares);
  RunDirectory directory(o.output, o.force, o.runs);
  DatasetWriter writer(directory, o, classes, window);
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const DatasetSource& source = sources[s];
    progress.step("writing images of " + source.run + (source.head.empty() ? "" : ", head " + source.head));
    for_each_labelled_ping(source, [&](const Cube& cube, const Ping& ping, std::size_t index) {
      const std::string name = fmt::format("{:03}_{:06}", s, ping.number);
      const std::string& split = source.split.at(index);
      if (rows_of(ping) == 1 && o.row.empty()) return writer.add(source, cube, ping, {name, split});
      for (const std::size_t row : chosen_rows(ping, o))
        writer.add(source, cube, row_of(ping, row), {name + fmt::format("_row{:02}", row), split, row});
    });
  }
  progress.step("listing");
  writer.finish();
  directory.commit();
  std::vector<std::string> notes = writer.tally().notes(o.split_by, o.split, shares);
  for (const DatasetSource& source : sources)
    if (!source.note.empty() && std::ranges::find(notes, source.note) == notes.end()) notes.push_back(source.note);
  for (const std::string& note : notes) progress.note(note);
  nlohmann::ordered_json splits;
  std::string counts;
  for (const std::string& split : split_names) {
    const auto images = writer.tally().images();
    const std::size_t count = images.contains(split) ? images.at(split) : 0;
    splits[split] = {{"images", count}, {"near_train", split == "train" ? count : writer.tally().near_train(split)}};
    counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, split);
  }
  const nlohmann::ordered_json result = {
      {"folder", o.output},
      {"images", writer.images()},
      {"splits", splits},
      {"notes", notes},
      {"boxes", {{"polar", writer.polar().boxes}, {"fan", writer.fan().boxes}}},
      {"boxes_by_class", writer.boxes_by_class()},
      {"unboxed", {{"polar", writer.polar().unboxed}, {"fan", writer.fan().unboxed}}},
      {"classes", classes},
      {"window_db", {window.min_db, window.max_db}},
      {"peak_memory_mib", peak_memory_mib()}};
  print_summary(o.common, result,
                fmt::format("{}: {} images ({}) with {} polar and {} fan boxes; classes {}{}", o.output,
                            writer.images(), counts, writer.polar().boxes, writer.fan().boxes, shortened_list(classes),
                            class_counts(writer.boxes_by_class())));
}

}  // namespace

Verb dataset_verb() {
  return make_verb<DatasetOptions>("dataset", "images with labels to learn from: COCO, YOLO, masks",
                                   {"insonify dataset survey -o dataset --stuff sand",
                                    "insonify dataset reef wreck harbour -o dataset --split 70:15:15",
                                    "insonify dataset survey -o dataset --split-by leg"},
                                   add_options, dataset);
}

}  // namespace insonify::tool
