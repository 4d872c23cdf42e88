// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "files/pending_file.hpp"
#include "files/sha256.hpp"
#include "returns/looks.hpp"
#include "run/run_checks.hpp"
#include "store/run_directory.hpp"
#include "tool/dataset/dataset.hpp"
#include "tool/dataset/labelled_image.hpp"
#include "view/grey_file.hpp"
#include "view/label_colours.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

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
  for (DatasetForm* form : {&polar_, &fan_}) {
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

void DatasetWriter::add(const DatasetSource& source, const Cube& cube, const Ping& ping, const DatasetImage& image) {
  ImageRules rules{options_.share,
                   {},
                   static_cast<std::size_t>(options_.least_pixels),
                   parse_min_level(options_.min_level, window_.min_db)};
  for (std::size_t k = 1; k < classes_.size(); ++k)
    if (!is_thing(options_, classes_, k)) rules.stuff.insert(static_cast<std::uint8_t>(k));

  // Label the samples once for both forms: each in one pixel, or all that a pixel covers.
  const LabelledSamples samples =
      labelled_samples(ping, dataset_levels(ping, options_), source.instances, classes_, rules);
  const ObjectsOf& objects = samples.objects;
  const FanRaster& raster = raster_of(ping);
  LabelledImage in_polar = polar_image(samples, ping.fan), in_fan = fan_image(samples, ping, raster, rules);
  const FormOf polar{{ping}, std::move(in_polar.map), std::move(in_polar.level_db), objects},
      fan{{ping, &raster}, std::move(in_fan.map), std::move(in_fan.level_db), objects};
  const Grid<std::uint8_t> shown = quantise_8(fan.level_db, window_);
  save_grey_png(directory_.file("polar/images/" + image.name + ".png"), quantise_16(polar.level_db, window_));
  save_grey_png(directory_.file("fan/images/" + image.name + ".png"), shown);
  ++images_;
  std::vector<std::size_t> pixels(classes_.size());
  for (const std::uint8_t of_class : polar.map.category.reshaped()) ++pixels[of_class];
  ordered_json meta = image_meta({source, cube, ping, image}, options_, window_, pixels);
  const Contrasts of_polar = add_form(polar_, image, polar), of_fan = add_form(fan_, image, fan);
  sheet_.add(shown, boxed_of_sheet_);
  if (!ping.labels.views.empty())
    meta["objects"] = with_contrasts(part_objects_json(ping.labels, objects.parts, polar.picture, fan.picture),
                                     of_polar.of, of_fan.of);
  meta["unboxed"] = {{"polar", of_polar.unboxed}, {"fan", of_fan.unboxed}};
  meta_ += meta.dump() + "\n";
  note_source(source, cube, ping);
  tally_.add(image.split, source.scene_digest, ping.world_from_head.translation(), ping.gate.max_range);
}

void DatasetWriter::note_source(const DatasetSource& source, const Cube& cube, const Ping& ping) {
  for (const auto& [number, given] : source.instances.renumbered)
    renumbered_[source.scene_digest][std::to_string(number)] = given;
  const std::string line = fmt::format("- {}: {} beams, {:g} to {:g} m\n", cube.sonar, ping.fan.beams(),
                                       ping.gate.min_range, ping.gate.max_range);
  if (sonars_.find(line) == sonars_.npos) sonars_ += line;
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

DatasetWriter::Contrasts DatasetWriter::add_form(DatasetForm& form, const DatasetImage& image, const FormOf& of) {
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
  ordered_json* const of_split = options_.polygons ? &form.outlines[image.split] : nullptr;
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
    if (of_split) of_split->push_back(outlines_of(map.instance, a.instance));
    boxed_of_sheet_.push_back(std::move(a));
  }
  form.lists[image.split] += "./images/" + image.name + ".png\n";
  return contrasts;
}

void DatasetWriter::finish() {
  std::size_t labelled = 0;
  for (std::size_t k = 2; k < polar_.pixels.size(); ++k) labelled += polar_.pixels[k];
  if (labelled == 0)
    fail(ErrorKind::content, "no pixel of ", images_, " images shows a surface by --share ", options_.share,
         "; lower --share, or check that the images show the scene");
  const std::vector<std::size_t> boxed = boxed_classes({&polar_, &fan_});
  std::vector<std::string> boxed_names;
  for (const std::size_t k : boxed) boxed_names.push_back(classes_[k]);
  for (DatasetForm* form : {&polar_, &fan_}) write_lists(directory_, *form, classes_, boxed);
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
  write_file(directory_.file("README.md"),
             dataset_card({options_, classes_, window_, polar_, fan_, tally_, images_, sonars_}));

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
