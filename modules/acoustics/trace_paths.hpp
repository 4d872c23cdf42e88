// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/multipath_echoes.hpp"
#include "acoustics/sound_paths.hpp"

namespace insonify {

/// Returns the paths of the strongest direct echo in each of `count` equal intervals of u, out and back by a straight
/// line. `echoes` are those of `scatterers`, index by index; where rays are bent, the line ends at the apparent position
/// of the patch. Throws Error unless count >= 1.
SoundPaths direct_paths(const Scatterers& scatterers, const Echoes& echoes, const Pose& world_from_head,
                        const Medium& medium, std::size_t count);

/// Returns the same for echoes by way of boundaries, for each pair of legs out and back: they bounce where the line
/// from the head to the surfel's image meets the boundary (E48).
SoundPaths multipath_paths(const Multipath& multipath, const SceneCloud& scene, const View& view, const Medium& medium,
                           std::size_t count);

}  // namespace insonify
