// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "scene/prepared_scene.hpp"
#include "simulate/ping_simulator.hpp"

namespace insonify {

/// Where pings get their scene from: one in memory, or what each ping needs of a larger one.
class SceneSource {
 public:
  virtual ~SceneSource() = default;
  /// Returns a scene that gives this ping: all of it, or at least what simulator.reach names. May be called by several
  /// threads at once.
  virtual std::shared_ptr<const PreparedScene> scene_for(const PingSimulator& simulator,
                                                         const PingEvent& event) const = 0;
};

/// The same scene for every ping.
class SceneInMemory : public SceneSource {
 public:
  /// Throws Error for an invalid scene. threads: 0: all cores.
  explicit SceneInMemory(SceneCloud scene, int threads = 0)
      : scene_(std::make_shared<PreparedScene>(std::move(scene), threads)) {}
  /// Returns that scene.
  std::shared_ptr<const PreparedScene> scene_for(const PingSimulator&, const PingEvent&) const override {
    return scene_;
  }

 private:
  std::shared_ptr<const PreparedScene> scene_;
};

}  // namespace insonify
