// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "run/option_rules.hpp"
#include "run/options.hpp"
#include "store/key_table.hpp"

/// The settings of a run that run.toml records as they were given. Each is one row of a table, from which the options
/// of the command line, the keys of run.toml and their checks are made.
namespace insonify {

/// A setting: what run.toml and the command line call it, where its value is, and what it may be.
struct RunSetting {
  const char* section;  ///< table of run.toml, or "": top level
  const char* key;      ///< in run.toml
  const char* option;   ///< on the command line
  OptionValue value;    ///< never a function
  std::string help;
  OptionRules rules = {};
  bool is_path = false;  ///< relative to the current folder, or to the folder of run.toml
};

/// Titles under which --help lists settings.
inline constexpr const char *scene_title = "Scene", *sonar_title = "Sonar and water", *head_title = "Head",
                            *sound_title = "Sound", *accuracy_title = "Accuracy", *output_title = "Output",
                            *detection_title = "Detections";

/// Rows of [scene]: what the numbers of a file mean.
std::vector<RunSetting> meaning_settings(MeaningOverride& meaning);
/// Rows of [scene]: how a cloud is read and completed.
std::vector<RunSetting> scene_settings(SceneOptions& options);
/// Rows of the top level: the synthesis.
std::vector<RunSetting> synthesis_settings(SynthesisSettings& settings);
/// Rows of [ping].
std::vector<RunSetting> ping_settings(Run& run);
/// Rows of what stays the same from ping to ping: seed, synthesis, and those of [ping] but for pose, motion and time.
std::vector<RunSetting> simulator_settings(Run& run);
/// Rows of the tables [scene] and [ping] of a mission.
std::vector<RunSetting> mission_settings(Run& run);
/// The seed.
RunSetting seed_setting(std::uint64_t& seed);
/// The budget of what is left out: of [ping], or of another section.
RunSetting accuracy_setting(double& accuracy_db, const char* section = "ping");
/// The order of absorption, in the same way.
RunSetting absorption_setting(std::optional<int>& order, const char* section = "ping");
/// All settings of a ping, in the order of run.toml.
std::vector<RunSetting> all_settings(Run& run);

/// The files that settings name as inputs.
std::vector<std::string> input_files(const std::vector<RunSetting>& settings);

/// The settings as keys of run.toml, which write where the settings do.
std::vector<Key> keys_of(const std::vector<RunSetting>& settings);

/// The settings as TOML: "key = value" lines under their tables.
std::string settings_as_toml(const std::vector<RunSetting>& settings);

/// Reads all settings of a ping from the run.toml at `path`: what the file does not mention keeps its default. Sonar
/// and environment are the file itself. Relative paths in it are looked up from the current folder, then from the
/// folder of run.toml, then from the folder above it; a path that is in none of them stays as it is. Throws
/// Error(content) with path and line for an unknown key or a value that is not allowed, Error(file) without a file.
Run load_ping_settings(const std::string& path);

/// Reads [scene] and [ping] of a mission, in the same way; what the mission says elsewhere is left as it is by default.
Run load_mission_settings(const std::string& path);

/// Reads [scene] alone, in the same way.
SceneOptions load_scene_settings(const std::string& path);

}  // namespace insonify
