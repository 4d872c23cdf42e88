// SPDX-License-Identifier: BSD-3-Clause
#include "scene/posed_scene.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "scene/merge_parts_internal.hpp"
#include "scene/placed_block_internal.hpp"
#include "scene/posed_scene_internal.hpp"

namespace insonify {
namespace {

/// Returns an upper bound of the speed of a part's surfels [m/s].
double fastest_of(const PlacedPart& placed, std::span<const SurfelBlock> blocks) {
  double arm = 0;
  for (const SurfelBlock& b : blocks)
    arm = std::max(arm, (placed.cloud->origin + b.centre.cast<double>()).norm() + b.radius);
  return placed.velocity.norm() + placed.turn_rate.norm() * arm;
}

/// Returns true if two parts have the same surfels of the same class.
bool same_surfels(const PlacedPart& a, const PlacedPart& b) {
  return a.name == b.name && a.label == b.label && a.absent == b.absent && a.captured == b.captured && a.key == b.key &&
         a.cloud == b.cloud && a.surfels == b.surfels;
}

bool same_position(const PlacedPart& a, const PlacedPart& b) {
  return a.world_from_part.matrix() == b.world_from_part.matrix() && a.velocity == b.velocity &&
         a.turn_rate == b.turn_rate && a.file_origin == b.file_origin && a.scale == b.scale && a.size == b.size;
}

/// Returns the part as one that is listed, but not there.
PlacedPart absent_of(const PlacedPart& part) {
  return {.name = part.name, .label = part.label, .absent = true, .key = part.key};
}

template <typename Values>
void erase_range(Values& values, std::size_t first, std::size_t end) {
  if (values.size() < end) return;  // the scene lacks this property
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(first), values.begin() + static_cast<std::ptrdiff_t>(end));
}

template <typename Values>
void cut_to(Values& values, std::size_t size) {
  if (values.size() > size) values.resize(size);
}

}  // namespace

PosedScene::State::State(std::shared_ptr<SceneCloud> of, std::size_t named, int threads)
    : scene(std::move(of)),
      prepared(std::shared_ptr<const SceneCloud>(scene), threads),
      resting{scene->size(), prepared.blocks().size(), scene->materials.size(), scene->parts.size()},
      whole(prepared.whole()),
      numbered(named),
      oriented(scene->normals_oriented),
      noisy(!scene->noise.empty()),
      uneven(!scene->unevenness.empty()) {}

std::shared_ptr<const PreparedScene> PosedScene::State::body_of(const PlacedPart& part) {
  if (!part.surfels.empty()) return std::make_shared<PreparedScene>(subset(*part.cloud, part.surfels), 1);
  std::shared_ptr<const PreparedScene>& body = bodies[part.cloud];
  if (!body) body = std::make_shared<PreparedScene>(part.cloud, 1);
  return body;
}

void PosedScene::State::cut(std::size_t kept) {
  if (kept == placed.size()) return;
  up_to_date = false;
  const Sizes& to = kept == 0 ? resting : placed[kept].from;
  SceneCloud& s = *scene;
  cut_to(s.point, to.surfels), cut_to(s.normal, to.surfels), cut_to(s.area, to.surfels);
  cut_to(s.material, to.surfels), cut_to(s.id, to.surfels), cut_to(s.part, to.surfels);
  cut_to(s.noise, kept == 0 && !noisy ? 0 : to.surfels), cut_to(s.unevenness, kept == 0 && !uneven ? 0 : to.surfels);
  for (std::size_t k = kept; k < placed.size(); ++k)
    if (const Placed& gone = placed[k]; gone.number < numbered) s.parts[gone.number] = scene_part(absent_of(gone.part));
  s.parts.resize(to.parts), s.materials.resize(std::max(to.materials, table));
  prepared.order_.resize(to.surfels), prepared.blocks_.resize(to.blocks);
  placed.resize(kept);
}

void PosedScene::State::append(const PlacedPart& part, const char* who) {
  up_to_date = false;
  const Sizes from{scene->size(), prepared.blocks_.size(), scene->materials.size(), scene->parts.size()};
  const std::shared_ptr<const PreparedScene> body = part.absent ? nullptr : body_of(part);
  const std::uint16_t number = append_part(part, numbered, *scene, who);
  placed.push_back({part, number, from, body});
  if (!body) return;
  const PosedBlocks blocks[] = {{body, scene_from_cloud(*scene, part)}};
  prepared.replace_others(from.surfels, from.blocks, whole, blocks);
}

void PosedScene::State::move(std::size_t k, const PlacedPart& part) {
  Placed& there = placed[k];
  up_to_date = false;
  there.part = part;
  scene->parts[there.number] = scene_part(part);
  if (!there.body) return;
  place_surfels(part, there.from.surfels, *scene);
  const Eigen::Isometry3d turn = scene_from_cloud(*scene, part);
  const auto first = static_cast<std::uint32_t>(there.from.surfels);
  const auto own = there.body->blocks();
  for (std::size_t b = 0; b < own.size(); ++b)
    prepared.blocks_[there.from.blocks + b] = placed_block(own[b], turn, first);
}

void PosedScene::State::remove(std::size_t k, const PlacedPart& absent) {
  up_to_date = false;
  Placed& there = placed[k];
  const std::size_t first = there.from.surfels, count = there.body->scene().size(), end = first + count;
  const std::size_t first_block = there.from.blocks, blocks = there.body->blocks().size();
  SceneCloud& s = *scene;
  erase_range(s.point, first, end), erase_range(s.normal, first, end), erase_range(s.area, first, end);
  erase_range(s.material, first, end), erase_range(s.id, first, end), erase_range(s.part, first, end);
  erase_range(s.noise, first, end), erase_range(s.unevenness, first, end);
  erase_range(prepared.order_, first, end), erase_range(prepared.blocks_, first_block, first_block + blocks);
  const auto less = static_cast<std::uint32_t>(count);
  for (std::size_t i = first; i < prepared.order_.size(); ++i) prepared.order_[i] -= less;
  for (std::size_t b = first_block; b < prepared.blocks_.size(); ++b)
    prepared.blocks_[b].begin -= less, prepared.blocks_[b].end -= less;
  for (std::size_t j = k + 1; j < placed.size(); ++j) placed[j].from.surfels -= count, placed[j].from.blocks -= blocks;
  s.parts[there.number] = scene_part(absent);
  there.part = absent, there.body = nullptr;
}

void PosedScene::State::set_table(std::span<const Material> more) {
  std::vector<Material>& materials = scene->materials;
  if (more.empty() && materials.size() == resting.materials) return;  // the parts add none
  const std::size_t had = std::min(materials.size() - resting.materials, more.size());
  const bool agrees = std::equal(more.begin(), more.begin() + static_cast<std::ptrdiff_t>(had),
                                 materials.begin() + static_cast<std::ptrdiff_t>(resting.materials));
  if (!agrees || more.empty()) table = resting.materials, cut(0), materials.resize(table);
  for (std::size_t m = materials.size() - resting.materials; m < more.size(); ++m) materials.push_back(more[m]);
  table = resting.materials + more.size();
}

void PosedScene::State::pose(const PartList& list, std::span<const Material> more, const char* who) {
  set_table(more);
  // The origin of a scene without resting parts is near the first one.
  if (resting.surfels == 0) cut(0), scene->origin = origin_of(list);
  std::size_t new_surfels = 0;
  for (const PlacedPart* part : list) new_surfels += count_of(*part);
  reserve_surfels(resting.surfels + new_surfels - std::min(scene->size(), resting.surfels + new_surfels), *scene);
  for (std::size_t k = 0; k < list.size(); ++k) {
    const PlacedPart& part = *list[k];
    if (k < placed.size()) {
      const PlacedPart& there = placed[k].part;
      if (same_surfels(there, part)) {
        if (!same_position(there, part)) move(k, part);
        continue;
      }
      if (there.name == part.name && part.absent) {
        remove(k, part);
        continue;
      }
      cut(k);
    }
    append(part, who);
  }
  cut(list.size());
  if (!up_to_date) update(who);
}

void PosedScene::State::update(const char* who) {
  require_distinct(scene->parts, who);
  WholeScene all = whole;
  double fastest = whole.fastest;
  scene->normals_oriented = oriented;
  for (const Placed& there : placed) {
    if (!there.body) continue;
    all = together(all, there.body->whole());
    if (there.part.moves()) fastest = std::max(fastest, fastest_of(there.part, there.body->blocks()));
    scene->normals_oriented = scene->normals_oriented && there.part.cloud->normals_oriented;
  }
  all.fastest = fastest;
  prepared.replace_others(scene->size(), prepared.blocks_.size(), all, {});
  // Forget bodies that are not there anymore: bodies drawn anew, each of its own size, would fill the memory.
  std::erase_if(bodies, [&](const auto& body) {
    return std::ranges::none_of(placed, [&](const Placed& there) { return there.part.cloud == body.first; });
  });
  up_to_date = true;
}

PosedScene::PosedScene(std::span<const PlacedPart> resting, std::span<const Material> materials, int threads) {
  auto scene = std::make_shared<SceneCloud>(merge_parts(resting, materials));
  state_ = std::make_unique<State>(std::move(scene), 0, threads);
}

PosedScene::PosedScene(Made, std::unique_ptr<State> state) : state_(std::move(state)) {}
PosedScene::~PosedScene() = default;
PosedScene::PosedScene(PosedScene&&) noexcept = default;
PosedScene& PosedScene::operator=(PosedScene&&) noexcept = default;

std::shared_ptr<const PreparedScene> PosedScene::pose(std::span<const PlacedPart> others) {
  constexpr const char* who = "PosedScene";
  state_->pose(by_name(others, who), {}, who);
  return {std::shared_ptr<const void>(), &state_->prepared};
}

}  // namespace insonify
