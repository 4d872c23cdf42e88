// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "scene/prepared_scene.hpp"
#include "simulate/ping_simulator.hpp"

namespace insonify {

/// The source of one scene for all pings.
class SceneInMemory : public SceneSource {
 public:
  /// Prepares the scene with `threads` threads (0: all cores). Throws Error for an invalid scene.
  explicit SceneInMemory(SceneCloud scene, int threads = 0)
      : scene_(std::make_shared<PreparedScene>(std::move(scene), threads)) {}
  /// Returns the scene given to the constructor.
  std::shared_ptr<const PreparedScene> scene_for(const PingSimulator&, const PingEvent&) const override {
    return scene_;
  }

 private:
  std::shared_ptr<const PreparedScene> scene_;
};

}  // namespace insonify
