// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "view/placed_text.hpp"
#include "view/show_scene.hpp"

namespace insonify {

/// Returns the side of each surfel's square [m]: sqrt(area), at most 2.5 medians; the median where the area is 0.
std::vector<float> surfel_sides(const SceneCloud& scene);

/// Returns about `most` of the surfels, or all of fewer, ascending: chosen by id alone, evenly over the scene.
std::vector<std::uint32_t> drawn_surfels(const SceneCloud& scene, std::size_t most);

/// Window and position for picking surfels.
struct PickingWindow {
  Eigen::Matrix4d clip_from_scene;  ///< clip coordinates of a position relative to scene.origin
  Point2 at;                        ///< position [pixels] from its lower left corner
  double width = 0, height = 0;
  double focal_length = 1;  ///< 1 / tan(view angle / 2), times the growth of surfels
};

/// Returns the surfel whose square is frontmost at the position, otherwise among those within two pixels; the first of
/// equal ones. Does not depend on the number of threads.
std::optional<std::uint32_t> front_surfel(const SceneCloud& scene, std::span<const std::uint32_t> drawn,
                                          std::span<const float> side, const PickingWindow& window);

/// Checks the arguments of show_scene. Throws Error.
void require_drawable(const SceneCloud& scene, const SceneLook& look, const char* who);
void require_valid(const SceneHead& head, const char* who);
void require_valid(const Soundings& soundings, const char* who);
void require_surfels(std::span<const std::uint32_t> surfels, const SceneCloud& scene, const char* who);
void require_length(std::size_t length, const SceneCloud& scene, const char* name, const char* who);
void require_point_size(double point_size, const char* who);

}  // namespace insonify
