// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include "acoustics/echo_stream.hpp"
#include "acoustics/motion.hpp"
#include "acoustics/transmission.hpp"
#include "core/pose.hpp"
#include "sampling/visible_surfels.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Movement during a ping: of the head, and of the parts of the scene if they move.
struct MovingScene {
  Motion head{};
  bool parts = false;
  /// Returns true if anything moves.
  bool any() const { return parts || !head.none(); }
};

/// Returns the direct echoes of patches (E7) as a head in motion receives them (E44) from parts in motion (E145, E146);
/// patches of moving parts are moved to the positions at which sound meets them. Errors as direct_echoes, move_echoes and
/// meet_moving_parts.
Echoes echoes_in_motion(const SceneCloud& scene, Scatterers& patches, const Pose& world_from_head,
                        const MovingScene& moving, const Transmission& sent);

/// Widens the bounds of visible surfels to hold the apparent positions of their echoes for a moving head (E44) and for
/// moving parts (E145), whose fastest surfel has this speed [m/s].
void widen_bounds(const SceneCloud& scene, const MovingScene& moving, double fastest_part, double sound_speed,
                  VisibleSurfels& visible);

/// The direct echoes of visible surfels: chunks of neighbouring surfels, whose patches and echoes are made when they
/// are visited.
class DirectStream final : public EchoStream {
 public:
  /// Refers to scene and surfels, whose bounds must hold the motion (widen_bounds).
  DirectStream(const SceneCloud& scene, const VisibleSurfels& visible, const Pose& world_from_head,
               const MovingScene& moving, const Transmission& sent);
  /// Returns the bounds of all chunks of some 2048 patches.
  std::span<const ChunkBounds> chunks() const override { return chunks_; }
  /// Returns true if the head or parts move.
  bool moving() const override { return moving_.any(); }
  /// Makes a chunk's patches and echoes on the calling thread.
  void visit(std::size_t chunk, EchoSink& sink) const override;

 private:
  const SceneCloud& scene_;
  const VisibleSurfels& visible_;
  Pose world_from_head_;
  MovingScene moving_;
  Transmission sent_;
  std::vector<ChunkBounds> chunks_;
  std::vector<std::uint32_t> first_surfel_{0};  // of each chunk
};

}  // namespace insonify
