#pragma once
#include <string>

#include "acoustics/sound_speed_profile.hpp"

namespace insonify {

/// Reads a sound speed profile from CSV with the header depth_m,sound_speed [m, m/s] or
/// depth_m,temperature_c,salinity_psu, its columns in any order; '#' starts a comment line. Depths ascend strictly and
/// are positive down. Temperature and salinity are converted to sound speed by UNESCO (E1) at latitude 45 degrees.
/// Throws Error(file), or Error(content) with path, line, column, value and rule: the rules of require_valid(profile)
/// and, for temperature and salinity, require_valid(water).
SoundSpeedProfile load_sound_speed_profile(const std::string& path);

}  // namespace insonify
