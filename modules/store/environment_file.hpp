// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "acoustics/environment.hpp"

namespace insonify {

/// Returns an environment from TOML. The tables [water], [surface], [bottom], [volume], [wind], [noise], [tank] have
/// the keys of docs/reference/keys.md; [profile] has the lists depth_m and sound_speed; each mirror is a [[mirror]].
/// Each table enables its part of the environment; omitted keys keep their defaults. Other tables of a run.toml
/// (recognised by its key insonify_version) are ignored. Unknown tables or keys and values of the wrong type are errors
/// with file, line and the nearest known name. Throws Error(file) or Error(content).
Environment load_environment(const std::string& path);

/// Sets one value from text: section "water", key "temperature_c", ... Only require_valid checks consistency. Throws
/// Error(argument) naming the nearest section or key, or the value and its type.
void set_environment_value(Environment& environment, const std::string& section, const std::string& key,
                           const std::string& value);

/// Returns the parts of the environment that are present as TOML tables. They read back with the same bits, except that
/// the last bit of lambert_mu_db may differ.
std::string environment_as_toml(const Environment& environment);

}  // namespace insonify
