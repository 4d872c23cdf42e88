#include "beamforming/sonar_spec.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

void require(bool holds, const char* who, const char* key, double value, const char* unit, const char* rule) {
  if (!holds) fail(ErrorKind::argument, who, ": ", key, " = ", value, *unit ? " " : "", unit, ", must be ", rule);
}

}  // namespace

Shading shading_of(const SonarSpec& spec) {
  return spec.shading.value_or(spec.side_lobe_db < 0 ? Shading::taylor : Shading::uniform);
}

void require_valid(const SonarSpec& s, const char* who) {
  const auto within = [](double x, double low, double high) { return x > low && x <= high; };
  require(within(s.centre_frequency, 0, 1e9), who, "centre_frequency_hz", s.centre_frequency, "Hz",
          "> 0 and at most 1e9");
  require(s.bandwidth > 0 && s.bandwidth < 2 * s.centre_frequency, who, "bandwidth_hz", s.bandwidth, "Hz",
          "> 0 and below twice centre_frequency_hz");
  require(std::abs(s.source_level_db) <= 400, who, "source_level_db", s.source_level_db, "dB", "within -400 and 400");
  require(s.beams >= 1 && s.beams <= 65536, who, "beams", static_cast<double>(s.beams), "", "within 1 and 65536");
  require(s.beams == 1 || !s.azimuths.empty() || within(s.field_of_view, 0, 2 * pi), who, "field_of_view_deg",
          degrees(s.field_of_view), "deg", "> 0 and at most 360");
  require(within(s.beam_width, 0, pi), who, "beam_width_deg", degrees(s.beam_width), "deg", "> 0 and at most 180");
  require(within(s.elevation_width, 0, pi), who, "elevation_width_deg", degrees(s.elevation_width), "deg",
          "> 0 and at most 180");
  require(std::abs(s.elevation) <= pi / 2, who, "elevation_deg", degrees(s.elevation), "deg", "within -90 and 90");
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
  head.pulse = {spec.centre_frequency, spec.bandwidth, spec.source_level_db};
  head.array = array_for_beam_width(spec.beam_width, nominal_sound_speed / spec.centre_frequency, shading_of(spec),
                                    spec.side_lobe_db);
  head.elevation_shape = spec.elevation_shape;
  head.fan = make_fan(spec.beams, spec.field_of_view, spec.beam_width, spec.elevation_width, spec.elevation);
  if (!spec.azimuths.empty()) {
    head.fan.azimuth = spec.azimuths;
    head.fan.elevation.assign(spec.azimuths.size(), spec.elevation);
  }
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
