// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/units.hpp"
#include "files/memory_limit.hpp"
#include "run/parse_values.hpp"
#include "run/ping_setup.hpp"
#include "run/run_settings.hpp"
#include "run/scene_reach.hpp"
#include "run_scenes/open_scene.hpp"
#include "run_scenes/stored_levels.hpp"
#include "scene/material_shares.hpp"
#include "scene_io/describe_file.hpp"
#include "tiles/tiled_scene.hpp"
#include "tool/info/info.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

/// For each material of a scene: name, law, points, share and, where areas are known, area_m2.
ordered_json shares_json(const std::vector<MaterialShare>& shares) {
  ordered_json all = ordered_json::array();
  for (const MaterialShare& share : shares) {
    ordered_json row = {{"name", share.name}, {"law", share.law}, {"points", share.points}, {"share", share.share}};
    if (share.area) row["area_m2"] = *share.area;
    all.push_back(row);
  }
  return all;
}

ordered_json point(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// A length in two digits.
double about(double length) {
  if (!(length > 0)) return 0;
  const double step = std::pow(10, std::floor(std::log10(length)) - 1);
  return std::round(length / step) * step;
}

}  // namespace

std::vector<std::string> next_of_scene(const std::string& path, const Bounds& box) {
  const Eigen::Vector3d size = box.max - box.min, middle = (box.min + box.max) / 2;
  const double across = std::max(size.x(), size.y());
  if (!(across > 0)) return {};
  const double z = height_over(box);
  const double back = std::min(0.65 * size.x(), 40.0), deep = std::max(z - box.min.z(), 0.01 * across);
  const Eigen::Vector3d head(middle.x() - back, middle.y(), z);
  const auto rounded = [](double value, double parts) { return std::round(parts * value) / parts + 0.0; };  // no -0
  const std::string word = shell_word(path);
  const double spacing = about(std::min(2 * deep, size.y() / 2));
  std::vector<std::string> next = {fmt::format("insonify ping {} --sonar oculus-m750d --pose={} -o first", word,
                                               pose_text(head, 0, std::atan2(z - middle.z(), back)))};
  if (spacing > 0)
    next.push_back(fmt::format(
        "insonify make-mission lawnmower --scene {} --sonar em2040 --centre {:.10g},{:.10g},{:.10g} --size {:g},{:g} "
        "--spacing {:g} -o mission.toml",
        word, rounded(middle.x(), 10), rounded(middle.y(), 10), rounded(z, 100), about(0.9 * size.x()),
        spacing * std::floor(0.9 * size.y() / spacing), spacing));
  return next;
}

namespace {

/// Returns true if an organised cloud was seen along z from its viewpoint: it has the axes of a camera, z ahead.
bool is_of_camera(const FileDescription& d) {
  if (!d.viewpoint || d.height <= 1) return false;
  const Eigen::Vector3d ahead = (d.min + d.max) / 2 - *d.viewpoint;
  return d.min.z() > d.viewpoint->z() && ahead.head<2>().norm() < ahead.z();
}

std::string next_of_camera(const FileDescription& d) {
  return fmt::format("insonify ping {} --sonar oculus-m750d --pose={} -o first  # where the camera was",
                     shell_word(d.path), pose_text(*d.viewpoint, pi / 2, -pi / 2));
}

/// The commands that go on from a cloud. With options they prepare it first, so that the next ones need none.
std::vector<std::string> next_of_cloud(const FileDescription& d, const MeaningOverride& requested) {
  std::string options;
  for (const MeaningOption& item : meaning_options())
    if (const std::string value = item.text(requested); !value.empty())
      options += fmt::format(" {} {}", item.option, shell_word(value));
  const bool sided = d.has_normals || d.triangles > 0 || d.viewpoint || !d.stations.empty();
  const bool prepares = !sided || !options.empty();
  const std::string prepared = prepares ? "prepared.ply" : d.path;
  std::vector<std::string> next =
      is_of_camera(d) ? std::vector{next_of_camera(d)} : next_of_scene(prepared, {d.min, d.max});
  if (prepares)
    next.insert(next.begin(), "insonify prepare " + shell_word(d.path) + options + (sided ? "" : " --viewpoint x,y,z") +
                                  " -o prepared.ply" + (sided ? "" : "  # where it was captured from"));
  if (!d.has_materials)
    next.push_back("insonify materials  # names for --material, which gives the whole scene one material");
  return next;
}

ordered_json cloud_info(const std::string& path, const MeaningOverride& requested) {
  const FileDescription d = describe_file(path, requested);
  ordered_json fields = ordered_json::array();
  for (const auto& f : d.fields) fields.push_back({{"name", f.name}, {"type", f.type}});
  ordered_json meaning = ordered_json::array();
  for (const MeaningItem& m : d.meaning)
    meaning.push_back({{"item", m.name}, {"value", m.value}, {"origin", m.origin}, {"sentence", m.sentence}});
  ordered_json json = {{"path", d.path},
                       {"format", d.format},
                       {"reader", d.reader},
                       {"points", d.points},
                       {"triangles", d.triangles},
                       {"width", d.width},
                       {"height", d.height},
                       {"not_finite", d.not_finite},
                       {"withheld", d.withheld},
                       {"duplicates", d.duplicates},
                       {"fields", fields},
                       {"meaning", meaning},
                       {"bounds", {{"min", point(d.min)}, {"max", point(d.max)}}},
                       {"median_spacing", d.median_spacing},
                       {"normals", d.has_normals},
                       {"area", d.has_area},
                       {"materials", d.has_materials},
                       {"material_shares", shares_json(d.materials)},
                       {"problems", d.problems}};
  if (d.viewpoint) json["viewpoint"] = point(*d.viewpoint);
  const StoredLevels levels = find_levels({path});
  if (levels.tiles) json["levels"] = {{"path", levels.tiles->info().path}, {"bytes", levels.tiles->info().bytes}};
  if (!levels.note.empty()) json["problems"].push_back(levels.note);
  for (const Eigen::Vector3d& position : d.stations) json["stations"].push_back(point(position));
  json["next"] = next_of_cloud(d, requested);
  return json;
}

std::vector<MaterialShare> shares_of(const SceneCloud& scene) {
  return material_shares(scene.materials, scene.material, scene.area);
}

ordered_json tiles_info(const std::string& path, const TiledScene& tiled) {
  const TiledSceneInfo& info = tiled.info();
  ordered_json json = {{"path", path},
                       {"format", "insonify tiles"},
                       {"reader", "HDF5"},
                       {"surfels", info.surfels},
                       {"tiles", info.tiles},
                       {"bytes", info.bytes},
                       {"origin", point(info.origin)},
                       {"area_m2", info.total_area},
                       {"mean_spacing_m", info.whole.mean_spacing},
                       {"largest_area_m2", info.whole.largest_area},
                       {"normals_oriented", info.normals_oriented},
                       {"materials", words_of(info.materials)}};
  if (!info.system.empty()) json["system"] = info.system;
  if (info.surfels == 0) return json;
  if (tiled.select_all().bytes_to_load() < 0.5 * available_memory())
    json["material_shares"] = shares_json(shares_of(tiled.load(tiled.select_all())));
  json["bounds"] = {{"min", point(info.box.min)}, {"max", point(info.box.max)}};
  json["next"] = next_of_scene(path, info.box);
  return json;
}

}  // namespace

ordered_json info_of_scene(const std::string& path, const MeaningOverride& requested) {
  const std::optional<TiledScene> tiled = find_tiles(path);
  return tiled ? tiles_info(path, *tiled) : cloud_info(path, requested);
}

void print_scene(const ordered_json& d) {
  const auto text = [](const ordered_json& value) { return value.get<std::string>(); };
  const auto corner_of = [&](const char* corner) {
    const ordered_json& at = d["bounds"][corner];
    return Eigen::Vector3d(at[0].get<double>(), at[1].get<double>(), at[2].get<double>());
  };
  fmt::print("{}\n  format     {}, read by {}\n  points     {}", text(d["path"]), text(d["format"]), text(d["reader"]),
             d["points"].get<std::size_t>());
  if (d["height"].get<std::size_t>() > 1)
    fmt::print(" ({} x {}, organised)", d["width"].get<std::size_t>(), d["height"].get<std::size_t>());
  if (d["triangles"].get<std::size_t>() > 0) fmt::print(", {} triangles", d["triangles"].get<std::size_t>());
  fmt::print("\n  not finite {}\n  duplicates {}\n  fields    ", d["not_finite"].get<std::size_t>(),
             d["duplicates"].get<std::size_t>());
  for (const auto& f : d["fields"]) fmt::print(" {}:{}", text(f["name"]), text(f["type"]));
  for (const auto& m : d["meaning"])
    fmt::print("\n  meaning    {}: {} ({}){}{}", text(m["item"]), text(m["value"]), text(m["origin"]),
               text(m["sentence"]).empty() ? "" : ": ", text(m["sentence"]));
  const Eigen::Vector3d min = corner_of("min"), max = corner_of("max"), size = max - min;
  // To a tenth of the spacing, in plain digits: a northing has seven before the point.
  const double spacing = d["median_spacing"].get<double>();
  const int digits = spacing > 0 ? std::clamp(static_cast<int>(std::ceil(1 - std::log10(spacing))), 0, 9) : 3;
  fmt::print("\n  bounds     x {:.{}f}..{:.{}f}  y {:.{}f}..{:.{}f}  z {:.{}f}..{:.{}f}\n", min.x(), digits, max.x(),
             digits, min.y(), digits, max.y(), digits, min.z(), digits, max.z(), digits);
  fmt::print("  size       {:.4g} x {:.4g} x {:.4g}\n", size.x(), size.y(), size.z());
  const auto yes = [&](const char* key) { return d[key].get<bool>() ? "yes" : "no"; };
  fmt::print("  spacing    {:.4g} (median)\n  normals    {}\n  area       {}\n  materials  {}\n", spacing,
             yes("normals"), yes("area"), yes("materials"));
  for (const auto& m : d["material_shares"])
    fmt::print("  material   {}: law {}, {} points, {}{:.3g} %\n", text(m["name"]), text(m["law"]),
               m["points"].get<std::size_t>(),
               m.contains("area_m2") ? fmt::format("{:.4g} m2, ", m["area_m2"].get<double>()) : "",
               100 * m["share"].get<double>());
  if (d.contains("viewpoint"))
    fmt::print("  viewpoint  {:g}, {:g}, {:g}\n", d["viewpoint"][0].get<double>(), d["viewpoint"][1].get<double>(),
               d["viewpoint"][2].get<double>());
  if (d.contains("levels"))
    fmt::print("  levels     {}, {} bytes\n", text(d["levels"]["path"]), d["levels"]["bytes"].get<std::uint64_t>());
  for (const auto& problem : d["problems"]) fmt::print("  note       {}\n", text(problem));
  for (const auto& command : d["next"]) fmt::print("  next       {}\n", text(command));
}

}  // namespace insonify::tool
