// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/geodesy.hpp"
#include "tool/command/option_list.hpp"

namespace insonify::tool {

/// The position of a world on the globe that options ask for; empty: as its run says.
struct WorldOptions {
  std::string anchor, utm, system;

  /// Returns whether nothing is asked.
  bool empty() const { return anchor.empty() && utm.empty() && system.empty(); }
};

/// Adds --anchor, --utm and --system.
void add_world_options(OptionList list, WorldOptions& requested);

/// The place of the world of a run, as far as the run knows it.
struct KnownWorld {
  std::string run;     ///< its path, for messages
  std::string system;  ///< system of its mission or of the file of its scene, as FileMeaning has it; or empty
  std::optional<Anchor> anchor{};  ///< anchor of its mission; absent: none
};

/// Writes scene.json into the folder of a survey, if the system of its scene is known.
void record_system(const std::string& folder, const std::string& system);

/// Throws Error(content) "path: ..." if a mission with this anchor or system contradicts the system of its scene.
void require_same_system(const std::string& path, const std::optional<Anchor>& anchor, const std::string& system,
                         const std::string& of_scene);

/// Returns where the world is, as asked or as the run says; absent if neither says it. Throws Error(argument) if what
/// is asked contradicts the run, and if one of `positions`, points of the world [m], cannot be there (require_plausible).
std::optional<Georeference> georeference_of(const WorldOptions& requested, const KnownWorld& known,
                                            const std::vector<Eigen::Vector3d>& positions);

/// Returns what to say of --utm: that S is the hemisphere and not the band of MGRS; else nothing.
std::string utm_note(const WorldOptions& requested, const KnownWorld& known);

}  // namespace insonify::tool
