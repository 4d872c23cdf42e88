// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "run/options.hpp"
#include "scene/scene_cloud.hpp"

/// Facts of a file or folder for `info`, by name, and under `next` the commands that go on from there.
namespace insonify::tool {

/// Returns facts of a cube of pings, or of a run if the path of its folder is given.
nlohmann::ordered_json info_of_cube(const std::string& path);

/// Returns facts of a folder: a run, a survey, a head of one, or anything else with a manifest of insonify. Throws
/// Error(content) for another folder.
nlohmann::ordered_json info_of_folder(const std::string& path);

/// Returns facts of a TOML file by its keys: a scene of parts, a mission, a table of materials, settings of a run, an
/// environment or a sonar. Throws as the reader of each.
nlohmann::ordered_json info_of_toml(const std::string& path);

/// Returns facts of a cloud, mesh, raster or tiles. `requested` overrules the meaning of the file; tiles are prepared and
/// ignore it.
nlohmann::ordered_json info_of_scene(const std::string& path, const MeaningOverride& requested);

/// Commands that go on from a scene with this box: a ping from before and above it that looks at its middle, and a
/// mission of two lines or more over it.
std::vector<std::string> next_of_scene(const std::string& path, const Bounds& box);

/// Returns facts of a recording of a real sonar, by its first ping.
nlohmann::ordered_json info_of_record(const std::string& path);

/// Returns facts of a recorded swath: soundings, their extent, levels and deviations, the way, and kinds of records.
nlohmann::ordered_json info_of_swath(const std::string& path);

/// Prints what info_of_scene says of a cloud, mesh or raster.
void print_scene(const nlohmann::ordered_json& info);

/// The least and the greatest of some numbers, without those that are not recorded.
struct FactSpan {
  void add(double value) {
    if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
  }
  /// Returns both; null of none.
  nlohmann::ordered_json json() const {
    return least <= most ? nlohmann::ordered_json{least, most} : nlohmann::ordered_json();
  }
  /// Returns both, or the one that they are.
  nlohmann::ordered_json number_or_json() const { return least == most ? nlohmann::ordered_json(least) : json(); }
  double least = std::numeric_limits<double>::infinity(), most = -least;
};

/// A path as a shell takes it.
std::string shell_word(const std::string& path);

}  // namespace insonify::tool
