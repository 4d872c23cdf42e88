// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "scene/merge_parts_internal.hpp"
#include "scene/posed_scene.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t most_parts_of_scene = 65000;

double mean_spacing_of(const SceneCloud& cloud) { return whole_of(cloud).mean_spacing; }

Vector3d size_of(const PlacedPart& placed) {
  if (placed.captured || !placed.size.isZero(0)) return placed.size;
  const Bounds box = bounds(*placed.cloud);
  return box.max - box.min;
}

/// Returns the number of the k-th surfel of a part in its cloud.
std::size_t surfel_number(const PlacedPart& placed, std::size_t k) {
  return placed.surfels.empty() ? k : placed.surfels[k];
}

/// Appends noise and unevenness of a part's surfels if this part or one before has them.
void add_heights(const PlacedPart& placed, std::size_t before, SceneCloud& scene) {
  const SceneCloud& cloud = *placed.cloud;
  const auto spacing = [&](std::size_t i) { return std::sqrt(static_cast<double>(scene.area[i])); };
  if (!scene.noise.empty() || !cloud.noise.empty()) {
    scene.noise.resize(scene.size(), 0);
    for (std::size_t i = before; i < scene.size() && !cloud.noise.empty(); ++i)
      scene.noise[i] = cloud.noise[surfel_number(placed, i - before)];
  }
  if (scene.unevenness.empty() && cloud.unevenness.empty()) return;
  for (std::size_t i = scene.unevenness.size(); i < scene.size(); ++i)
    scene.unevenness.push_back(i >= before && !cloud.unevenness.empty()
                                   ? cloud.unevenness[surfel_number(placed, i - before)]
                                   : static_cast<float>(spacing(i)));
}

/// Returns the position of a part in the list of a scene, a new one unless it is among the first `numbered`.
std::size_t part_entry(const std::string& name, std::size_t numbered, std::vector<ScenePart>& parts) {
  const auto end = parts.begin() + static_cast<std::ptrdiff_t>(numbered);
  const auto known = std::find_if(parts.begin(), end, [&](const ScenePart& part) { return part.name == name; });
  if (known != end) return static_cast<std::size_t>(known - parts.begin());
  parts.emplace_back();
  return parts.size() - 1;
}

}  // namespace

void require_valid(const PlacedPart& part, const char* who) {
  const auto refuse = [&](const auto&... why) { fail(ErrorKind::argument, who, ": part '", part.name, "': ", why...); };
  if (part.name.empty()) fail(ErrorKind::argument, who, ": a part has no name");
  if (part.absent) return;
  if (!part.cloud || part.cloud->size() == 0) refuse("it has no surfels");
  const Eigen::Matrix3d r = part.world_from_part.linear();
  if (!part.world_from_part.matrix().allFinite() || !(r * r.transpose()).isIdentity(1e-6) || r.determinant() < 0)
    refuse("world_from_part must be finite, a rotation and a translation");
  if (!part.velocity.allFinite() || !part.turn_rate.allFinite()) refuse("velocity and turn rate must be finite");
  if (part.captured && (part.moves() || !part.world_from_part.matrix().isIdentity(0)))
    refuse("a captured part is neither moved nor turned");
  for (std::size_t k = 0; k < part.surfels.size(); ++k)
    if (part.surfels[k] >= part.cloud->size() || (k > 0 && part.surfels[k] <= part.surfels[k - 1]))
      refuse("surfels[", k, "] = ", part.surfels[k], ", must ascend and be below ", part.cloud->size());
}

PartList list_of(std::span<const PlacedPart> parts, const char* who) {
  PartList list;
  for (const PlacedPart& part : parts) {
    require_valid(part, who);
    list.push_back(&part);
  }
  return list;
}

PartList by_name(std::span<const PlacedPart> parts, const char* who) {
  PartList list = list_of(parts, who);
  std::sort(list.begin(), list.end(), [](const PlacedPart* a, const PlacedPart* b) { return a->name < b->name; });
  return list;
}

void require_distinct(const std::vector<ScenePart>& parts, const char* who) {
  if (parts.size() > most_parts_of_scene)
    fail(ErrorKind::argument, who, ": ", parts.size(), " parts, must be at most ", most_parts_of_scene);
  std::vector<std::string> names;
  for (const ScenePart& part : parts) names.push_back(part.name);
  std::sort(names.begin(), names.end());
  if (const auto twice = std::adjacent_find(names.begin(), names.end()); twice != names.end())
    fail(ErrorKind::argument, who, ": two parts are called '", *twice, "'; give each a name of its own");
}

std::uint16_t material_index(const Material& material, std::vector<Material>& table, const char* who) {
  const auto at = std::find(table.begin(), table.end(), material);
  if (at == table.end()) {
    if (table.size() >= 0xffff) fail(ErrorKind::argument, who, ": more than 65535 different materials");
    table.push_back(material);
    return static_cast<std::uint16_t>(table.size() - 1);
  }
  return static_cast<std::uint16_t>(at - table.begin());
}

Vector3d origin_of(const PartList& parts) {
  for (const PlacedPart* part : parts)
    if (part->captured && !part->absent) return part->cloud->origin;
  return parts.empty() ? Vector3d(Vector3d::Zero())
                       : Vector3d(parts.front()->world_from_part.translation().array().round());
}

Eigen::Isometry3d scene_from_cloud(const SceneCloud& scene, const PlacedPart& placed) {
  Eigen::Isometry3d turn = placed.world_from_part;
  turn.translation() += placed.world_from_part.linear() * placed.cloud->origin - scene.origin;
  return turn;
}

ScenePart scene_part(const PlacedPart& placed) {
  const std::uint64_t key = placed.key.value_or(part_key(placed.name));
  if (placed.absent) return {.name = placed.name, .label = placed.label, .key = key};
  return {.name = placed.name,
          .label = placed.label,
          .key = key,
          .spacing = mean_spacing_of(*placed.cloud),
          .normals_oriented = placed.cloud->normals_oriented,
          .world_from_part = placed.world_from_part,
          .velocity = placed.velocity,
          .turn_rate = placed.turn_rate,
          .own = placed.captured ? nullptr : placed.cloud,
          .file_origin = placed.file_origin,
          .scale = placed.scale,
          .size = size_of(placed)};
}

std::size_t count_of(const PlacedPart& placed) {
  if (placed.absent) return 0;
  return placed.surfels.empty() ? placed.cloud->size() : placed.surfels.size();
}

void reserve_surfels(std::size_t more, SceneCloud& scene) {
  const auto grow = [all = scene.size() + more](auto& array) {
    if (all > array.capacity()) array.reserve(std::max(all, array.size() + array.size() / 4));
  };
  grow(scene.point), grow(scene.normal), grow(scene.area), grow(scene.material), grow(scene.id), grow(scene.part);
}

void place_surfels(const PlacedPart& placed, std::size_t first, SceneCloud& scene) {
  const SceneCloud& cloud = *placed.cloud;
  const Eigen::Isometry3d to_scene = scene_from_cloud(scene, placed);
  const bool as_it_is = placed.captured && cloud.origin == scene.origin;
  for (std::size_t k = 0; k < count_of(placed); ++k) {
    const std::size_t i = surfel_number(placed, k);
    scene.point[first + k] = as_it_is ? cloud.point[i] : (to_scene * cloud.point[i].cast<double>()).cast<float>();
    scene.normal[first + k] =
        placed.captured ? cloud.normal[i] : (to_scene.linear() * cloud.normal[i].cast<double>()).cast<float>();
  }
}

std::uint16_t append_part(const PlacedPart& placed, std::size_t numbered, SceneCloud& scene, const char* who) {
  std::vector<std::uint16_t> material;
  if (!placed.absent)
    for (const Material& m : placed.cloud->materials) material.push_back(material_index(m, scene.materials, who));
  const auto number = static_cast<std::uint16_t>(part_entry(placed.name, numbered, scene.parts));
  scene.parts[number] = scene_part(placed);
  if (placed.absent) return number;
  const SceneCloud& cloud = *placed.cloud;
  const std::size_t before = scene.size(), count = count_of(placed);
  scene.point.resize(before + count), scene.normal.resize(before + count);
  place_surfels(placed, before, scene);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = surfel_number(placed, k);
    scene.area.push_back(cloud.area[i]);
    scene.material.push_back(material[cloud.material[i]]);
    scene.id.push_back(placed.captured ? cloud.id[i] : static_cast<std::uint32_t>(i));
  }
  add_heights(placed, before, scene);
  scene.part.resize(before + count, number);
  scene.normals_oriented = scene.normals_oriented && cloud.normals_oriented;
  return number;
}

SceneCloud merge_list(const PartList& list, std::span<const Material> materials, std::span<const PlacedPart> numbered,
                      const char* who) {
  SceneCloud scene;
  scene.origin = origin_of(list);
  scene.materials.clear();
  for (const Material& material : materials) material_index(material, scene.materials, who);
  for (const PlacedPart& part : numbered)
    scene.parts.push_back(scene_part({.name = part.name, .label = part.label, .absent = true, .key = part.key}));
  std::size_t surfels = 0;
  for (const PlacedPart* part : list) surfels += count_of(*part);
  reserve_surfels(surfels, scene);
  WholeScene whole;
  bool is_part = false;
  for (const PlacedPart* part : list) {
    append_part(*part, numbered.size(), scene, who);
    if (part->absent) continue;
    whole = together(whole, whole_of(*part->cloud));
    is_part = is_part || part->cloud->part_of;
  }
  require_distinct(scene.parts, who);
  if (scene.materials.empty()) scene.materials = {Material{}};
  if (is_part) whole.fastest = whole_of(scene).fastest, scene.part_of = whole;
  return scene;
}

SceneCloud merge_parts(std::span<const PlacedPart> parts, std::span<const Material> materials) {
  constexpr const char* who = "merge_parts";
  return merge_list(by_name(parts, who), materials, {}, who);
}

}  // namespace insonify
