// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/sonar_spec.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/require.hpp"
#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

/// Throws Error unless keys of a sweep come with a sweep, and a sweep with its duration.
void require_pulse(const SonarSpec& s, const char* who) {
  const PulseTraits& pulse = kind_of(s.pulse).traits();
  if (pulse.most_product == 0 && s.pulse_length)
    fail(ErrorKind::argument, who, ": pulse_length_s = ", *s.pulse_length, " s, must be left out for pulse ",
         pulse.name, ", whose length follows from its bandwidth; use pulse = \"linear_fm\"");
  if (!pulse.window && s.replica_window)
    fail(ErrorKind::argument, who, ": replica_window = ", replica_window_name(*s.replica_window),
         ", must be left out for pulse ", pulse.name, "; use pulse = \"linear_fm\"");
  if (pulse.most_product == 0) return;
  if (!s.pulse_length)
    fail(ErrorKind::argument, who, ": pulse = ", pulse.name, ", must come with pulse_length_s, the duration of the ",
         "sweep");
  require(*s.pulse_length > 0 && std::isfinite(*s.pulse_length), who, "pulse_length_s", *s.pulse_length, "s", "> 0");
  const double product = s.bandwidth * *s.pulse_length;
  if (!(product >= 1 - 1e-9 && product <= pulse.most_product))
    fail(ErrorKind::argument, who, ": pulse_length_s = ", *s.pulse_length, " s, times bandwidth_hz = ", s.bandwidth,
         " Hz, must be within ", pulse.products, "; it is ", product);
}

void require_beam_table(const SonarSpec& s, const char* who) {
  for (const double elevation : s.elevations)
    require(std::abs(elevation) <= pi / 2, who, "elevations_deg", degrees(elevation), "deg", "within -90 and 90");
  if (!s.azimuths.empty() && !s.elevations.empty() && s.azimuths.size() != s.elevations.size())
    fail(ErrorKind::argument, who, ": elevations_deg = ", s.elevations.size(), " numbers, must be as many as the ",
         s.azimuths.size(), " of azimuths_deg, one for each beam");
  if (beams_of(s) > 65536)
    fail(ErrorKind::argument, who, ": elevations_deg = ", s.elevations.size(), " rows of ", s.beams,
         " beams, must be at most 65536 beams in all");
}

/// Returns the beams of the spec: listed directions, or rows of an evenly spaced fan.
BeamFan fan_of(const SonarSpec& s) {
  BeamFan fan = make_fan(s.beams, s.field_of_view, s.beam_width, s.elevation_width, s.elevation);
  fan.row_width = s.column_beam_width;
  if (!s.azimuths.empty()) {
    fan.azimuth = s.azimuths;
    fan.elevation = s.elevations.empty() ? std::vector<double>(s.azimuths.size(), s.elevation) : s.elevations;
  } else if (!s.elevations.empty()) {
    const std::vector<double> row = fan.azimuth;
    fan.azimuth.clear();
    fan.elevation.clear();
    for (const double elevation : s.elevations) {
      fan.azimuth.insert(fan.azimuth.end(), row.begin(), row.end());
      fan.elevation.insert(fan.elevation.end(), row.size(), elevation);
    }
  }
  return fan;
}

}  // namespace

std::size_t beams_of(const SonarSpec& spec) {
  if (!spec.azimuths.empty()) return spec.azimuths.size();
  return spec.beams * std::max<std::size_t>(1, spec.elevations.size());
}

Shading shading_of(const SonarSpec& spec) {
  return spec.shading.value_or(spec.side_lobe_db < 0 ? Shading::taylor : Shading::uniform);
}

void require_valid(const SonarSpec& s, const char* who) {
  const auto within = [](double x, double low, double high) { return x > low && x <= high; };
  require(within(s.centre_frequency, 0, 1e9), who, "centre_frequency_hz", s.centre_frequency, "Hz",
          "> 0 and at most 1e9");
  require(s.bandwidth > 0 && s.bandwidth < 2 * s.centre_frequency, who, "bandwidth_hz", s.bandwidth, "Hz",
          "> 0 and below twice centre_frequency_hz");
  require_pulse(s, who);
  require(s.source_level_db >= -400 && s.source_level_db <= 260, who, "source_level_db", s.source_level_db, "dB",
          "within -400 and 260");
  require(s.beams >= 1 && s.beams <= 65536, who, "beams", static_cast<double>(s.beams), "", "within 1 and 65536");
  require(s.beams == 1 || !s.azimuths.empty() || within(s.field_of_view, 0, pi), who, "field_of_view_deg",
          degrees(s.field_of_view), "deg", "> 0 and at most 180: a line array cannot tell ahead from astern");
  require(within(s.beam_width, 0, pi), who, "beam_width_deg", degrees(s.beam_width), "deg", "> 0 and at most 180");
  require(within(s.elevation_width, 0, pi), who, "elevation_width_deg", degrees(s.elevation_width), "deg",
          "> 0 and at most 180");
  require(std::abs(s.elevation) <= pi / 2, who, "elevation_deg", degrees(s.elevation), "deg", "within -90 and 90");
  require_beam_table(s, who);
  require(s.column_beam_width == 0 || within(s.column_beam_width, 0, pi), who, "column_beam_width_deg",
          degrees(s.column_beam_width), "deg", "> 0 and at most 180; leave it out for a line array");
  const ArrayKind& kind = array_kinds[static_cast<std::size_t>(s.array)];
  require(kind.has_radius ? within(s.array_radius, 0, 100) : s.array_radius == 0, who, "array_radius_m", s.array_radius,
          "m", kind.has_radius ? "> 0 and at most 100" : "left out: array = \"line\" is straight");
  require(s.transmit_width == 0 || within(s.transmit_width, 0, 2 * pi), who, "transmit_width_deg",
          degrees(s.transmit_width), "deg",
          "> 0 and at most 360; leave it out for a transmitter that fills the fan evenly");
  require(s.side_lobe_db == 0 || (s.side_lobe_db >= -80 && s.side_lobe_db < -13.3), who, "side_lobe_db", s.side_lobe_db,
          "dB", "0 (uniform) or within -80 and -13.3 (Taylor)");
  require(s.side_lobe_db < 0 || (shading_of(s) != Shading::taylor && shading_of(s) != Shading::chebyshev), who,
          "side_lobe_db", s.side_lobe_db, "dB", "within -80 and -13.3 for shading taylor or chebyshev");
  require(within(s.min_range, 0, 1e6), who, "min_range_m", s.min_range, "m", "> 0");
  require(std::isfinite(s.max_range) && s.max_range > s.min_range, who, "max_range_m", s.max_range, "m",
          "above min_range_m");
  require(!s.bin_size || *s.bin_size > 0, who, "bin_size_m", s.bin_size.value_or(0), "m", "> 0");
}

SonarHead make_head(const SonarSpec& spec, double sound_speed) {
  require_valid(spec, "make_head");
  if (!(sound_speed > 0 && std::isfinite(sound_speed)))
    fail(ErrorKind::argument, "make_head: sound_speed = ", sound_speed, " m/s, must be > 0");
  SonarHead head;
  head.name = spec.name;
  head.pulse = {spec.centre_frequency,         spec.bandwidth,
                spec.source_level_db,          spec.pulse,
                spec.pulse_length.value_or(0), spec.replica_window.value_or(ReplicaWindow::hamming)};
  head.array_shape = spec.array, head.array_radius = spec.array_radius;
  head.array = array_for_beam_width(spec.beam_width, nominal_sound_speed / spec.centre_frequency, shading_of(spec),
                                    spec.side_lobe_db, head);
  head.elevation_shape = spec.elevation_shape;
  head.fan = fan_of(spec);
  head.transmit_width = spec.transmit_width;
  if (spec.column_beam_width > 0)
    head.column = array_for_beam_width(spec.column_beam_width, nominal_sound_speed / spec.centre_frequency,
                                       shading_of(spec), spec.side_lobe_db);
  const double pulse_length = sound_speed / (2 * spec.bandwidth), window = spec.max_range - spec.min_range;
  if (pulse_length > window)
    fail(ErrorKind::argument, "make_head: bandwidth_hz = ", spec.bandwidth,
         " Hz makes a pulse of c / 2B = ", pulse_length,
         " m, must not be longer than max_range_m - min_range_m = ", window,
         " m; use more bandwidth, or a longer range");
  const double coarsest = default_bin_size(head.pulse, sound_speed);
  head.gate = {spec.min_range, spec.max_range, spec.bin_size.value_or(coarsest)};
  if (head.gate.bin_size > coarsest * (1 + 1e-9))
    fail(ErrorKind::argument, "make_head: bin_size_m = ", head.gate.bin_size,
         " m would under-sample the pulse, must be ", "at most 0.44 c / 2B = ", coarsest,
         " m; leave bin_size_m out, or lower bandwidth_hz");
  require_valid(head, "make_head");
  return head;
}

}  // namespace insonify
