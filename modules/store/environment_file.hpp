#pragma once
#include <string>
#include <vector>

#include "acoustics/environment.hpp"

namespace insonify {

/// Reads an environment from TOML: tables [water], [surface], [bottom], [volume], [wind], [noise] with the keys that
/// environment_key_names lists, and [profile] with the lists depth_m and sound_speed. What a file does not mention keeps
/// its default; a table that is there makes its part of the environment present. Of the run.toml of a run (it has a key
/// insonify_version) everything else is passed over. Unknown tables, keys and values of a wrong kind are errors with
/// file, line and the nearest known name. Throws Error(file) or Error(content).
Environment load_environment(const std::string& path);

/// Sets one value from text: section "water", key "temperature_c", ... Whether the whole makes sense is for
/// require_valid to say. Error(argument) names the nearest section or key, or the value and its kind.
void set_environment_value(Environment& environment, const std::string& section, const std::string& key,
                           const std::string& value);

/// The environment as TOML tables, only those that are present; reads back the same (lambert_mu_db to its last bit).
std::string environment_as_toml(const Environment& environment);

/// All keys as "section.key", in the order of files.
std::vector<std::string> environment_key_names();

}  // namespace insonify
