// SPDX-License-Identifier: BSD-3-Clause
#include "store/sonar_keys.hpp"

#include <algorithm>

namespace insonify {
namespace {

constexpr Named<ElevationShape> elevation_shapes[] = {
    {"gaussian", ElevationShape::gaussian}, {"line", ElevationShape::line}, {"sector", ElevationShape::sector}};

// Returns the names of enumerators, as their own function states them.
template <typename Value>
std::vector<Named<Value>> named(const char* (*name)(Value), std::initializer_list<Value> values) {
  std::vector<Named<Value>> table;
  for (const Value value : values) table.push_back({name(value), value});
  return table;
}
std::vector<Named<PulseShape>> pulse_names() {
  std::vector<Named<PulseShape>> table;
  for (std::size_t k = 0; k < std::size(pulse_kinds); ++k)
    table.push_back({pulse_shape_name(static_cast<PulseShape>(k)), static_cast<PulseShape>(k)});
  return table;
}
std::vector<Named<ArrayShape>> array_names() {
  std::vector<Named<ArrayShape>> table;
  for (const ArrayKind& kind : array_kinds) table.push_back({kind.name, static_cast<ArrayShape>(table.size())});
  return table;
}
const auto pulses = pulse_names();
const auto arrays = array_names();
const auto windows = named(replica_window_name, {ReplicaWindow::uniform, ReplicaWindow::hann, ReplicaWindow::hamming});
const auto shadings = named(shading_name, {Shading::taylor, Shading::uniform, Shading::hamming, Shading::chebyshev});

/// Returns true if the shading follows from side_lobe_db alone.
bool is_default_shading(const SonarSpec& spec) {
  SonarSpec plain = spec;
  plain.shading.reset();
  return shading_of(spec) == shading_of(plain);
}

/// Restores an evenly spaced fan: drops azimuths and the elevations that belong to them, but keeps those of rows.
void drop_table(SonarSpec& spec) {
  if (spec.azimuths.empty()) return;
  spec.azimuths.clear();
  spec.elevations.clear();
}

/// Sets number and field of view of beams at given azimuths. The field of view extends half a mean spacing beyond the
/// outermost beams, as in an evenly spaced fan, and is at least one beam width.
void fit_fan(SonarSpec& spec) {
  if (spec.azimuths.empty()) return;
  spec.beams = spec.azimuths.size();
  const auto [low, high] = std::minmax_element(spec.azimuths.begin(), spec.azimuths.end());
  const double n = static_cast<double>(spec.beams);
  spec.field_of_view = std::clamp((*high - *low) * n / std::max(n - 1, 1.0), std::min(spec.beam_width, 2 * pi), 2 * pi);
}

/// The rule for a width that is 0 in the spec if files omit it.
constexpr NumberRule width_rule{.least = 0, .above = true, .note = "omit the key if there is none"};

}  // namespace

std::vector<Key> sonar_keys(SonarSpec& s) {
  const auto fit = [&s] { fit_fan(s); };
  const auto even = [&s] { drop_table(s); };
  const auto has_azimuths = [&s] { return !s.azimuths.empty(); };
  const Member<double> resolution{[] { return std::optional<double>(); },
                                  [&s](double metres) { s.bandwidth = nominal_sound_speed / (2 * metres); }};
  return {
      {"", "name", "", text(s.name), "name of the sonar", true},
      {"", "centre_frequency_hz", "Hz", number(s.centre_frequency), "centre frequency of the pulse", true},
      {"", "bandwidth_hz", "Hz", number(s.bandwidth), "full width of the pulse's spectrum at -3 dB", true,
       "range_resolution_m"},
      {"", "range_resolution_m", "m", number(resolution, positive), "range resolution c / 2B at 1500 m/s"},
      {"", "source_level_db", "dB", number(s.source_level_db), "source level re 1 uPa at 1 m", true},
      {"", "beams", "",
       then(omitted_if(number(s.beams, {.least = 1, .most = 65536, .whole = true}), has_azimuths), even),
       "number of evenly spaced beams", true, "azimuths_deg"},
      {"", "field_of_view_deg", "deg", then(omitted_if(angle(s.field_of_view), has_azimuths), even),
       "angle that evenly spaced beams cover", true, "azimuths_deg"},
      {"", "beam_width_deg", "deg", then(angle(s.beam_width), fit), "-3 dB width of a beam in azimuth", true},
      {"", "azimuths_deg", "deg", then(list(given(s.azimuths), {.least = -180, .most = 180}, in_degrees), fit),
       "azimuths of the beams"},
      {"", "elevations_deg", "deg",
       then(list(given(s.elevations), {.least = -90, .most = 90}, in_degrees), [&s] { s.elevation = 0; }),
       "elevations of rows of beams; beside `azimuths_deg`: one elevation for each beam"},
      {"", "column_beam_width_deg", "deg", angle(given(s.column_beam_width), width_rule),
       "beam width of a planar array in elevation; without the key: a line array"},
      {"", "array", "", omitted_if(word(s.array, arrays), [&s] { return s.array == ArrayShape{}; }),
       "shape of the receive array; default: line; an array that is curved has an array_radius_m"},
      {"", "array_radius_m", "m", number(given(s.array_radius), width_rule), "radius of a curved array"},
      {"", "side_lobe_db", "dB", number(s.side_lobe_db),
       "level of the side lobes of taylor and chebyshev shading; 0: uniform shading"},
      {"", "shading", "", omitted_if(word(s.shading, shadings), [&s] { return is_default_shading(s); }),
       "shading of the array; default: taylor, or uniform if `side_lobe_db = 0`"},
      {"", "transmit_width_deg", "deg", angle(given(s.transmit_width), width_rule),
       "width of the transmitter's main lobe in azimuth; without the key: uniform over the fan"},
      {"", "elevation_width_deg", "deg", angle(s.elevation_width), "-3 dB width of the pattern in elevation", true},
      {"", "elevation_deg", "deg",
       then(omitted_if(angle(s.elevation), [&s] { return !s.elevations.empty(); }), [&s] { s.elevations.clear(); }),
       "elevation of the fan's axis", false, "elevations_deg"},
      {"", "elevation_shape", "", word(s.elevation_shape, elevation_shapes), "shape of the pattern in elevation"},
      {"", "min_range_m", "m", number(s.min_range), "range at which listening begins", true},
      {"", "max_range_m", "m", number(s.max_range), "range at which listening ends", true},
      {"", "bin_size_m", "m", number(s.bin_size), "size of a range bin; default and most: 0.44 c / 2B"},
      {"", "pulse", "", omitted_if(word(s.pulse, pulses), [&s] { return s.pulse == PulseShape{}; }),
       "shape of the pulse; default: gaussian; a sweep has a pulse_length_s, the length of others follows from the "
       "bandwidth"},
      {"", "pulse_length_s", "s", number(s.pulse_length), "duration of a sweep"},
      {"", "replica_window", "", word(s.replica_window, windows),
       "window of the matched filter of a sweep; default: hamming"},
  };
}

}  // namespace insonify
