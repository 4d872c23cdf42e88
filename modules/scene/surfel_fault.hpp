// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// A value of a surfel that require_valid refuses.
struct SurfelFault {
  std::size_t surfel = 0;
  const char* array = "";   ///< name of the array in SceneCloud
  std::string what;         ///< the value with its unit, and the rule: " = -1 m^2, must be finite and >= 0"
  const char* remedy = "";  ///< advice to the maker of the scene: "; remove such points"
};

/// Returns the first fault of surfels [begin, end) of a scene with this number of materials; nothing if there is none.
std::optional<SurfelFault> find_fault(const SceneCloud& scene, std::size_t begin, std::size_t end,
                                      std::size_t materials);

}  // namespace insonify
