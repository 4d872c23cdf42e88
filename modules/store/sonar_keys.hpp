// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "sonar/sonar_spec.hpp"
#include "store/key_table.hpp"
#include "store/sonar_file.hpp"

namespace insonify {

/// Returns the keys of a sonar, in the order of files, bound to a spec. range_resolution_m sets the bandwidth.
/// azimuths_deg sets beams and field of view. beams or field_of_view_deg restore an evenly spaced fan, elevation_deg a
/// single row. require_valid checks rules that involve several keys.
std::vector<Key> sonar_keys(SonarSpec& spec);

/// Returns the key mounting_deg of a sonar's file.
Key mounting_key(SonarFile& file);

}  // namespace insonify
