// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/direct_stream.hpp"

#include <algorithm>

#include "acoustics/direct_echoes.hpp"
#include "acoustics/moving_parts.hpp"

namespace insonify {
namespace {

constexpr std::size_t chunk_pieces = 2048;  // with their echoes they fit into the cache of a core

void keep_wanted(const EchoSink& sink, const VisibleSurfels& visible, std::span<const std::uint32_t> which,
                 Scatterers& patches) {
  const auto for_each_array = [&patches](const auto& use) {
    Scatterers& s = patches;
    use(s.range), use(s.azimuth), use(s.elevation), use(s.cos_incidence), use(s.projected_area), use(s.material);
    use(s.id), use(s.surfel);
  };
  std::size_t at = 0, kept = 0;
  for (const std::uint32_t k : which) {
    SurfelBounds bounds = visible.bounds[k];
    bounds.reach = 0;
    for (std::size_t end = at + visible.first[k + 1] - visible.first[k]; at < end; ++at) {
      bounds.range = patches.range[at];
      if (sink.wants(bounds)) for_each_array([&](auto& a) { a[kept] = a[at]; }), ++kept;
    }
  }
  for_each_array([&](auto& array) { array.resize(kept); });
}

}  // namespace

Echoes echoes_in_motion(const SceneCloud& scene, Scatterers& patches, const Pose& world_from_head,
                        const MovingScene& moving, const Transmission& sent) {
  const double frequency = sent.pulse.centre_frequency, c = sent.medium.sound_speed;
  std::vector<Eigen::Vector3d> velocity;
  if (moving.parts) velocity = meet_moving_parts(scene, world_from_head, c, patches);
  Echoes echoes = direct_echoes(patches, scene.materials, sent);
  if (!moving.head.none()) move_echoes(moving.head, world_from_head, patches, frequency, c, echoes);
  shift_by_parts(velocity, moving.head, world_from_head, patches, frequency, c, echoes);
  return echoes;
}

void widen_bounds(const SceneCloud& scene, const MovingScene& moving, double fastest_part, double c,
                  VisibleSurfels& visible) {
  if (!moving.any()) return;
  const double by_head = most_displacement(moving.head, c), turn = moving.head.turn_rate.norm();
  const double by_parts = moving.parts ? most_displacement(Motion{{fastest_part, 0, 0}, {}}, c) : 0;
  for (std::size_t k = 0; k < visible.bounds.size(); ++k) {
    SurfelBounds& s = visible.bounds[k];
    const ScenePart* part = scene.part_of_surfel(visible.surfel[k]);
    const double displaced = by_head + (part && part->moves() ? by_parts : 0);
    s.reach += displaced * (s.range + s.reach);
    s.reach_u += 3 * displaced + turn * 2 * (s.range + s.reach) / c;
  }
}

DirectStream::DirectStream(const SceneCloud& scene, const VisibleSurfels& visible, const Pose& world_from_head,
                           const MovingScene& moving, const Transmission& sent)
    : scene_(scene), visible_(visible), world_from_head_(world_from_head), moving_(moving), sent_(sent) {
  sent_.echo_options.threads = 1;
  sent_.surfaces = surfaces_of(sent, scene.materials);
  for (std::uint32_t k = 0; k < visible.surfel.size(); ++k) {
    const SurfelBounds& s = visible.bounds[k];
    if (first_surfel_.back() == k) chunks_.push_back({0, s.range - s.reach, s.range + s.reach});
    ChunkBounds& chunk = chunks_.back();
    chunk.size += visible.first[k + 1] - visible.first[k];
    chunk.min_range = std::min(chunk.min_range, s.range - s.reach);
    chunk.max_range = std::max(chunk.max_range, s.range + s.reach);
    if (chunk.size >= chunk_pieces || k + 1 == visible.surfel.size()) first_surfel_.push_back(k + 1);
  }
}

void DirectStream::visit(std::size_t chunk, EchoSink& sink) const {
  std::vector<std::uint32_t> which;
  for (std::uint32_t k = first_surfel_[chunk]; k < first_surfel_[chunk + 1]; ++k)
    if (sink.wants(visible_.bounds[k])) which.push_back(k);
  if (which.empty()) return;
  Scatterers patches = make_chunks(scene_, world_from_head_, visible_, which, 1);
  if (sink.chooses_patches()) keep_wanted(sink, visible_, which, patches);
  const Echoes echoes = echoes_in_motion(scene_, patches, world_from_head_, moving_, sent_);
  sink.take(patches, echoes);
}

}  // namespace insonify
