// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/ping_notes.hpp"

#include <cmath>
#include <sstream>

#include "acoustics/reflection.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

/// A number in so many digits.
std::string in_digits(double value, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

/// States the effect of refraction, and whether it was left out.
std::string refraction_note(const RefractionReport& r, const RangeGate& gate) {
  const auto beyond_rounding = [](double x) { return x < 1e-9 ? 0 : x; };
  const std::string bound = "straight rays to the scatterers in view are wrong by up to " +
                            in_digits(beyond_rounding(r.bound.range), 2) + " m in range, " +
                            in_digits(degrees(beyond_rounding(r.bound.elevation)), 2) + " deg in angle and " +
                            in_digits(beyond_rounding(r.bound.level_db), 2) + " dB in level";
  if (!r.bent) return "refraction is left out: " + bound + " (bin " + in_digits(gate.bin_size, 3) + " m)";
  const std::string unreached =
      r.unreached > 0
          ? "; " + std::to_string(r.unreached) +
                " legs by boundaries, mirrors or from surface to surface have no ray: their echoes are left out"
          : "";
  return "the sound-speed profile bends rays: " + bound + "; " + std::to_string(r.paths.silenced) +
         " scatterers are in shadow zones, " + std::to_string(r.paths.focused) +
         " near caustics, whose level is limited to 20 dB above that of straight rays" + unreached;
}

/// States why multipath gave no echo: most often the sea is too rough.
std::string no_multipath_note(const Environment& environment) {
  const double waves = environment.surface ? rms_wave_height(environment) : 0;
  const std::string sea =
      waves > 0 ? "waves of " + in_digits(waves, 2) + " m rms scatter the sound that a smooth surface would reflect"
                : std::string("both are out of reach, hidden or outside the pattern");
  return "surface and bottom reflect no echo: " + sea;
}

/// States that the head sees nearly only backs.
std::string backs_note(const SamplingReport& s) {
  const double share = static_cast<double>(s.back_facing) / static_cast<double>(s.in_gate);
  return std::to_string(std::lrint(100 * share)) +
         " % of the surfels in fan and range gate face away from the head and give no echo; the head may be below the "
         "ground or inside a body: check --pose, or orient the normals by --viewpoint";
}

}  // namespace

std::vector<PingNote> notes_of(const SimulatedPing& ping, const Environment& environment, const RangeGate& gate) {
  std::vector<PingNote> notes = ping.report.notes;
  const auto add = [&](const char* kind, std::string text) {
    notes.push_back({kind, std::move(text), 1, ping.ping.number});
  };
  const SamplingReport& sampling = ping.report.sampling;
  constexpr double nearly_all = 0.95;
  if (sampling.in_gate > 0 &&
      static_cast<double>(sampling.back_facing) >= nearly_all * static_cast<double>(sampling.in_gate))
    add("backs", backs_note(sampling));
  else if (sampling.scatterers == 0)
    add(silent_note_kind, sampling.in_gate > 0
                              ? "the ping is silent: every surfel inside fan and range gate faces away or is hidden"
                              : "the ping is silent: no surfel is inside fan and range gate");
  for (const LayerReport& layer : ping.report.layers)
    if (layer.name == "multipath" && layer.echoes == 0) add("no multipath", no_multipath_note(environment));
  if (environment.profile) add("refraction", refraction_note(ping.report.refraction, gate));
  return notes;
}

}  // namespace insonify
