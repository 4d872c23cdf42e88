// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "acoustics/sound_paths.hpp"
#include "returns/ping.hpp"

namespace insonify {

/// Draws the pictures of a run folder: its writer links no package that draws.
class RunPictures {
 public:
  virtual ~RunPictures() = default;
  /// Draws a ping as a fan into the PNG at `path`. Throws Error(runtime) where nothing can be drawn, Error(file).
  virtual void draw_fan(const Ping& ping, const std::string& title, const std::string& path) const = 0;
  /// Writes sound paths as lines of ParaView, with level and bounces. Throws Error(file).
  virtual void write_paths(const SoundPaths& paths, const std::string& path) const = 0;
};

}  // namespace insonify
