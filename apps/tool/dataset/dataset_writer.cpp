// SPDX-License-Identifier: BSD-3-Clause
#include "tool/dataset/dataset_writer.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "files/pending_file.hpp"
#include "files/sha256.hpp"
#include "returns/fan_areas.hpp"
#include "returns/looks.hpp"
#include "store/run_manifest.hpp"
#include "tool/dataset/box_contrast.hpp"
#include "tool/dataset/label_pictures.hpp"
#include "tool/run/run_checks.hpp"
#include "view/grey_file.hpp"
#include "view/label_colours.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// The objects of a ping's samples: by the scene's own instances, else connected parts of a class. `stuff` has none.
Grid<std::uint16_t> objects_of(const ObjectKeys& keys, const Grid<std::uint8_t>& category,
                               const std::set<std::uint8_t>& stuff, std::size_t least_pixels) {
  const Grid<std::uint32_t> kind = category.unaryExpr(
      [&](std::uint8_t value) { return value != 0 && !stuff.contains(value) ? std::uint32_t{value} : 0; });
  const Grid<std::uint32_t> objects = number_objects(kind, keys.id, keys.instances, least_pixels);
  if (objects.size() > 0 && objects.maxCoeff() > 65535)
    fail(ErrorKind::content, "an image has an object with the number ", objects.maxCoeff(),
         ", above 65535: objects without an instance count from the largest instance, ", keys.instances.most,
         "; give smaller instances, or ask for larger objects with --least-pixels");
  return objects.cast<std::uint16_t>();
}

ordered_json pose_json(const Pose& pose) {
  ordered_json rows = ordered_json::array();
  for (int r = 0; r < 4; ++r) {
    ordered_json row = ordered_json::array();
    for (int c = 0; c < 4; ++c) row.push_back(pose.matrix()(r, c));
    rows.push_back(row);
  }
  return rows;
}

std::vector<double> degrees_of(const std::vector<double>& angles) {
  std::vector<double> all;
  for (const double angle : angles) all.push_back(degrees(angle));
  return all;
}

/// Between the outermost sides of the beams.
double field_of_view_deg(const BeamFan& fan) {
  const auto [least, most] = std::ranges::minmax(fan.azimuth);
  return degrees(most - least + fan.beam_width);
}

ordered_json randomised_json(const RandomisedPing& by) {
  return {{"source_level_db", by.source_level_db},
          {"noise_db", by.noise_db},
          {"temperature_c", by.temperature_c},
          {"salinity_psu", by.salinity_psu},
          {"position_m", {by.position.x(), by.position.y(), by.position.z()}},
          {"yaw_pitch_roll_deg", {degrees(by.angles[0]), degrees(by.angles[1]), degrees(by.angles[2])}}};
}

/// Adds the contrasts in both forms to objects of parts, where they have pixels.
ordered_json with_contrasts(ordered_json objects, const std::map<std::uint16_t, std::optional<double>>& polar,
                            const std::map<std::uint16_t, std::optional<double>>& fan) {
  const auto of = [](const ordered_json& object, const auto& contrasts) -> ordered_json {
    if (object["instance"].is_null()) return nullptr;
    const auto found = contrasts.find(object["instance"].template get<std::uint16_t>());
    return found == contrasts.end() || !found->second ? ordered_json() : ordered_json(*found->second);
  };
  for (ordered_json& object : objects)
    object["polar_contrast_db"] = of(object, polar), object["fan_contrast_db"] = of(object, fan);
  return objects;
}

}  // namespace

Grid<float> dataset_levels(const Ping& ping, const DatasetOptions& o) {
  Grid<float> level = shown_level_db(ping);
  return o.raw ? level : apply_tvg(std::move(level), ping.gate, Tvg{o.tvg, ping.absorption_db_per_m});
}

DatasetWriter::DatasetWriter(const RunDirectory& directory, const DatasetOptions& options,
                             std::vector<std::string> classes, GreyWindow window)
    : directory_(directory), options_(options), classes_(std::move(classes)), window_(window) {
  for (Form* form : {&polar_, &fan_}) {
    form->pixels.resize(classes_.size());
    for (const char* folder : {"images", "masks", "colours", "instances", "labels", "annotations"})
      fs::create_directories(directory_.file(form->name + "/" + folder));
  }
}

const FanRaster& DatasetWriter::raster_of(const Ping& ping) {
  const auto bits = [](double value) { return fmt::format("{:a} ", value); };
  std::string key = bits(ping.gate.min_range) + bits(ping.gate.max_range) + bits(ping.gate.bin_size);
  for (const double azimuth : ping.fan.azimuth) key += bits(azimuth);
  const auto [at, is_new] = rasters_.try_emplace(sha256_of(key));
  if (is_new) at->second = fan_raster(ping.fan, ping.gate, options_.columns);
  return at->second;
}

bool DatasetWriter::is_thing(std::size_t category) const {
  const auto names = [&](const std::vector<std::string>& list) {
    return std::find(list.begin(), list.end(), classes_[category]) != list.end();
  };
  return category == shadow_class ? names(options_.things) : !names(options_.stuff);
}

void DatasetWriter::add(const DatasetSource& source, const Cube& cube, const Ping& ping, const DatasetImage& image) {
  const Grid<float> level = dataset_levels(ping, options_);
  std::set<std::uint8_t> stuff;
  for (std::size_t k = 1; k < classes_.size(); ++k)
    if (!is_thing(k)) stuff.insert(static_cast<std::uint8_t>(k));
  const std::optional<double> least = parse_min_level(options_.min_level, window_.min_db);
  const Grid<std::uint8_t> category = classes_above(classes_of(ping.labels, options_.share, classes_), level, least);
  const ObjectKeys keys = object_keys(ping.labels, source.instances, options_.share);
  const Grid<std::uint16_t> object = objects_of(keys, category, stuff, static_cast<std::size_t>(options_.least_pixels));
  ObjectsOf objects{parts_of_objects(ping.labels, options_.share, object), keys.instances.most};

  // The same samples in both forms: each in one pixel, or all that a pixel covers.
  const FanRaster& raster = raster_of(ping);
  const FormOf polar{{ping},
                     {polar_picture(category, ping.fan), polar_picture(object, ping.fan)},
                     polar_picture(level, ping.fan),
                     objects};
  for (const Annotation& a : annotations_of(polar.map)) objects.classes[a.instance] = a.category;
  const FanPixels seen = pixels_above(fan_pixels({level, category, object}, ping.fan, ping.gate, raster), least);
  const FormOf fan{{ping, &raster}, {seen.category, seen.instance}, seen.level_db, objects};
  const Grid<std::uint8_t> shown = quantise_8(fan.level_db, window_);
  save_grey_png(directory_.file("polar/images/" + image.name + ".png"), quantise_16(polar.level_db, window_));
  save_grey_png(directory_.file("fan/images/" + image.name + ".png"), shown);
  ++images_;
  ordered_json meta = meta_of(source, cube, ping, image, polar.map);
  const Contrasts of_polar = add_form(polar_, image, polar), of_fan = add_form(fan_, image, fan);
  sheet_.add(shown, boxed_of_sheet_);
  if (!ping.labels.views.empty())
    meta["objects"] = with_contrasts(part_objects_json(ping.labels, objects.parts, polar.picture, fan.picture),
                                     of_polar.of, of_fan.of);
  meta["unboxed"] = {{"polar", of_polar.unboxed}, {"fan", of_fan.unboxed}};
  meta_ += meta.dump() + "\n";
  tally_.add(image.split, source.scene_digest, ping.world_from_head.translation(), ping.gate.max_range);
}

ordered_json DatasetWriter::annotation_of(const Annotation& a, const FormOf& of, std::optional<double> contrast) {
  const bool connected = a.instance > of.objects.most_given;
  ordered_json annotation = {
      {"id", annotations_},
      {"image_id", images_},
      {"category_id", a.category},
      {"instance", a.instance},
      {"bbox", {a.left, a.top, a.width, a.height}},
      {"area", a.area},
      {"iscrowd", 0},
      {"segmentation", {{"size", {of.map.category.rows(), of.map.category.cols()}}, {"counts", a.counts}}},
      {"found_by", connected                                   ? "connection"
                   : of.picture.ping.labels.part_names.empty() ? "instance"
                                                               : "part"},
      {"contrast_db", contrast ? ordered_json(*contrast) : ordered_json()}};
  if (const auto part = of.objects.parts.find(a.instance); part != of.objects.parts.end()) {
    const PartView& view = of.picture.ping.labels.views.at(part->second);
    annotation["part"] = of.picture.ping.labels.part_names[part->second];
    annotation["visible_share"] = view.visible_share;
    if (const auto box = whole_box(view, of.picture)) annotation["bbox_whole"] = *box;
  }
  return annotation;
}

DatasetWriter::Contrasts DatasetWriter::add_form(Form& form, const DatasetImage& image, const FormOf& of) {
  const LabelMap& map = of.map;
  const auto path = [&](const char* folder, const char* ending) {
    return directory_.file(form.name + "/" + folder + "/" + image.name + ending);
  };
  save_grey_png(path("masks", ".png"), map.category);
  save_label_png(path("colours", ".png"), map.category);
  save_grey_png(path("instances", ".png"), map.instance);
  for (const std::uint8_t category : map.category.reshaped()) ++form.pixels[category];

  ordered_json& coco = form.coco.try_emplace(image.split, empty_coco()).first->second;
  coco["images"].push_back({{"id", images_},
                            {"file_name", image.name + ".png"},
                            {"width", map.category.cols()},
                            {"height", map.category.rows()}});
  Contrasts contrasts;
  boxed_of_sheet_.clear();
  for (Annotation a : annotations_of(map)) {
    if (const auto known = of.objects.classes.find(a.instance); known != of.objects.classes.end())
      a.category = known->second;
    const std::optional<double> contrast = contrast_db(of.level_db, map.instance, a, of.picture.fan);
    contrasts.of[a.instance] = contrast;
    if (contrast && a.category != shadow_class && *contrast < options_.min_contrast) {
      ++form.unboxed;
      contrasts.unboxed.push_back(
          {{"instance", a.instance}, {"class", classes_[a.category]}, {"contrast_db", *contrast}});
      continue;
    }
    ++annotations_, ++form.boxes;
    coco["annotations"].push_back(annotation_of(a, of, contrast));
    if (options_.polygons) form.outlines[image.split].push_back(outlines_of(map.instance, a.instance));
    boxed_of_sheet_.push_back(std::move(a));
  }
  form.lists[image.split] += "./images/" + image.name + ".png\n";
  return contrasts;
}

ordered_json DatasetWriter::meta_of(const DatasetSource& source, const Cube& cube, const Ping& ping,
                                    const DatasetImage& image, const LabelMap& map) {
  std::vector<std::size_t> pixels(classes_.size());
  for (const std::uint8_t category : map.category.reshaped()) ++pixels[category];
  if (!source.instances.renumbered.empty())
    for (const auto& [number, given] : source.instances.renumbered)
      renumbered_[source.scene_digest][std::to_string(number)] = given;
  ordered_json meta = {{"name", image.name},
                       {"split", image.split},
                       {"run", fs::path(source.run).filename().string()},
                       {"head", source.head},
                       {"scene", fs::path(source.scene).filename().string()},
                       {"scene_sha256", source.scene_digest},
                       {"ping", ping.number},
                       {"time", ping.time},
                       {"world_from_head", pose_json(ping.world_from_head)},
                       {"sonar", cube.sonar},
                       {"centre_frequency_hz", cube.centre_frequency},
                       {"bandwidth_hz", cube.bandwidth},
                       {"source_level_db", cube.source_level_db},
                       {"sound_speed", ping.sound_speed},
                       {"absorption_db_per_m", ping.absorption_db_per_m},
                       {"seed", cube.seed},
                       {"azimuths_deg", degrees_of(ping.fan.azimuth)},
                       {"elevations_deg", degrees_of(ping.fan.elevation)},
                       {"field_of_view_deg", field_of_view_deg(ping.fan)},
                       {"beam_width_deg", degrees(ping.fan.beam_width)},
                       {"elevation_width_deg", degrees(ping.fan.elevation_width)},
                       {"min_range_m", ping.gate.min_range},
                       {"max_range_m", ping.gate.max_range},
                       {"bin_size_m", ping.gate.bin_size},
                       {"mapping",
                        {{"min_db", window_.min_db},
                         {"max_db", window_.max_db},
                         {"tvg_db_per_decade", options_.raw ? ordered_json() : ordered_json(options_.tvg)}}},
                       {"polar_pixels", pixels}};
  if (image.row) meta["row"] = *image.row, meta["row_elevation_deg"] = degrees(ping.fan.elevation.front());
  for (std::size_t p = 0; p < ping.labels.views.size(); ++p) {
    const Pose& pose = ping.labels.views[p].world_from_part;
    meta["parts"].push_back({{"part", ping.labels.part_names[p]},
                             {"class", ping.labels.part_labels[p]},
                             {"number", p + 1},
                             {"scale", ping.labels.views[p].scale},
                             {"size_m", numbers_json(ping.labels.views[p].size)},
                             {"world_from_part", pose.matrix().isIdentity(0) ? ordered_json() : pose_json(pose)}});
  }
  if (source.randomisation && source.randomisation->spread.any())
    meta["randomised"] = randomised_json(randomised(source.randomisation->spread, source.randomisation->seed,
                                                    {.head = source.head_index, .number = ping.number}));
  const std::string line = fmt::format("- {}: {} beams, {:g} to {:g} m\n", cube.sonar, ping.fan.beams(),
                                       ping.gate.min_range, ping.gate.max_range);
  if (sonars_.find(line) == sonars_.npos) sonars_ += line;
  return meta;
}

ordered_json DatasetWriter::empty_coco() const {
  return {{"info",
           {{"description", "simulated sonar images"}, {"contributor", std::string("insonify ") + INSONIFY_VERSION}}},
          {"licenses", ordered_json::array()},
          {"images", ordered_json::array()},
          {"annotations", ordered_json::array()},
          {"categories", ordered_json::array()}};
}

std::string DatasetWriter::card() const {
  std::string text = fmt::format(
      "# Simulated sonar images\n\n{} images in two forms, with {} boxes in the polar and {} in the fan ones, made by "
      "insonify {}.\n\nSonars:\n{}\n## Images\n\n`polar/images`: 16 bits, a column for each beam from port to "
      "starboard, the first row is the farthest bin. `fan/images`: 8 bits, true geometry, forward up, starboard right; "
      "`fan_mapping.json` says where. Grey is linear in dB: black {:g} dB or below, white {:g} dB or above, {}. All "
      "images have this one mapping{}.\n\n",
      images_, polar_.boxes, fan_.boxes, INSONIFY_VERSION, sonars_, window_.min_db, window_.max_db,
      options_.raw ? "levels as received (re 1 uPa)"
                   : fmt::format("levels with a time-varied gain of {:g} log r + 2 a r", options_.tvg),
      options_.window.empty() ? ": 60 dB below a multiple of 5 dB that one sample in 1000 of all images exceeds" : "");
  const std::optional<double> least = parse_min_level(options_.min_level, window_.min_db);
  text += fmt::format(
      "## Labels\n\nA pixel has the class of a material if visible surface of it lies in the pixel's own cell "
      "(half-power widths of beam and pulse) and at least {:g} of the energy heard there is of it, within the main "
      "lobe; it is shadow if surface of the scene lies there but none is visible from the head; else nothing (water, "
      "or side lobes and multipath stronger than what is there). A pixel of a fan image covers several samples: its "
      "level "
      "is that of their mean intensity by area, its class the one that most of the energy comes from. Objects are the "
      "labelled parts of the scene or its field `instance`, with the same number in all images of a scene; the rest "
      "are connected parts of a class, with larger numbers (`found_by`). They have {} pixels of the polar image at "
      "least, and a box if they are {:g} dB above what is around them (`--min-contrast`): `unboxed` in `meta.jsonl` "
      "lists the others, which stay in the masks. Holes of a scan count as nothing{}.\n\n| value | class | polar "
      "pixels | fan pixels |\n|---|---|---|---|\n",
      options_.share, options_.least_pixels, options_.min_contrast,
      least ? fmt::format(", and so do surfaces in pixels below {:g} dB", *least) : "");
  std::vector<std::string> in_masks_alone;
  for (std::size_t k = 0; k < classes_.size(); ++k) {
    text += fmt::format("| {} | {} | {} | {} |\n", k, classes_[k], polar_.pixels[k], fan_.pixels[k]);
    if (k > 0 && !is_thing(k)) in_masks_alone.push_back(classes_[k]);
  }
  text += fmt::format(
      "\n`masks`: class; `colours`: the same in the colours of `palette.json`; `instances`: number of the object, 16 "
      "bits; `annotations`: COCO with run lengths; `labels`: YOLO, the classes that have boxes counted from 0 "
      "(`data.yaml`). In masks alone: {}.\n\n",
      in_masks_alone.empty() ? "none" : joined(in_masks_alone));
  const SplitUnit& by = *std::find_if(split_units().begin(), split_units().end(),
                                      [&](const SplitUnit& each) { return options_.split_by == each.name; });
  text += fmt::format(
      "## Split\n\nBy {}: {}.\n\n| split | images | taken within range of an image of train |\n|---|---|---|\n",
      by.name, by.means);
  for (const auto& [split, images] : tally_.images())
    text += fmt::format("| {} | {} | {} |\n", split, images,
                        split == "train" ? "" : std::to_string(tally_.near_train(split)));
  return text +
         "\n`meta.jsonl` has pose, sonar, water, seed and mapping of every image, and by how much it was randomised. "
         "`SHA256SUMS` checks the files: `sha256sum -c SHA256SUMS`.\n\nLevels are those of the simulation; scenes and "
         "their licences are the user's.\n";
}

ordered_json DatasetWriter::boxes_by_class() const {
  ordered_json boxes = ordered_json::object();
  for (const std::size_t k : boxed_classes())
    for (const std::string& split : split_names)
      for (const Form* form : {&polar_, &fan_}) {
        if (!form->coco.contains(split)) continue;
        std::size_t count = 0;
        for (const auto& a : form->coco.at(split)["annotations"]) count += a["category_id"].get<std::size_t>() == k;
        boxes[classes_[k]][split][form->name] = count;
      }
  return boxes;
}

// The classes that a box of either form has, by their values in masks; YOLO numbers them in this order from 0.
std::vector<std::size_t> DatasetWriter::boxed_classes() const {
  std::set<std::size_t> boxed;
  for (const Form* form : {&polar_, &fan_})
    for (const auto& [split, coco] : form->coco)
      for (const auto& annotation : coco["annotations"]) boxed.insert(annotation["category_id"].get<std::size_t>());
  return {boxed.begin(), boxed.end()};
}

// Readers resolve lists from the folder of the file itself, as long as there is no `path`, and demand train and val.
std::string DatasetWriter::yolo_yaml(const Form& form, const std::vector<std::size_t>& boxed) const {
  std::string yaml = "train: train.txt\n";
  yaml += form.lists.contains("val") ? "val: val.txt\n" : "val: train.txt  # there is no image of val\n";
  if (form.lists.contains("test")) yaml += "test: test.txt\n";
  yaml += "names:\n";
  for (std::size_t k = 0; k < boxed.size(); ++k)
    yaml += fmt::format("  {}: {}\n", k, ordered_json(classes_[boxed[k]]).dump());
  return yaml;
}

// What names classes by those that have boxes: COCO's categories, and the labels of YOLO.
void DatasetWriter::write_lists(Form& form, const std::vector<std::size_t>& boxed) const {
  for (auto& [split, coco] : form.coco) {
    for (const std::size_t k : boxed)
      coco["categories"].push_back(
          {{"id", k}, {"name", classes_[k]}, {"supercategory", k == 1 ? "shadow" : "surface"}});
    std::map<std::size_t, std::string> labels;
    for (const auto& a : coco["annotations"]) {
      const auto number = std::find(boxed.begin(), boxed.end(), a["category_id"].get<std::size_t>()) - boxed.begin();
      const double height = a["segmentation"]["size"][0], width = a["segmentation"]["size"][1];
      const double left = a["bbox"][0], top = a["bbox"][1], wide = a["bbox"][2], tall = a["bbox"][3];
      labels[a["image_id"].get<std::size_t>()] +=
          fmt::format("{} {:.6f} {:.6f} {:.6f} {:.6f}\n", number, (left + 0.5 * wide) / width,
                      (top + 0.5 * tall) / height, wide / width, tall / height);
    }
    for (const auto& image : coco["images"])
      write_file(directory_.file(form.name + "/labels/" +
                                 fs::path(image["file_name"].get<std::string>()).stem().string() + ".txt"),
                 labels[image["id"].get<std::size_t>()]);
    write_file(directory_.file(form.name + "/annotations/instances_" + split + ".json"), coco.dump() + "\n");
    write_file(directory_.file(form.name + "/" + split + ".txt"), form.lists.at(split));
    if (!options_.polygons) continue;
    for (std::size_t k = 0; k < coco["annotations"].size(); ++k)
      coco["annotations"][k]["segmentation"] = form.outlines[split][k];
    write_file(directory_.file(form.name + "/annotations/polygons_" + split + ".json"), coco.dump() + "\n");
  }
  write_file(directory_.file(form.name + "/data.yaml"), yolo_yaml(form, boxed));
}

void DatasetWriter::finish() {
  std::size_t labelled = 0;
  for (std::size_t k = 2; k < polar_.pixels.size(); ++k) labelled += polar_.pixels[k];
  if (labelled == 0)
    fail(ErrorKind::content, "no pixel of ", images_, " images shows a surface by --share ", options_.share,
         "; lower --share, or check that the images show the scene");
  const std::vector<std::size_t> boxed = boxed_classes();
  std::vector<std::string> boxed_names;
  for (const std::size_t k : boxed) boxed_names.push_back(classes_[k]);
  for (Form* form : {&polar_, &fan_}) write_lists(*form, boxed);
  write_file(directory_.file("meta.jsonl"), meta_);
  sheet_.save(directory_.file("sheet.png"));
  write_file(directory_.file("palette.json"), palette_json(classes_).dump(2) + "\n");
  ordered_json mappings = ordered_json::array();
  for (const auto& [key, r] : rasters_)
    mappings.push_back({{"width", r.beam.cols()},
                        {"height", r.beam.rows()},
                        {"metres_per_pixel", r.metres_per_pixel},
                        {"head_column", r.head_column},
                        {"head_row", r.head_row}});
  write_file(directory_.file("fan_mapping.json"), mappings.dump(2) + "\n");
  write_file(directory_.file("README.md"), card());

  // Digests of all files by name, for sha256sum and for the manifest.
  const fs::path root = fs::path(directory_.file("meta.jsonl")).parent_path();
  std::map<std::string, std::string> digests;
  for (const auto& entry : fs::recursive_directory_iterator(root))
    if (entry.is_regular_file())
      digests[fs::relative(entry.path(), root).string()] = sha256_of_file(entry.path().string());
  std::string sums;
  for (const auto& [name, digest] : digests) sums += digest + "  " + name + "\n";
  write_file(directory_.file("SHA256SUMS"), sums);
  write_manifest(directory_, {{"schema", 1},
                              {"insonify_version", INSONIFY_VERSION},
                              {"images", images_},
                              {"annotations", annotations_},
                              {"boxes", {{"polar", polar_.boxes}, {"fan", fan_.boxes}}},
                              {"unboxed", {{"polar", polar_.unboxed}, {"fan", fan_.unboxed}}},
                              {"boxed_classes", boxed_names},
                              {"boxes_by_class", boxes_by_class()},
                              {"classes", classes_},
                              {"renumbered_instances", renumbered_},
                              {digests_key, digests}});
}

}  // namespace insonify::tool
