// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "scene/posed_pool.hpp"
#include "scene/posed_scene_internal.hpp"

namespace insonify {
namespace {

/// Adds what a table lacks.
void add_materials(std::span<const Material> materials, std::span<const Material> before,
                   std::vector<Material>& table) {
  for (const Material& material : materials)
    if (std::ranges::find(before, material) == before.end() && std::ranges::find(table, material) == table.end())
      table.push_back(material);
}

/// Returns the materials by whose numbers the classes of a part count: that of its label first.
std::vector<Material> classes_of_part(const PlacedPart& part, std::span<const Material> known) {
  std::vector<Material> materials = part.absent ? std::vector<Material>{} : part.cloud->materials;
  if (part.label.empty()) return materials;
  const auto has_label = [&](std::span<const Material> table) {
    return std::ranges::find(table, part.label, &Material::name) != table.end();
  };
  if (!has_label(known) && !has_label(materials)) materials.insert(materials.begin(), Material{.name = part.label});
  return materials;
}

}  // namespace

/// Parts and materials that do not change: the captured parts, the names of the first ids, and the scenes in use.
struct EditedScene::Start {
  std::vector<PlacedPart> parts;  ///< those of the beginning, by name
  std::vector<Material> materials;
  std::vector<std::size_t> others{};  ///< places in `parts` of those that are not captured
  PosedPool<std::shared_ptr<const SceneArrangement>> pool;

  Start(std::vector<PlacedPart> of, std::vector<Material> table, int threads)
      : parts(std::move(of)), materials(std::move(table)), pool([this, threads] { return make(threads); }) {}

  std::unique_ptr<PosedScene> make(int threads) const {
    PartList resting;
    for (const PlacedPart& part : parts)
      if (part.captured) resting.push_back(&part);
    auto scene = std::make_shared<SceneCloud>(merge_list(resting, materials, parts, "EditedScene"));
    reserve_surfels(scene->size() / 4, *scene);  // so that the first parts do not copy the scene
    return std::unique_ptr<PosedScene>(
        new PosedScene({}, std::make_unique<PosedScene::State>(std::move(scene), parts.size(), threads)));
  }
};

EditedScene::EditedScene(std::vector<PlacedPart> parts, std::span<const Material> materials, int threads) {
  constexpr const char* who = "EditedScene";
  std::vector<PlacedPart> sorted;
  for (const PlacedPart* part : by_name(parts, who)) sorted.push_back(*part);
  std::vector<Material> table(materials.begin(), materials.end());
  for (const PlacedPart& part : sorted)
    if (part.captured && !part.absent) add_materials(part.cloud->materials, {}, table);
  start_ = std::make_shared<Start>(std::move(sorted), std::move(table), threads);
  auto arrangement = std::make_shared<SceneArrangement>();
  for (std::size_t p = 0; p < start_->parts.size(); ++p) {
    const PlacedPart& part = start_->parts[p];
    if (part.captured) continue;
    start_->others.push_back(p);
    arrangement->parts.push_back(part);
    add_materials(classes_of_part(part, start_->materials), start_->materials, arrangement->materials);
  }
  start_->pool.prepare();
  now_ = std::move(arrangement);
}

PlacedPart& EditedScene::part_of(std::uint32_t id, SceneArrangement& in, const char* who) const {
  const std::size_t first = start_->parts.size(), most = first + in.parts.size() - start_->others.size();
  if (id < 1 || id > most) fail(ErrorKind::argument, who, ": no part has the id ", id, "; ids are 1 to ", most);
  std::size_t position = id - 1 - first + start_->others.size();
  if (id <= first) {
    if (start_->parts[id - 1].captured)
      fail(ErrorKind::argument, who, ": part ", id, ", '", start_->parts[id - 1].name,
           "', stands as captured, and is neither moved nor removed");
    position = static_cast<std::size_t>(std::ranges::find(start_->others, id - 1) - start_->others.begin());
  }
  PlacedPart& part = in.parts[position];
  if (part.absent) fail(ErrorKind::argument, who, ": part ", id, ", '", part.name, "', is not in the scene");
  return part;
}

std::uint32_t EditedScene::add(PlacedPart part) {
  constexpr const char* who = "EditedScene::add";
  require_valid(part, who);
  if (part.absent || part.captured)
    fail(ErrorKind::argument, who, ": part '", part.name, "': must neither be absent nor captured");
  auto next = std::make_shared<SceneArrangement>(*now_);
  add_materials(classes_of_part(part, start_->materials), start_->materials, next->materials);
  const auto is_named = [&](const PlacedPart& other) { return other.name == part.name; };
  const auto twin = std::ranges::find_if(next->parts, is_named);
  const auto first = std::ranges::find_if(start_->parts, is_named);
  if ((twin == next->parts.end() && first != start_->parts.end()) || (twin != next->parts.end() && !twin->absent))
    fail(ErrorKind::argument, who, ": two parts are called '", part.name, "'; give each a name of its own");
  std::size_t id = 0;
  if (first != start_->parts.end()) {
    id = static_cast<std::size_t>(first - start_->parts.begin()) + 1;
  } else {
    id = start_->parts.size() + static_cast<std::size_t>(twin - next->parts.begin()) - start_->others.size() + 1;
  }
  if (twin == next->parts.end())
    next->parts.push_back(std::move(part));
  else
    *twin = std::move(part);
  now_ = std::move(next);
  return static_cast<std::uint32_t>(id);
}

void EditedScene::move(std::uint32_t id, const Pose& world_from_file, const Eigen::Vector3d& velocity,
                       const Eigen::Vector3d& turn_rate) {
  constexpr const char* who = "EditedScene::move";
  auto next = std::make_shared<SceneArrangement>(*now_);
  PlacedPart& part = part_of(id, *next, who);
  part.place_file(world_from_file, velocity, turn_rate);
  require_valid(part, who);
  now_ = std::move(next);
}

void EditedScene::remove(std::uint32_t id) {
  auto next = std::make_shared<SceneArrangement>(*now_);
  PlacedPart& part = part_of(id, *next, "EditedScene::remove");
  part = {.name = part.name, .label = part.label, .absent = true, .key = part.key};
  now_ = std::move(next);
}

std::shared_ptr<const PreparedScene> EditedScene::scene_of(std::shared_ptr<const SceneArrangement> arrangement) const {
  constexpr const char* who = "EditedScene";
  return start_->pool.scene_of(arrangement, [&](PosedScene& posed) -> std::shared_ptr<const PreparedScene> {
    posed.state_->pose(list_of(arrangement->parts, who), arrangement->materials, who);
    return {std::shared_ptr<const void>(), &posed.state_->prepared};
  });
}

}  // namespace insonify
