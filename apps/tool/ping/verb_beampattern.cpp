// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/units.hpp"
#include "run/parse_values.hpp"
#include "run/ping_setup.hpp"
#include "sonar/beam_pattern.hpp"
#include "sonar/receive_array.hpp"
#include "store/run_directory.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "view/show_image.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

struct BeamPatternOptions {
  CommonOptions common;
  HeadOptions head;  ///< sonar and --set
  std::string steer = "0";
  std::string output;  ///< picture, or empty: none
  bool force = false;
  std::string size = "1400x1050";
  bool dark = false;
};

void add_options(OptionList list, BeamPatternOptions& o) {
  list.add("SONAR", &o.head.sonar, "preset (see `insonify sonars`) or a .toml file", {.required = true});
  list.add("--steer", &o.steer, "[deg] azimuth of the beam, positive to port, within -90 and 90");
  list.add("-o,--output", &o.output, "picture that is written, .png");
  list.add("--force", &o.force, "replace an existing picture");
  list.add("--set", &o.head.settings,
           "sonar.KEY=VALUE or water.KEY=VALUE that replaces a value; may be given several times", {.one_each = true});
  list.add("--size", &o.size, "WIDTHxHEIGHT [pixels]");
  list.add("--dark", &o.dark, "draw on a dark background");
  add_common(list, o.common);
}

/// The beam that is measured, in the water of the run.
struct SteeredBeam {
  const PingSetup& setup;
  double wavelength = 0;
  double steering = 0;

  const LineArray& array() const { return setup.head.array; }
};

double parse_steering(const std::string& text) {
  const double angle = parse_number("--steer", text);
  if (std::abs(angle) > 90)
    fail(ErrorKind::argument, "--steer = ", angle, " deg, must be within -90 and 90, positive to port");
  return radians(angle);
}

/// "30.00 deg port"
std::string direction_text(double azimuth) {
  const double angle = degrees(azimuth);
  const char* side = std::abs(angle) < 0.005 ? "" : angle > 0 ? " port" : " starboard";
  return fmt::format("{:.2f} deg{}", std::abs(angle), side);
}

std::string shading_text(const SonarSpec& spec) {
  const Shading shading = shading_of(spec);
  const bool has_level = shading == Shading::taylor || shading == Shading::chebyshev;
  return shading_name(shading) + (has_level ? fmt::format(", side lobes {:g} dB", spec.side_lobe_db) : "");
}

ordered_json pattern_json(const SteeredBeam& beam, const BeamPatternReport& report) {
  ordered_json json = {{"sonar", beam.setup.spec.name},
                       {"elements", beam.array().elements()},
                       {"spacing_m", beam.array().spacing},
                       {"wavelength_m", beam.wavelength},
                       {"sound_speed", beam.setup.medium.sound_speed},
                       {"shading", shading_name(shading_of(beam.setup.spec))},
                       {"steering_deg", degrees(beam.steering)},
                       {"width_deg", degrees(report.width)},
                       {"first_null_deg", nullptr},
                       {"highest_side_lobe_db", nullptr},
                       {"highest_side_lobe_deg", nullptr},
                       {"grating_lobes_deg", ordered_json::array()},
                       {"directivity_index_db", report.directivity_index_db}};
  if (report.first_null) json["first_null_deg"] = degrees(*report.first_null);
  if (std::isfinite(report.highest_side_lobe_db)) {
    json["highest_side_lobe_db"] = report.highest_side_lobe_db;
    json["highest_side_lobe_deg"] = degrees(report.highest_side_lobe);
  }
  for (const double azimuth : report.grating_lobes) json["grating_lobes_deg"].push_back(degrees(azimuth));
  return json;
}

void print_pattern(const SteeredBeam& beam, const BeamPatternReport& report) {
  const std::string grating = joined(report.grating_lobes, ", ", direction_text);
  const bool has_side_lobe = std::isfinite(report.highest_side_lobe_db);
  fmt::print("{}, beam at {}\n", beam.setup.spec.name, direction_text(beam.steering));
  fmt::print("  elements       {}\n", beam.array().elements());
  fmt::print("  spacing        {:.4g} mm = {:.4g} wavelengths at {:.1f} m/s\n", 1e3 * beam.array().spacing,
             beam.array().spacing / beam.wavelength, beam.setup.medium.sound_speed);
  fmt::print("  shading        {}\n", shading_text(beam.setup.spec));
  fmt::print("  width          {:.3f} deg at -3 dB\n", degrees(report.width));
  fmt::print("  first null     {}\n",
             report.first_null ? fmt::format("{:.3f} deg off the beam", degrees(*report.first_null)) : "none");
  fmt::print("  side lobe      {}\n", has_side_lobe ? fmt::format("{:.2f} dB at {}", report.highest_side_lobe_db,
                                                                  direction_text(report.highest_side_lobe))
                                                    : "none");
  fmt::print("  grating lobes  {}\n", grating.empty() ? "none" : grating);
  fmt::print("  directivity    {:.2f} dB\n", report.directivity_index_db);
}

void draw_pattern(const SteeredBeam& beam, const PictureOptions& size, const std::string& output) {
  PictureOptions picture = size;
  picture.title = fmt::format("{}, beam at {}: {} elements, {}", beam.setup.spec.name, direction_text(beam.steering),
                              beam.array().elements(), shading_text(beam.setup.spec));
  const BeamPatternCurve curve = beam_pattern_curve(beam.array(), beam.wavelength, beam.steering);
  show_pattern(curve.azimuth, curve.level_db, picture, output);
}

void beampattern(const BeamPatternOptions& o) {
  Progress progress(o.common, o.output.empty() ? 1 : 2);
  PictureOptions picture;
  std::tie(picture.width, picture.height) = parse_size(o.size);
  picture.dark = o.dark;
  const double steering = parse_steering(o.steer);
  if (!o.output.empty()) require_free_file(o.output, o.force, {o.head.sonar});
  const PingSetup setup = set_up_head(o.head);
  if (!has_line(setup.head))
    fail(ErrorKind::argument, "beampattern measures beams of a line or plane, but ", setup.spec.name, " has a ",
         array_kinds[static_cast<std::size_t>(setup.head.array_shape)].name,
         " array; `insonify view` of a run draws its pattern");
  const SteeredBeam beam{setup, setup.medium.sound_speed / setup.spec.centre_frequency, steering};

  progress.step("measuring the beam of " + setup.spec.name);
  const BeamPatternReport report = measure_beam_pattern(beam.array(), beam.wavelength, beam.steering);
  if (!o.output.empty()) {
    progress.step("drawing " + o.output);
    draw_pattern(beam, picture, o.output);
  }
  ordered_json json = pattern_json(beam, report);
  if (!o.output.empty()) json["picture"] = o.output;
  print_result(o.common, json, [&] { print_pattern(beam, report); });
}

}  // namespace

Verb beampattern_verb() {
  return make_verb<BeamPatternOptions>(
      "beampattern", "width, side lobes and grating lobes of a sonar's beam",
      {"insonify beampattern p900-45 -o pattern.png",
       "insonify beampattern oculus-m750d --steer=-30 --set sonar.shading=chebyshev --json"},
      add_options, beampattern);
}

}  // namespace insonify::tool
