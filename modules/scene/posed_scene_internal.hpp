// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "scene/merge_parts_internal.hpp"
#include "scene/posed_scene.hpp"

// Private to scene: a scene whose parts change in place.
namespace insonify {

/// The resting parts of a scene, and behind them the others in a list, of which each has consecutive surfels and blocks.
struct PosedScene::State {
  /// Sizes of the scene before a part was appended.
  struct Sizes {
    std::size_t surfels = 0, blocks = 0, materials = 0, parts = 0;
  };
  /// A part of the list, and where it is in the scene.
  struct Placed {
    PlacedPart part;
    std::uint16_t number;  ///< number of the part in the scene
    Sizes from;
    std::shared_ptr<const PreparedScene> body;  ///< its blocks in its own axes; null: absent
  };

  /// Prepares a scene of resting parts; the first `named` of its parts may come later.
  State(std::shared_ptr<SceneCloud> of, std::size_t named, int threads);

  /// Has the scene hold this list of parts behind the resting ones, and this table of materials behind theirs. What
  /// agrees with the list before stays, rays and levels too if all does. A part that differs by its pose is moved in
  /// place, one that is absent is taken out; from the first other difference on all are placed anew. Throws
  /// Error(argument) as merge_parts.
  void pose(const PartList& list, std::span<const Material> more, const char* who);

  std::shared_ptr<SceneCloud> scene;
  PreparedScene prepared;
  Sizes resting;
  WholeScene whole;  ///< statistics of the resting parts
  std::size_t numbered;
  bool oriented, noisy, uneven;
  std::vector<Placed> placed{};

 private:
  /// Returns the blocks of a part in its own axes. They are cached unless surfels of the part are left out.
  std::shared_ptr<const PreparedScene> body_of(const PlacedPart& part);
  /// Leaves the first parts of the list.
  void cut(std::size_t kept);
  void append(const PlacedPart& part, const char* who);
  void move(std::size_t k, const PlacedPart& part);
  void remove(std::size_t k, const PlacedPart& absent);
  /// Has the table of materials go on with `more` behind those of the resting parts.
  void set_table(std::span<const Material> more);
  /// Sets what follows from all parts.
  void update(const char* who);

  std::size_t table = 0;   ///< materials that stay
  bool up_to_date = true;  ///< false: the list differs from the one by which update() set the rest
  std::map<std::shared_ptr<const SceneCloud>, std::shared_ptr<const PreparedScene>> bodies{};
};

}  // namespace insonify
