#include "tool/dataset_writer.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/pending_file.hpp"
#include "core/sha256.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "returns/looks.hpp"
#include "tool/label_pictures.hpp"
#include "view/grey_file.hpp"
#include "view/label_colours.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// The objects of a picture of samples: by the scene's own instances, else connected parts of a class. `stuff` has none.
Grid<std::uint16_t> objects_of(const DatasetSource& source, const PixelLabels& labels, double share,
                               const Grid<std::uint8_t>& category, const std::set<std::uint8_t>& stuff,
                               std::size_t least_pixels) {
  const Grid<std::uint32_t> kind = category.unaryExpr(
      [&](std::uint8_t value) { return value != 0 && !stuff.contains(value) ? std::uint32_t{value} : 0; });
  const Grid<std::uint32_t> objects = number_objects(kind, id_image(labels, share), source.instances, least_pixels);
  if (objects.size() > 0 && objects.maxCoeff() > 65535)
    fail(ErrorKind::content, "an image has more than 65535 objects; ask for more with --least-pixels");
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

ordered_json randomised_json(const RandomisedPing& by) {
  return {{"source_level_db", by.source_level_db},
          {"noise_db", by.noise_db},
          {"temperature_c", by.temperature_c},
          {"salinity_psu", by.salinity_psu},
          {"position_m", {by.position.x(), by.position.y(), by.position.z()}},
          {"yaw_pitch_roll_deg", {degrees(by.angles[0]), degrees(by.angles[1]), degrees(by.angles[2])}}};
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

void DatasetWriter::add(const DatasetSource& source, const Cube& cube, const Ping& ping, const std::string& name,
                        std::optional<std::size_t> row) {
  const Grid<float> level = dataset_levels(ping, options_);
  std::set<std::uint8_t> stuff;
  for (std::size_t k = 2; k < classes_.size(); ++k)
    if (std::find(options_.stuff.begin(), options_.stuff.end(), classes_[k]) != options_.stuff.end())
      stuff.insert(static_cast<std::uint8_t>(k));
  const Grid<std::uint8_t> category = classes_of(ping.labels, options_.share, classes_);
  const Grid<std::uint16_t> object =
      objects_of(source, ping.labels, options_.share, category, stuff, static_cast<std::size_t>(options_.least_pixels));

  // The same labels in both forms.
  const FanRaster& raster = raster_of(ping);
  save_grey_png(directory_.file("polar/images/" + name + ".png"), polar_picture(quantise_16(level, window_), ping.fan));
  save_grey_png(directory_.file("fan/images/" + name + ".png"),
                fan_picture(quantise_8(level, window_), raster, std::uint8_t{0}));
  const LabelMap polar{polar_picture(category, ping.fan), polar_picture(object, ping.fan)};
  const LabelMap fan{fan_picture(category, raster, std::uint8_t{0}), fan_picture(object, raster, std::uint16_t{0})};
  ++images_;
  add_form(polar_, source, name, polar);
  add_form(fan_, source, name, fan);
  add_meta(source, cube, ping, name, row, polar);
}

void DatasetWriter::add_form(Form& form, const DatasetSource& source, const std::string& name, const LabelMap& map) {
  const auto path = [&](const char* folder, const char* ending) {
    return directory_.file(form.name + "/" + folder + "/" + name + ending);
  };
  save_grey_png(path("masks", ".png"), map.category);
  save_label_png(path("colours", ".png"), map.category);
  save_grey_png(path("instances", ".png"), map.instance);
  for (const std::uint8_t category : map.category.reshaped()) ++form.pixels[category];

  ordered_json& coco = form.coco.try_emplace(source.split, empty_coco()).first->second;
  const auto rows = map.category.rows(), columns = map.category.cols();
  coco["images"].push_back({{"id", images_}, {"file_name", name + ".png"}, {"width", columns}, {"height", rows}});
  std::string yolo;
  for (const Annotation& a : annotations_of(map)) {
    ++annotations_;
    coco["annotations"].push_back({{"id", annotations_},
                                   {"image_id", images_},
                                   {"category_id", a.category},
                                   {"instance", a.instance},
                                   {"bbox", {a.left, a.top, a.width, a.height}},
                                   {"area", a.area},
                                   {"iscrowd", 0},
                                   {"segmentation", {{"size", {rows, columns}}, {"counts", a.counts}}}});
    const double width = static_cast<double>(columns), height = static_cast<double>(rows);
    yolo += fmt::format("{} {:.6f} {:.6f} {:.6f} {:.6f}\n", a.category - 1, (a.left + 0.5 * a.width) / width,
                        (a.top + 0.5 * a.height) / height, a.width / width, a.height / height);
  }
  write_file(path("labels", ".txt"), yolo);
  form.lists[source.split] += "./images/" + name + ".png\n";
}

void DatasetWriter::add_meta(const DatasetSource& source, const Cube& cube, const Ping& ping, const std::string& name,
                             std::optional<std::size_t> row, const LabelMap& map) {
  std::vector<std::size_t> pixels(classes_.size());
  for (const std::uint8_t category : map.category.reshaped()) ++pixels[category];
  ordered_json meta = {{"name", name},
                       {"split", source.split},
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
                       {"min_range_m", ping.gate.min_range},
                       {"bin_size_m", ping.gate.bin_size},
                       {"mapping",
                        {{"min_db", window_.min_db},
                         {"max_db", window_.max_db},
                         {"tvg_db_per_decade", options_.raw ? ordered_json() : ordered_json(options_.tvg)}}},
                       {"polar_pixels", pixels}};
  if (row) meta["row"] = *row, meta["row_elevation_deg"] = degrees(ping.fan.elevation.front());
  if (source.randomisation && source.randomisation->spread.any())
    meta["randomised"] = randomised_json(randomised(source.randomisation->spread, source.randomisation->seed,
                                                    {.head = source.head_index, .number = ping.number}));
  meta_ += meta.dump() + "\n";
  const std::string line = fmt::format("- {}: {} beams, {:g} to {:g} m\n", cube.sonar, ping.fan.beams(),
                                       ping.gate.min_range, ping.gate.max_range);
  if (sonars_.find(line) == sonars_.npos) sonars_ += line;
}

ordered_json DatasetWriter::empty_coco() const {
  ordered_json categories = ordered_json::array();
  for (std::size_t k = 1; k < classes_.size(); ++k)
    categories.push_back({{"id", k}, {"name", classes_[k]}, {"supercategory", k == 1 ? "shadow" : "surface"}});
  return {{"info",
           {{"description", "simulated sonar images"}, {"contributor", std::string("insonify ") + INSONIFY_VERSION}}},
          {"licenses", ordered_json::array()},
          {"images", ordered_json::array()},
          {"annotations", ordered_json::array()},
          {"categories", categories}};
}

std::string DatasetWriter::card() const {
  std::string text = fmt::format(
      "# Simulated sonar images\n\n{} images with {} boxes in two forms, made by insonify {}.\n\nSonars:\n{}\n"
      "## Images\n\n`polar/images`: 16 bits, a column for each beam from port to starboard, the first row is the "
      "farthest bin. `fan/images`: 8 bits, true "
      "geometry, forward up, starboard right; `fan_mapping.json` says where. Grey is linear in dB: black {:g} dB or "
      "below, white {:g} dB or above, {}. All "
      "images have this one mapping.\n\n",
      images_, annotations_, INSONIFY_VERSION, sonars_, window_.min_db, window_.max_db,
      options_.raw ? "levels as received (re 1 uPa)"
                   : fmt::format("levels with a time-varied gain of {:g} log r + 2 a r", options_.tvg));
  text += fmt::format(
      "## Labels\n\nA pixel has the class of a material if visible surface of it lies in the pixel's own cell "
      "(half-power "
      "widths of beam and pulse) and at least {:g} of the energy heard there is of it, within the main lobe; it is "
      "shadow if surface of the scene lies there but none is visible from the head; else nothing (water, or side lobes "
      "and multipath stronger than what is there). Objects are the scene's field `instance`, or without it connected "
      "parts of a class, of {} "
      "pixels of the polar image at least. "
      "Holes of a scan count as nothing.\n\n| value | class | polar pixels | fan pixels |\n|---|---|---|---|\n",
      options_.share, options_.least_pixels);
  for (std::size_t k = 0; k < classes_.size(); ++k)
    text += fmt::format("| {} | {} | {} | {} |\n", k, classes_[k], polar_.pixels[k], fan_.pixels[k]);
  text += fmt::format(
      "\n`masks`: class; `colours`: the same in the colours of `palette.json`; `instances`: number of the object, 16 "
      "bits; `annotations`: COCO with run lengths; `labels`: "
      "YOLO, classes counted from shadow = 0. In masks alone: {}.\n\n",
      options_.stuff.empty() ? "none" : joined(options_.stuff));
  text += "## Split\n\nBy scene: no scene is in two of train, val and test.\n\n| split | images |\n|---|---|\n";
  for (const auto& [split, coco] : polar_.coco) text += fmt::format("| {} | {} |\n", split, coco["images"].size());
  return text +
         "\n`meta.jsonl` has pose, sonar, water, seed and mapping of every image, and by how much it was randomised. "
         "`SHA256SUMS` checks the files: `sha256sum -c "
         "SHA256SUMS`.\n\nLevels are those of the simulation; scenes and their licences are the user's.\n";
}

void DatasetWriter::finish() {
  std::size_t labelled = 0;
  for (std::size_t k = 2; k < polar_.pixels.size(); ++k) labelled += polar_.pixels[k];
  if (labelled == 0)
    fail(ErrorKind::content, "no pixel of ", images_, " images shows a surface by --share ", options_.share,
         "; lower it, or look where the scene is");
  for (const Form* form : {&polar_, &fan_}) {
    std::string yaml = "path: .\n";
    for (const auto& [split, coco] : form->coco) {
      write_file(directory_.file(form->name + "/annotations/instances_" + split + ".json"), coco.dump() + "\n");
      write_file(directory_.file(form->name + "/" + split + ".txt"), form->lists.at(split));
      yaml += split + ": " + split + ".txt\n";
    }
    yaml += "names:\n";
    for (std::size_t k = 1; k < classes_.size(); ++k)
      yaml += fmt::format("  {}: {}\n", k - 1, ordered_json(classes_[k]).dump());
    write_file(directory_.file(form->name + "/data.yaml"), yaml);
  }
  write_file(directory_.file("meta.jsonl"), meta_);
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
  write_file(directory_.file("manifest.json"), ordered_json{{"schema", 1},
                                                            {"insonify_version", INSONIFY_VERSION},
                                                            {"images", images_},
                                                            {"annotations", annotations_},
                                                            {"classes", classes_}}
                                                       .dump(2) +
                                                   "\n");

  // Digests of all files, by name.
  const fs::path root = fs::path(directory_.file("meta.jsonl")).parent_path();
  std::map<std::string, std::string> digests;
  for (const auto& entry : fs::recursive_directory_iterator(root))
    if (entry.is_regular_file())
      digests[fs::relative(entry.path(), root).string()] = sha256_of_file(entry.path().string());
  std::string sums;
  for (const auto& [name, digest] : digests) sums += digest + "  " + name + "\n";
  write_file(directory_.file("SHA256SUMS"), sums);
}

}  // namespace insonify::tool
