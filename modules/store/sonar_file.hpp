// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sonar/sonar_spec.hpp"
#include "store/sourced_number.hpp"

namespace insonify {

/// One value of a sonar file with its source.

/// A sonar as its file describes it.
struct SonarFile {
  SonarSpec spec;
  std::string description;
  std::string path;
  std::vector<SourcedNumber> numbers;
  bool of_run = false;                                 ///< true: read from a run.toml; its ranges are those of that run
  Eigen::Vector3d mounting = Eigen::Vector3d::Zero();  ///< attitude on a vehicle: yaw to port, pitch down, roll [rad]
};

/// Returns a sonar from TOML, or from the table [sonar] of a run.toml. Every key is a number (or string) or a table
/// {value, status, source}; plain values have status "user". Exactly one of bandwidth_hz and range_resolution_m (B =
/// 1500 m/s / 2 dr) is given. azimuths_deg replaces beams and field_of_view_deg; elevations_deg replaces elevation_deg.
/// With azimuths_deg, elevations_deg lists one elevation per beam; without, a row of beams for each elevation.
/// mounting_deg is the attitude that a mission gives the head. `numbers` also lists a derived bandwidth and the
/// defaults of omitted keys. Unknown or missing keys, wrong types and invalid values are errors with file, line and
/// remedy. Throws Error(file) or Error(content).
SonarFile load_sonar_file(const std::string& path);

/// Returns the preset of this name ("oculus-m750d") from the sonar folder, or the sonar in a file (a path that ends in
/// .toml). Throws Error(argument) with the nearest known names for an unknown name.
SonarFile find_sonar(const std::string& name_or_path);

/// Returns all presets, sorted by name.
std::vector<SonarFile> list_sonars();

/// Returns the folder of data files: that of the environment variable INSONIFY_DATA if set, else the one beside the
/// program, else the installed one, else that of the source tree. Throws Error(file) if none exists, or if
/// INSONIFY_DATA does not name a data folder.
std::string data_folder();
/// Returns the paths of the TOML files in a folder of data_folder(), by their names without the extension. Throws
/// Error(file).
std::map<std::string, std::string> data_files(const std::string& folder);

/// Returns the spec as TOML text, the table [sonar] of run.toml. The text reads back bit for bit if the angles of the
/// spec came from degrees (a file, set_sonar_value); an angle computed in radians may change in its last bit.
std::string sonar_as_toml(const SonarSpec& spec);

/// Sets one key ("beams", "centre_frequency_hz", ...) of a spec from text; lists as "-10, 0, 10". Keys may be set in
/// any order, because only make_head checks consistency. Throws Error(argument) naming the nearest key, or the value
/// and its type.
void set_sonar_value(SonarSpec& spec, const std::string& key, const std::string& value);

}  // namespace insonify
