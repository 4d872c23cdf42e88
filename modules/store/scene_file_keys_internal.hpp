// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "store/key_table.hpp"
#include "store/scene_file.hpp"

namespace insonify {

/// Values of a scene file that the structs of parts store in another form.
struct SceneTables {
  ScenePartEntry part{};
  std::vector<double> position{}, turn{};  ///< entries of the file
  std::string rest;                        ///< "": not given
  std::string trajectory;                  ///< path
  SceneScatterEntry scatter{};
  std::vector<std::string> files{};  ///< files of the scatter, as in the file
  PartFile scatter_file{};           ///< settings for reading its files
  std::vector<double> count{}, bury{}, scale{};
  double min_distance = 0;  ///< 0: not given
};

/// Return the keys of a [[part]] and of a [[scatter]], bound to the tables.
std::vector<Key> scene_part_keys(SceneTables& tables);
std::vector<Key> scene_scatter_keys(SceneTables& tables);

}  // namespace insonify
