#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "store/sonar_keys_internal.hpp"

namespace insonify {
namespace {

// A key that holds one number of the spec, possibly in degrees.
struct NumberKey {
  const char* name;
  double SonarSpec::*field;
  bool in_degrees;
};
constexpr std::array number_keys = {
    NumberKey{"centre_frequency_hz", &SonarSpec::centre_frequency, false},
    NumberKey{"bandwidth_hz", &SonarSpec::bandwidth, false},
    NumberKey{"source_level_db", &SonarSpec::source_level_db, false},
    NumberKey{"field_of_view_deg", &SonarSpec::field_of_view, true},
    NumberKey{"beam_width_deg", &SonarSpec::beam_width, true},
    NumberKey{"elevation_width_deg", &SonarSpec::elevation_width, true},
    NumberKey{"elevation_deg", &SonarSpec::elevation, true},
    NumberKey{"side_lobe_db", &SonarSpec::side_lobe_db, false},
    NumberKey{"min_range_m", &SonarSpec::min_range, false},
    NumberKey{"max_range_m", &SonarSpec::max_range, false},
    NumberKey{"column_beam_width_deg", &SonarSpec::column_beam_width, true},
    NumberKey{"transmit_width_deg", &SonarSpec::transmit_width, true},
};

constexpr Named<ElevationShape> elevation_shape_names[] = {
    {"gaussian", ElevationShape::gaussian}, {"line", ElevationShape::line}, {"sector", ElevationShape::sector}};

// The enumerations that have a function for their names.
template <typename Value>
std::vector<Named<Value>> named(const char* (*name)(Value), std::initializer_list<Value> values) {
  std::vector<Named<Value>> table;
  for (const Value value : values) table.push_back({name(value), value});
  return table;
}
const auto pulse_shape_names = named(pulse_shape_name, {PulseShape::gaussian, PulseShape::linear_fm});
const auto replica_window_names =
    named(replica_window_name, {ReplicaWindow::uniform, ReplicaWindow::hann, ReplicaWindow::hamming});
const auto shading_names =
    named(shading_name, {Shading::taylor, Shading::uniform, Shading::hamming, Shading::chebyshev});

// Optional widths; zero in the spec if absent.
bool is_optional_width(const std::string& key) { return key == "column_beam_width_deg" || key == "transmit_width_deg"; }

const NumberKey* find_number_key(const std::string& key) {
  for (const NumberKey& candidate : number_keys)
    if (key == candidate.name) return &candidate;
  return nullptr;
}

// The degrees with the shortest text that read back to the same radians. They exist for every angle read from a file;
// an angle computed in radians may be off by its last bit.
double degrees_of(double angle) {
  const double straight = degrees(angle);
  for (int digits = 6; digits <= 17; ++digits) {
    std::array<char, 40> text{};
    const auto end = std::to_chars(text.begin(), text.end(), straight, std::chars_format::general, digits).ptr;
    double rounded = 0;
    std::from_chars(text.begin(), end, rounded);
    if (radians(rounded) == angle) return rounded;
  }
  for (const double towards : {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}) {
    double near = straight;
    for (int step = 0; step < 4; ++step)
      if (near = std::nextafter(near, towards); radians(near) == angle) return near;
  }
  return straight;
}

[[noreturn]] void fail_value(const std::string& key, const SonarValue& value, const char* rule) {
  fail(ErrorKind::argument, key, " = ", toml_text_of(value), ", must be ", rule);
}

double number_of(const std::string& key, const SonarValue& value) {
  const double* number = std::get_if<double>(&value);
  if (!number || !std::isfinite(*number)) fail_value(key, value, "a number");
  return *number;
}

// Returns to an evenly spaced fan: drops azimuths and the elevations that belong to them, but keeps those of rows.
void drop_table(SonarSpec& spec) {
  if (spec.azimuths.empty()) return;
  spec.azimuths.clear();
  spec.elevations.clear();
}

void set_beams(SonarSpec& spec, const SonarValue& value) {
  const double beams = number_of("beams", value);
  if (beams != std::floor(beams) || beams < 1 || beams > 65536)
    fail_value("beams", value, "a whole number within 1 and 65536");
  spec.beams = static_cast<std::size_t>(beams);
  drop_table(spec);
}

// Sets an enumeration from its name in a table.
template <typename Table, typename Value>
void set_named(const std::string& key, const SonarValue& value, const Table& table, const char* rule, Value& target) {
  const std::string* text = std::get_if<std::string>(&value);
  const auto* found = text ? find_named(table, *text) : nullptr;
  if (!found) fail_value(key, value, rule);
  target = *found;
}

// True if the shading follows from side_lobe_db alone.
bool is_default_shading(const SonarSpec& spec) {
  SonarSpec plain = spec;
  plain.shading.reset();
  return shading_of(spec) == shading_of(plain);
}

// Field of view of beams at given azimuths: it extends half a mean spacing beyond the outermost beams, as in an evenly
// spaced fan, and is at least one beam width.
double field_of_view_of(const std::vector<double>& azimuths, double beam_width) {
  const auto [low, high] = std::minmax_element(azimuths.begin(), azimuths.end());
  const double n = static_cast<double>(azimuths.size());
  return std::clamp((*high - *low) * n / std::max(n - 1, 1.0), std::min(beam_width, 2 * pi), 2 * pi);
}

std::vector<double> angles_of(const std::string& key, const SonarValue& value, double most_deg, const char* rule) {
  const auto* list = std::get_if<std::vector<double>>(&value);
  const auto is_angle = [&](double angle) { return std::abs(angle) <= most_deg; };
  if (!list || list->empty() || !std::all_of(list->begin(), list->end(), is_angle)) fail_value(key, value, rule);
  std::vector<double> angles;
  for (const double angle : *list) angles.push_back(radians(angle));
  return angles;
}

void set_azimuths(SonarSpec& spec, const SonarValue& value) {
  spec.azimuths = angles_of("azimuths_deg", value, 180, "a list of numbers within -180 and 180");
  spec.beams = spec.azimuths.size();
}

std::string text_of_angles(const std::vector<double>& angles) {
  std::vector<double> list;
  for (const double angle : angles) list.push_back(degrees_of(angle));
  return toml_text_of(list);
}

// The fewest digits that read back to the same bits; no exponent for numbers of ordinary size.
std::string text_of_number(double value) {
  const double size = std::abs(value);
  const bool everyday = value == 0 || (size >= 1e-5 && size < 1e15);
  std::array<char, 40> text{};
  const auto end = everyday ? std::to_chars(text.begin(), text.end(), value, std::chars_format::fixed).ptr
                            : std::to_chars(text.begin(), text.end(), value, std::chars_format::scientific).ptr;
  std::string digits(text.begin(), end);
  if (digits.find_first_not_of("-0123456789") == std::string::npos) digits += ".0";
  return digits;
}

}  // namespace

std::vector<std::string> sonar_key_names() {
  return {"centre_frequency_hz", "bandwidth_hz",   "range_resolution_m", "source_level_db",     "beams",
          "field_of_view_deg",   "beam_width_deg", "azimuths_deg",       "elevations_deg",      "column_beam_width_deg",
          "side_lobe_db",        "shading",        "transmit_width_deg", "elevation_width_deg", "elevation_deg",
          "elevation_shape",     "min_range_m",    "max_range_m",        "bin_size_m",          "pulse",
          "pulse_length_s",      "replica_window"};
}

std::vector<std::string> required_sonar_keys() {
  return {"centre_frequency_hz", "source_level_db", "beam_width_deg",
          "elevation_width_deg", "min_range_m",     "max_range_m"};
}

void set_sonar_key(SonarSpec& spec, const std::string& key, const SonarValue& value) {
  if (const NumberKey* number = find_number_key(key)) {
    const double x = number_of(key, value);
    spec.*(number->field) = number->in_degrees ? radians(x) : x;
    if (key == "field_of_view_deg") drop_table(spec);
    if (key == "elevation_deg") spec.elevations.clear();
    if (is_optional_width(key) && !(x > 0)) fail_value(key, value, "> 0; omit the key if there is none");
  } else if (key == "range_resolution_m") {
    const double resolution = number_of(key, value);
    if (!(resolution > 0)) fail_value(key, value, "> 0");
    spec.bandwidth = nominal_sound_speed / (2 * resolution);
  } else if (key == "beams") {
    set_beams(spec, value);
  } else if (key == "elevation_shape") {
    set_named(key, value, elevation_shape_names, "gaussian, line or sector", spec.elevation_shape);
  } else if (key == "shading") {
    set_named(key, value, shading_names, "taylor, uniform, hamming or chebyshev", spec.shading);
  } else if (key == "azimuths_deg") {
    set_azimuths(spec, value);
  } else if (key == "elevations_deg") {
    spec.elevation = 0;
    spec.elevations = angles_of(key, value, 90, "a list of numbers within -90 and 90");
  } else if (key == "bin_size_m") {
    spec.bin_size = number_of(key, value);
  } else if (key == "pulse") {
    set_named(key, value, pulse_shape_names, "gaussian or linear_fm", spec.pulse);
  } else if (key == "pulse_length_s") {
    spec.pulse_length = number_of(key, value);
  } else if (key == "replica_window") {
    set_named(key, value, replica_window_names, "uniform, hann or hamming", spec.replica_window);
  } else {
    fail(ErrorKind::runtime, "set_sonar_key: no key '", key, "'");
  }
  if (!spec.azimuths.empty()) spec.field_of_view = field_of_view_of(spec.azimuths, spec.beam_width);
}

std::optional<std::string> sonar_key_text(const SonarSpec& spec, const std::string& key) {
  if (const NumberKey* number = find_number_key(key)) {
    const double x = spec.*(number->field);
    if (key == "field_of_view_deg" && !spec.azimuths.empty()) return std::nullopt;
    if (key == "elevation_deg" && !spec.elevations.empty()) return std::nullopt;
    if (is_optional_width(key) && x == 0) return std::nullopt;
    return text_of_number(number->in_degrees ? degrees_of(x) : x);
  }
  if (key == "beams" && spec.azimuths.empty()) return std::to_string(spec.beams);
  if (key == "bin_size_m" && spec.bin_size) return text_of_number(*spec.bin_size);
  if (key == "pulse" && spec.pulse != PulseShape::gaussian) return toml_text_of(name_of(pulse_shape_names, spec.pulse));
  if (key == "pulse_length_s" && spec.pulse_length) return text_of_number(*spec.pulse_length);
  if (key == "replica_window" && spec.replica_window)
    return toml_text_of(name_of(replica_window_names, *spec.replica_window));
  if (key == "elevation_shape") return toml_text_of(name_of(elevation_shape_names, spec.elevation_shape));
  if (key == "shading" && !is_default_shading(spec)) return toml_text_of(std::string(shading_name(shading_of(spec))));
  if (key == "azimuths_deg" && !spec.azimuths.empty()) return text_of_angles(spec.azimuths);
  if (key == "elevations_deg" && !spec.elevations.empty()) return text_of_angles(spec.elevations);
  return std::nullopt;
}

std::string toml_text_of(const SonarValue& value) {
  if (const double* number = std::get_if<double>(&value)) return text_of_number(*number);
  if (const std::string* text = std::get_if<std::string>(&value)) {
    std::string quoted = "\"";
    for (const char c : *text) {
      if (c == '"' || c == '\\') quoted += '\\';
      quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return quoted + "\"";
  }
  std::string list = "[";
  for (const double x : std::get<std::vector<double>>(value)) list += (list.size() > 1 ? ", " : "") + text_of_number(x);
  return list + "]";
}

}  // namespace insonify
