#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "beamforming/sonar_spec.hpp"

namespace insonify {

/// What a sonar file may say for one key.
using SonarValue = std::variant<double, std::string, std::vector<double>>;

/// The keys that describe a sonar, in the order in which files list them.
std::vector<std::string> sonar_key_names();

/// Keys without which there is no sonar; bandwidth_hz and range_resolution_m, of which one is needed, stand
/// apart.
std::vector<std::string> required_sonar_keys();

/// Puts one value into a spec, converted to SI and radians. Setting range_resolution_m sets the bandwidth;
/// setting azimuths_deg sets beams and field of view; setting one of these returns to an even fan, setting elevation_deg
/// to one row. Throws
/// Error(argument) "key = value, must be ..." for a value of the wrong type; whether the number makes sense
/// is require_valid's to say.
void set_sonar_key(SonarSpec& spec, const std::string& key, const SonarValue& value);

/// Value of a key as TOML text that reads back to the same bits; nothing if the key is left out of files
/// written from this spec (range_resolution_m always; bin_size_m, azimuths_deg, elevations_deg,
/// column_beam_width_deg, transmit_width_deg, pulse_length_s and replica_window when absent; pulse when gaussian;
/// field_of_view_deg and elevation_deg when those say it; shading when it is what side_lobe_db alone means).
std::optional<std::string> sonar_key_text(const SonarSpec& spec, const std::string& key);

/// A value as TOML text, numbers with as many digits as it takes to get the same bits back.
std::string toml_text_of(const SonarValue& value);

}  // namespace insonify
