// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "run_scenes/run_folder.hpp"

namespace insonify::tool {

/// The pictures of run folders, by VTK.
class VtkPictures : public RunPictures {
 public:
  void draw_fan(const Ping& ping, const std::string& title, const std::string& path) const override;
  void write_paths(const SoundPaths& paths, const std::string& path) const override;
};

}  // namespace insonify::tool
