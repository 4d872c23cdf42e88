#include "tool/image_views.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "beamforming/beam_pattern.hpp"
#include "beamforming/beam_spectrum.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "tool/image_facts.hpp"
#include "tool/run_files.hpp"
#include "view/colour_maps_internal.hpp"
#include "view/show_ascan.hpp"
#include "view/show_fan.hpp"
#include "view/show_grey.hpp"
#include "view/show_panels.hpp"
#include "view/show_rect.hpp"
#include "view/show_spectrum.hpp"
#include "view/show_waterfall.hpp"

namespace insonify::tool {
namespace {

/// The samples as grey values, from the brightest level down to the window's end.
void draw_grey(const LevelImage& levels, const PictureOptions& picture, int bits, const std::string& path) {
  const double max_db = std::isnan(picture.max_db) ? levels.level_db.maxCoeff() : picture.max_db;
  const GreyWindow window{max_db - picture.window_db, max_db};
  if (bits == 8)
    show_grey(quantise_8(levels.level_db, window), levels.fan, path);
  else
    show_grey(quantise_16(levels.level_db, window), levels.fan, path);
}

std::string beam_text(const ChosenBeam& chosen, const BeamFan& fan) {
  if (chosen.choice == BeamChoice::strongest) return "strongest over all beams";
  if (chosen.choice == BeamChoice::mean) return "mean of all beams";
  const double bearing = -degrees(fan.azimuth[chosen.beam]);
  return fmt::format("beam {} at {:+.1f}°", chosen.beam, std::abs(bearing) < 0.05 ? 0.0 : bearing);
}

void draw_waterfall(const ImageRun& run, const ImageOptions& o, PictureOptions picture, const std::string& path) {
  const std::vector<Ping>& pings = run.cube.pings;
  if (pings.size() < 2)
    fail(ErrorKind::content, run.path, ": holds one ping, a waterfall needs several; join runs with insonify merge");
  const BeamFan& fan = pings.front().fan;
  const ChosenBeam chosen = choose_beam(o, fan.beams());
  PingHistory history;
  history.gate = pings.front().gate;
  history.level_db.resize(static_cast<Eigen::Index>(pings.size()), static_cast<Eigen::Index>(history.gate.bins()));
  for (std::size_t p = 0; p < pings.size(); ++p) {
    history.number.push_back(pings[p].number);
    history.time.push_back(pings[p].time);
    const LevelImage levels = levels_of(run, o, p);
    const auto row = static_cast<Eigen::Index>(p);
    if (chosen.choice == BeamChoice::one)
      history.level_db.row(row) = levels.level_db.row(static_cast<Eigen::Index>(chosen.beam));
    else
      history.level_db.row(row) = levels.level_db.colwise().maxCoeff();
    history.unit = levels.unit;
  }
  if (o.title.empty())
    picture.title = fmt::format("{}, {} pings, {}", run.cube.sonar, pings.size(), beam_text(chosen, fan));
  show_waterfall(history, picture, path);
}

/// Spectrum of the beams chosen, and that of the pulse with as much power.
std::vector<SpectrumLine> spectrum_lines(const ImageRun& run, const ImageOptions& o, std::size_t number) {
  const Ping& ping = run.cube.pings[number];
  const ChosenBeam chosen = choose_beam(o, ping.fan.beams());
  std::vector<std::size_t> beams{chosen.beam};
  if (chosen.choice == BeamChoice::mean) {
    beams.resize(ping.fan.beams());
    std::iota(beams.begin(), beams.end(), 0);
  }
  const double step_time = 2 * ping.gate.bin_size / run.cube.sound_speed;
  const BeamSpectrum heard = beam_spectrum(ping.pressure, beams, step_time, {run.cube.centre_frequency, 0});
  const double power =
      std::accumulate(heard.density.begin(), heard.density.end(), 0.0) * (heard.frequency[1] - heard.frequency[0]);
  Pulse pulse;
  if (run.head) pulse = run.head->pulse;
  pulse.centre_frequency = run.cube.centre_frequency;
  pulse.bandwidth = run.cube.bandwidth;
  const std::string name =
      fmt::format("pulse, {} of {:g} kHz", pulse.shape == PulseShape::gaussian ? "Gaussian" : "linear FM sweep",
                  pulse.bandwidth / 1000);
  return {{heard.frequency, heard.density, beam_text(chosen, ping.fan)},
          {heard.frequency, pulse_density(pulse, step_time, heard.frequency, power), name}};
}

/// With the beam's pattern if the run says what array heard it, and what the picture cannot show in words.
Panels panels_of(const ImageRun& run, const ImageOptions& o, std::size_t number) {
  Panels panels;
  panels.image = levels_of(run, o, number);
  const BeamFan& fan = panels.image.fan;
  panels.beam = choose_beam(o, fan.beams()).beam;
  panels.facts = facts_of(run.cube, number);
  const double steering = fan.azimuth[panels.beam];
  if (!run.head || std::abs(steering) > pi / 2) return panels;
  const LineArray& array = run.head->array;
  const BeamPatternCurve curve = beam_pattern_curve(array, run.cube.sound_speed / run.cube.centre_frequency, steering);
  panels.azimuth = curve.azimuth;
  panels.pattern_db = curve.level_db;
  panels.pattern_title = fmt::format("Pattern of {}, {} elements", beam_text({{}, panels.beam}, fan), array.elements());
  return panels;
}

double next_five(double level_db) { return 5 * std::floor(level_db / 5) + 5; }

}  // namespace

void draw_view(const ImageRun& run, const ImageOptions& o, const PictureOptions& asked, std::size_t number,
               const std::string& path) {
  PictureOptions picture = asked;
  const Ping& ping = run.cube.pings[number];
  const std::string title = picture_title(run.cube.sonar, ping) + (o.layer.empty() ? "" : ", " + o.layer + " alone");
  picture.title = o.title.empty() ? title : o.title;
  if (o.view == "waterfall") return draw_waterfall(run, o, picture, path);
  if (o.view == "spectrum") return show_spectrum(spectrum_lines(run, o, number), picture, path);
  if (o.view == "panels") return show_panels(panels_of(run, o, number), picture, path);
  const LevelImage levels = levels_of(run, o, number);
  if (o.view == "fan") show_fan(levels, picture, path);
  if (o.view == "rect") show_rect(levels, picture, path);
  if (o.view == "ascan") show_ascan(levels, choose_beam(o, ping.fan.beams()).beam, picture, path);
  if (o.view == "grey") draw_grey(levels, picture, o.bits, path);
}

double common_max_db(const ImageRun& run, const ImageOptions& o, double window_db) {
  double highest = -std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < run.cube.pings.size(); ++p) {
    double max_db = 0;
    if (o.view == "spectrum") {
      for (const SpectrumLine& line : spectrum_lines(run, o, p))
        max_db = std::max(max_db, *std::max_element(line.density.begin(), line.density.end()));
      max_db = next_five(db_from_power(max_db / (micropascal * micropascal)));
    } else {
      const LevelImage levels = levels_of(run, o, p);
      const auto beam = static_cast<Eigen::Index>(choose_beam(o, levels.fan.beams()).beam);
      max_db = o.view == "ascan"  ? next_five(levels.level_db.row(beam).maxCoeff())
               : o.view == "grey" ? levels.level_db.maxCoeff()
                                  : automatic_max_db(levels.level_db, window_db);
    }
    highest = std::max(highest, max_db);
  }
  return highest;
}

}  // namespace insonify::tool
