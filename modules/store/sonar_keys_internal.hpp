#pragma once
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sonar/sonar_spec.hpp"

namespace insonify {

/// Value of one key of a sonar file.
using SonarValue = std::variant<double, std::string, std::vector<double>>;

/// All keys of a sonar, in the order of files.
std::vector<std::string> sonar_key_names();

/// Required keys, apart from bandwidth_hz and range_resolution_m, of which one is required.
std::vector<std::string> required_sonar_keys();

/// Sets one value of a spec, converted to SI and radians. range_resolution_m sets the bandwidth; azimuths_deg sets
/// beams and field of view; beams or field_of_view_deg restore an evenly spaced fan, elevation_deg a single row. Throws
/// Error(argument) "key = value, must be ..." for a value of the wrong type; require_valid checks ranges.
void set_sonar_key(SonarSpec& spec, const std::string& key, const SonarValue& value);

/// Value of a key as TOML text that reads back to the same bits; nothing if files written from this spec omit the key
/// (range_resolution_m always; bin_size_m, azimuths_deg, elevations_deg, column_beam_width_deg, transmit_width_deg,
/// pulse_length_s and replica_window when absent; pulse when gaussian; field_of_view_deg and elevation_deg when they
/// follow from the lists; shading when it follows from side_lobe_db).
std::optional<std::string> sonar_key_text(const SonarSpec& spec, const std::string& key);

/// A value as TOML text, numbers with the fewest digits that read back to the same bits.
std::string toml_text_of(const SonarValue& value);

}  // namespace insonify
