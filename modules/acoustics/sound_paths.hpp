#pragma once
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "acoustics/multipath_echoes.hpp"

namespace insonify {

/// Paths that sound took from the head to a surface and back, structure of arrays, to be looked at.
struct SoundPaths {
  std::vector<std::vector<Eigen::Vector3d>> points;  ///< head, bounce, surface, bounce, head; world [m]
  std::vector<float> level_db;                       ///< of the echo at the head [dB re 1 uPa], absorption included
  std::vector<int> bounces;                          ///< off surface and bottom: 0, 1 or 2

  /// Returns the number of paths.
  std::size_t size() const { return points.size(); }
};

/// The strongest direct echo in each of `count` equal intervals of u, out and back by a straight line. `echoes` are those
/// of `scatterers`, index by index; where rays are bent, the line ends where the patch seems to be.
/// Throws Error unless count >= 1.
SoundPaths direct_paths(const Scatterers& scatterers, const Echoes& echoes, const Pose& world_from_head,
                        const Medium& medium, std::size_t count);

/// The same of echoes by way of the boundaries, for each pair of legs out and back: they bounce where the line from the head
/// to the surfel's image meets the boundary (E48).
SoundPaths bounced_paths(const Multipath& multipath, const SceneCloud& scene, const Environment& environment,
                         const View& view, const Medium& medium, std::size_t count);

/// Adds `more` at the end of `paths`.
void append(SoundPaths& paths, const SoundPaths& more);

}  // namespace insonify
