// SPDX-License-Identifier: BSD-3-Clause
#include "scene/posed_scene.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "core/error.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t most_parts_of_scene = 65000;

using PartList = std::vector<const PlacedPart*>;

/// Returns the parts, sorted by name. Throws Error(argument) for invalid parts and for two of one name.
PartList by_name(std::span<const PlacedPart> parts, const char* who) {
  PartList list;
  for (const PlacedPart& part : parts) {
    require_valid(part, who);
    list.push_back(&part);
  }
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

/// Returns the index of a material in the table. A new material is appended.
std::uint16_t index_of(const Material& material, std::vector<Material>& table, const char* who) {
  const auto at = std::find(table.begin(), table.end(), material);
  if (at == table.end()) {
    if (table.size() >= 0xffff) fail(ErrorKind::argument, who, ": more than 65535 different materials");
    table.push_back(material);
    return static_cast<std::uint16_t>(table.size() - 1);
  }
  return static_cast<std::uint16_t>(at - table.begin());
}

/// Returns the origin of the scene: that of the first captured part, otherwise a point near the first part.
Vector3d origin_of(const PartList& parts) {
  for (const PlacedPart* part : parts)
    if (part->captured && !part->absent) return part->cloud->origin;
  return parts.empty() ? Vector3d(Vector3d::Zero())
                       : Vector3d(parts.front()->world_from_part.translation().array().round());
}

double mean_spacing_of(const SceneCloud& cloud) { return whole_of(cloud).mean_spacing; }

Vector3d size_of(const PlacedPart& placed) {
  if (placed.captured || !placed.size.isZero(0)) return placed.size;
  const Bounds box = bounds(*placed.cloud);
  return box.max - box.min;
}

ScenePart scene_part(const PlacedPart& placed) {
  if (placed.absent) return {.name = placed.name, .label = placed.label, .key = part_key(placed.name)};
  return {.name = placed.name,
          .label = placed.label,
          .key = part_key(placed.name),
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

/// Returns the pose that maps the cloud's coordinates to the scene's, each relative to its origin.
Eigen::Isometry3d scene_from_cloud(const SceneCloud& scene, const PlacedPart& placed) {
  Eigen::Isometry3d turn = placed.world_from_part;
  turn.translation() += placed.world_from_part.linear() * placed.cloud->origin - scene.origin;
  return turn;
}

/// Appends noise and unevenness of a part's surfels if this part or one before has them.
void add_heights(const PlacedPart& placed, std::size_t before, SceneCloud& scene) {
  const SceneCloud& cloud = *placed.cloud;
  const auto spacing = [&](std::size_t i) { return std::sqrt(static_cast<double>(scene.area[i])); };
  const auto number = [&](std::size_t i) { return placed.surfels.empty() ? i - before : placed.surfels[i - before]; };
  if (!scene.noise.empty() || !cloud.noise.empty()) {
    scene.noise.resize(scene.size(), 0);
    for (std::size_t i = before; i < scene.size() && !cloud.noise.empty(); ++i) scene.noise[i] = cloud.noise[number(i)];
  }
  if (scene.unevenness.empty() && cloud.unevenness.empty()) return;
  for (std::size_t i = scene.unevenness.size(); i < scene.size(); ++i)
    scene.unevenness.push_back(i >= before && !cloud.unevenness.empty() ? cloud.unevenness[number(i)]
                                                                        : static_cast<float>(spacing(i)));
}

/// Reserves memory for `more` surfels.
void reserve(std::size_t more, SceneCloud& scene) {
  const std::size_t all = scene.size() + more;
  scene.point.reserve(all), scene.normal.reserve(all), scene.area.reserve(all), scene.material.reserve(all);
  scene.id.reserve(all), scene.part.reserve(all);
}

/// Returns the number of surfels of all parts.
std::size_t surfels_of(const PartList& list) {
  std::size_t sum = 0;
  for (const PlacedPart* part : list)
    if (!part->absent) sum += part->surfels.empty() ? part->cloud->size() : part->surfels.size();
  return sum;
}

/// Appends the surfels of a part.
void append(const PlacedPart& placed, SceneCloud& scene, const char* who) {
  const auto number = static_cast<std::uint16_t>(scene.parts.size());
  scene.parts.push_back(scene_part(placed));
  if (placed.absent) return;
  const SceneCloud& cloud = *placed.cloud;
  std::vector<std::uint16_t> material;
  for (const Material& m : cloud.materials) material.push_back(index_of(m, scene.materials, who));
  const Eigen::Isometry3d to_scene = scene_from_cloud(scene, placed);
  const bool as_it_is = placed.captured && cloud.origin == scene.origin;
  const std::size_t before = scene.size(), count = placed.surfels.empty() ? cloud.size() : placed.surfels.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = placed.surfels.empty() ? k : placed.surfels[k];
    scene.point.push_back(as_it_is ? cloud.point[i] : (to_scene * cloud.point[i].cast<double>()).cast<float>());
    scene.normal.push_back(placed.captured ? cloud.normal[i]
                                           : (to_scene.linear() * cloud.normal[i].cast<double>()).cast<float>());
    scene.area.push_back(cloud.area[i]);
    scene.material.push_back(material[cloud.material[i]]);
    scene.id.push_back(placed.captured ? cloud.id[i] : static_cast<std::uint32_t>(i));
  }
  add_heights(placed, before, scene);
  scene.part.resize(before + count, number);
  scene.normals_oriented = scene.normals_oriented && cloud.normals_oriented;
}

/// Returns a scene of parts without surfels.
SceneCloud empty_scene(const Vector3d& origin) {
  SceneCloud scene;
  scene.origin = origin;
  scene.materials.clear();
  return scene;
}

/// Returns an upper bound of the speed of a part's surfels [m/s].
double fastest_of(const PlacedPart& placed, const SurfelBlock* begin, const SurfelBlock* end) {
  double arm = 0;
  for (const SurfelBlock* b = begin; b != end; ++b)
    arm = std::max(arm, (placed.cloud->origin + b->centre.cast<double>()).norm() + b->radius);
  return placed.velocity.norm() + placed.turn_rate.norm() * arm;
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

SceneCloud merge_parts(std::span<const PlacedPart> parts, std::span<const Material> materials) {
  constexpr const char* who = "merge_parts";
  const PartList list = by_name(parts, who);
  SceneCloud scene = empty_scene(origin_of(list));
  for (const Material& material : materials) index_of(material, scene.materials, who);
  reserve(surfels_of(list), scene);
  WholeScene whole;
  bool is_part = false;
  for (const PlacedPart* part : list) {
    append(*part, scene, who);
    if (part->absent) continue;
    whole = together(whole, whole_of(*part->cloud));
    is_part = is_part || part->cloud->part_of;
  }
  require_distinct(scene.parts, who);
  if (scene.materials.empty()) scene.materials = {Material{}};
  if (is_part) whole.fastest = whole_of(scene).fastest, scene.part_of = whole;
  return scene;
}

struct PosedScene::State {
  std::shared_ptr<SceneCloud> scene;
  PreparedScene prepared;
  std::size_t surfels, blocks, materials, parts;  // sizes of the resting scene
  WholeScene resting;
  bool oriented, noisy, uneven;
  std::map<std::shared_ptr<const SceneCloud>, std::shared_ptr<const PreparedScene>> bodies{};

  State(std::shared_ptr<SceneCloud> of, int threads)
      : scene(std::move(of)),
        prepared(std::shared_ptr<const SceneCloud>(scene), threads),
        surfels(scene->size()),
        blocks(prepared.blocks().size()),
        materials(scene->materials.size()),
        parts(scene->parts.size()),
        resting(prepared.whole()),
        oriented(scene->normals_oriented),
        noisy(!scene->noise.empty()),
        uneven(!scene->unevenness.empty()) {}

  /// Truncates the scene to its resting parts.
  void forget_others() {
    SceneCloud& s = *scene;
    for (auto* array : {&s.point, &s.normal}) array->resize(surfels);
    s.area.resize(surfels), s.noise.resize(noisy ? surfels : 0), s.unevenness.resize(uneven ? surfels : 0);
    for (auto* array : {&s.material, &s.part}) array->resize(surfels);
    s.id.resize(surfels);
    s.parts.resize(parts), s.materials.resize(materials);
    s.normals_oriented = oriented;
  }

  /// Returns the blocks of a part in its own axes. They are cached unless surfels of the part are left out.
  std::shared_ptr<const PreparedScene> body_of(const PlacedPart& placed) {
    if (!placed.surfels.empty()) return std::make_shared<PreparedScene>(subset(*placed.cloud, placed.surfels), 1);
    std::shared_ptr<const PreparedScene>& body = bodies[placed.cloud];
    if (!body) body = std::make_shared<PreparedScene>(placed.cloud, 1);
    return body;
  }
};

PosedScene::PosedScene(std::span<const PlacedPart> resting, std::span<const Material> materials, int threads) {
  auto scene = std::make_shared<SceneCloud>(merge_parts(resting, materials));
  state_ = std::make_unique<State>(std::move(scene), threads);
}

PosedScene::~PosedScene() = default;
PosedScene::PosedScene(PosedScene&&) noexcept = default;
PosedScene& PosedScene::operator=(PosedScene&&) noexcept = default;

std::shared_ptr<const PreparedScene> PosedScene::pose(std::span<const PlacedPart> others) {
  constexpr const char* who = "PosedScene";
  State& state = *state_;
  const PartList list = by_name(others, who);
  state.forget_others();
  reserve(surfels_of(list), *state.scene);
  if (state.surfels == 0) state.scene->origin = origin_of(list);
  std::vector<PosedBlocks> blocks;
  double fastest = state.resting.fastest;
  for (const PlacedPart* placed : list) {
    append(*placed, *state.scene, who);
    if (placed->absent) continue;
    const std::shared_ptr<const PreparedScene> body = state.body_of(*placed);
    blocks.push_back({body, scene_from_cloud(*state.scene, *placed)});
    const auto of_body = body->blocks();
    if (placed->moves())
      fastest = std::max(fastest, fastest_of(*placed, of_body.data(), of_body.data() + of_body.size()));
  }
  // Forget bodies that are not in the list: bodies drawn anew, each of its own size, would fill the memory.
  std::erase_if(state.bodies, [&](const auto& body) {
    return std::ranges::none_of(list, [&](const PlacedPart* placed) { return placed->cloud == body.first; });
  });
  require_distinct(state.scene->parts, who);
  state.prepared.replace_others(state.surfels, state.blocks, state.resting, blocks);
  state.prepared.whole_.fastest = fastest;
  return {std::shared_ptr<const void>(), &state.prepared};
}

}  // namespace insonify
