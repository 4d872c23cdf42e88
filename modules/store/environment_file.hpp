// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "acoustics/environment.hpp"

namespace insonify {

/// Reads an environment from TOML: tables [water], [surface], [bottom], [volume], [wind], [noise], [tank] with the keys of
/// environment_key_names, [profile] with the lists depth_m and sound_speed, and [[mirror]] for each mirror. Each table enables its part of the
/// environment; omitted keys keep their defaults. Other tables of a run.toml (recognised by its key insonify_version)
/// are ignored. Unknown tables or keys and values of the wrong type are errors with file, line and the nearest known
/// name. Throws Error(file) or Error(content).
Environment load_environment(const std::string& path);

/// Sets one value from text: section "water", key "temperature_c", ... Consistency is checked by require_valid only.
/// Throws Error(argument) naming the nearest section or key, or the value and its type.
void set_environment_value(Environment& environment, const std::string& section, const std::string& key,
                           const std::string& value);

/// The parts present in the environment as TOML tables, which read back identically (lambert_mu_db to its last bit).
std::string environment_as_toml(const Environment& environment);

/// All keys as "section.key", in the order of files.
std::vector<std::string> environment_key_names();

}  // namespace insonify
