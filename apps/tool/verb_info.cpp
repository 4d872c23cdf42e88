#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.hpp"
#include "scene_io/describe_file.hpp"
#include "scene_io/tiled_scene.hpp"
#include "store/cube.hpp"
#include "store/sonar_file.hpp"
#include "tool/run_checks.hpp"
#include "tool/scene_files.hpp"
#include "tool/shared_options.hpp"
#include "tool/verb.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

struct InfoOptions {
  CommonOptions common;
  std::vector<std::string> files;
  bool verify = false;
};

void add_options(OptionList list, InfoOptions& o) {
  list.add("FILE", &o.files, "cloud, mesh, sonar .toml, cube.h5 or run directory", {.required = true});
  list.add("--verify", &o.verify, "compare the files of runs and surveys with the SHA-256 of when they were made");
  add_common(list, o.common);
}

ordered_json point(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

ordered_json cloud_json(const FileDescription& d) {
  ordered_json fields = ordered_json::array();
  for (const auto& f : d.fields) fields.push_back({{"name", f.name}, {"type", f.type}});
  ordered_json json = {{"path", d.path},
                       {"format", d.format},
                       {"points", d.points},
                       {"triangles", d.triangles},
                       {"width", d.width},
                       {"height", d.height},
                       {"not_finite", d.not_finite},
                       {"duplicates", d.duplicates},
                       {"fields", fields},
                       {"bounds", {{"min", point(d.min)}, {"max", point(d.max)}}},
                       {"median_spacing", d.median_spacing},
                       {"normals", d.has_normals},
                       {"area", d.has_area},
                       {"materials", d.has_materials},
                       {"problems", d.problems}};
  if (d.viewpoint) json["viewpoint"] = point(*d.viewpoint);
  return json;
}

void print_cloud(const FileDescription& d) {
  fmt::print("{}\n  format     {}\n  points     {}", d.path, d.format, d.points);
  if (d.height > 1) fmt::print(" ({} x {}, organised)", d.width, d.height);
  if (d.triangles > 0) fmt::print(", {} triangles", d.triangles);
  fmt::print("\n  not finite {}\n  duplicates {}\n  fields    ", d.not_finite, d.duplicates);
  for (const auto& f : d.fields) fmt::print(" {}:{}", f.name, f.type);
  const Eigen::Vector3d size = d.max - d.min;
  // To a tenth of the spacing, in plain digits: a northing has seven before the point.
  const int digits =
      d.median_spacing > 0 ? std::clamp(static_cast<int>(std::ceil(1 - std::log10(d.median_spacing))), 0, 9) : 3;
  fmt::print("\n  bounds     x {:.{}f}..{:.{}f}  y {:.{}f}..{:.{}f}  z {:.{}f}..{:.{}f}\n", d.min.x(), digits,
             d.max.x(), digits, d.min.y(), digits, d.max.y(), digits, d.min.z(), digits, d.max.z(), digits);
  fmt::print("  size       {:.4g} x {:.4g} x {:.4g}\n", size.x(), size.y(), size.z());
  fmt::print("  spacing    {:.4g} (median)\n  normals    {}\n  area       {}\n  materials  {}\n", d.median_spacing,
             d.has_normals ? "yes" : "no", d.has_area ? "yes" : "no", d.has_materials ? "yes" : "no");
  if (d.viewpoint) fmt::print("  viewpoint  {:g}, {:g}, {:g}\n", d.viewpoint->x(), d.viewpoint->y(), d.viewpoint->z());
  for (const std::string& problem : d.problems) fmt::print("  note       {}\n", problem);
}

ordered_json cube_json(const std::string& path, const Cube& cube) {
  const Ping& first = cube.pings.front();
  ordered_json layers = ordered_json::array();
  for (const Layer& layer : first.layers) layers.push_back(layer.name);
  // The water of a dive is not one number.
  const auto water = [&](double Ping::*number) -> ordered_json {
    const auto [least, most] = std::minmax_element(
        cube.pings.begin(), cube.pings.end(), [number](const Ping& a, const Ping& b) { return a.*number < b.*number; });
    if ((*least).*number == (*most).*number) return first.*number;
    return {(*least).*number, (*most).*number};
  };
  return {{"path", path},
          {"format", "insonify ping cube"},
          {"sonar", cube.sonar},
          {"pings", cube.pings.size()},
          {"beams", first.fan.beams()},
          {"bins", first.gate.bins()},
          {"min_range_m", first.gate.min_range},
          {"max_range_m", first.gate.max_range},
          {"bin_size_m", first.gate.bin_size},
          {"layers", layers},
          {"centre_frequency_hz", cube.centre_frequency},
          {"bandwidth_hz", cube.bandwidth},
          {"source_level_db", cube.source_level_db},
          {"sound_speed", water(&Ping::sound_speed)},
          {"absorption_db_per_m", water(&Ping::absorption_db_per_m)},
          {"seed", cube.seed},
          {"peak_level_db", level_db(first).maxCoeff()},
          {"insonify_version", cube.insonify_version}};
}

void print_json_as_text(const ordered_json& json) {
  for (const auto& [key, value] : json.items())
    fmt::print("  {:<20} {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
}

ordered_json sonar_summary(const SonarFile& f) {
  return {{"path", f.path},
          {"format", "insonify sonar"},
          {"name", f.spec.name},
          {"beams", f.spec.beams},
          {"centre_frequency_hz", f.spec.centre_frequency},
          {"bandwidth_hz", f.spec.bandwidth}};
}

ordered_json tiles_summary(const std::string& path) {
  const TiledScene tiled(path);
  const TiledSceneInfo& info = tiled.info();
  ordered_json materials = ordered_json::array();
  for (const Material& m : info.materials) materials.push_back(m.name);
  ordered_json json = {{"path", path},
                       {"format", "insonify tiles"},
                       {"surfels", info.surfels},
                       {"tiles", info.tiles},
                       {"bytes", info.bytes},
                       {"origin", point(info.origin)},
                       {"area_m2", info.total_area},
                       {"mean_spacing_m", info.whole.mean_spacing},
                       {"largest_area_m2", info.whole.largest_area},
                       {"normals_oriented", info.normals_oriented},
                       {"materials", materials}};
  if (info.surfels > 0) json["bounds"] = {{"min", point(info.box.min)}, {"max", point(info.box.max)}};
  return json;
}

/// Compares the files of all runs. Throws Error(content) if one was changed.
void verify(const InfoOptions& o) {
  ordered_json all = ordered_json::array();
  std::vector<std::string> problems;
  for (const std::string& run : o.files) {
    const RunCheck check = check_run(run);
    for (const std::string& problem : check.problems) problems.push_back(run + ": " + problem);
    all.push_back({{"path", run}, {"files", check.files}, {"problems", check.problems}});
    if (!o.common.json && check.problems.empty()) fmt::print("{}: {} files as they were made\n", run, check.files);
  }
  if (o.common.json) fmt::print("{}\n", (all.size() == 1 ? all[0] : all).dump(2));
  if (!problems.empty()) fail(ErrorKind::content, joined(problems), "; copy the run again, or make it again");
}

void info(const InfoOptions& o) {
  if (o.verify) return verify(o);
  ordered_json all = ordered_json::array();
  for (const std::string& path : o.files) {
    const std::filesystem::path file(path);
    const bool is_run = std::filesystem::is_directory(file);
    if (is_run || file.extension() == ".h5") {
      const std::string cube = is_run ? path + "/cube.h5" : path;
      all.push_back(cube_json(cube, read_cube(cube)));
    } else if (is_tiles(path)) {
      all.push_back(tiles_summary(path));
    } else if (file.extension() == ".toml") {
      all.push_back(sonar_summary(load_sonar_file(path)));
    } else {
      const FileDescription d = describe_file(path);
      if (!o.common.json) {
        print_cloud(d);
        continue;
      }
      all.push_back(cloud_json(d));
    }
    if (!o.common.json) print_json_as_text(all.back());
  }
  if (o.common.json) fmt::print("{}\n", (all.size() == 1 ? all[0] : all).dump(2));
}

}  // namespace

Verb info_verb() {
  return make_verb<InfoOptions>(
      "info", "what is in a file or run, and what is wrong with it",
      {"insonify info reef.pcd", "insonify info reef.pcd --json | jq .bounds", "insonify info --verify out"},
      add_options, info);
}

}  // namespace insonify::tool
