#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "beamforming/numerics/beam_spectrum.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "files/pending_file.hpp"
#include "returns/picture_grid.hpp"
#include "sonar/beam_pattern.hpp"
#include "tool/dataset/label_pictures.hpp"
#include "tool/image/image.hpp"
#include "tool/image/scan_image.hpp"
#include "tool/image/side_scan.hpp"
#include "tool/image/track_image.hpp"
#include "tool/run/run_files.hpp"
#include "tool/run/run_pings.hpp"
#include "view/colour_maps_internal.hpp"
#include "view/label_colours.hpp"
#include "view/show_image.hpp"

namespace insonify::tool {
namespace {

LevelImage levels_of(const ViewJob& job) { return levels_of(job.run, job.options, job.ping); }

const BeamFan& fan_of(const ViewJob& job) { return job.run.cube.pings[job.ping].fan; }

void draw_fan(const ViewJob& job) { show_fan(levels_of(job), job.picture, job.path); }

void draw_rect(const ViewJob& job) { show_rect(levels_of(job), job.picture, job.path); }

void draw_ascan(const ViewJob& job) {
  const std::size_t beam = choose_beam(job.options, fan_of(job)).beam;
  show_ascan(levels_of(job), beam, job.picture, job.path);
}

/// Draws the samples as grey values: white at the brightest level, black at the end of the window.
void draw_grey(const ViewJob& job) {
  const LevelImage levels = levels_of(job);
  const PictureOptions& picture = job.picture;
  const double max_db = std::isnan(picture.max_db) ? levels.level_db.maxCoeff() : picture.max_db;
  const GreyWindow window{max_db - picture.window_db, max_db};
  if (job.options.bits == 8)
    show_grey(quantise_8(levels.level_db, window), levels.fan, job.path);
  else
    show_grey(quantise_16(levels.level_db, window), levels.fan, job.path);
}

/// Draws the classes of the pixels in true geometry, as view fan lies, and writes what the colours mean beside it.
void draw_labels(const ViewJob& job) {
  const Ping& whole = job.run.cube.pings[job.ping];
  if (whole.labels.empty())
    fail(ErrorKind::content, job.run.path, ": ping ", job.ping,
         " has no labels: make the run with --keep contributors");
  const Ping ping = row_of(whole, rows_of(whole) / 2);
  const std::vector<std::string> classes = class_names(ping.labels);
  const Grid<float> level =
      level_image(ping, job.options.raw ? std::nullopt : std::optional(Tvg{job.options.tvg, whole.absorption_db_per_m}))
          .level_db;
  const ColourScale scale = colour_scale(level, job.picture, "image");
  const Grid<std::uint8_t> category = classes_above(classes_of(ping.labels, least_label_share, classes), level,
                                                    parse_min_level(job.options.min_level, scale.min_db));
  const FanRaster raster = fan_raster(ping.fan, ping.gate, job.picture.width);
  save_label_png(job.path, fan_picture(category, raster, std::uint8_t{0}));
  nlohmann::ordered_json palette{{"least_share", least_label_share},
                                 {"metres_per_pixel", raster.metres_per_pixel},
                                 {"head_column", raster.head_column},
                                 {"head_row", raster.head_row},
                                 {"classes", palette_json(classes)}};
  for (auto& row : palette["classes"]) row["samples"] = (category == row["value"].get<std::uint8_t>()).count();
  write_file(std::filesystem::path(job.path).replace_extension(".json").string(), palette.dump(2) + "\n");
}

std::string beam_text(const ChosenBeam& chosen, const BeamFan& fan) {
  if (chosen.choice == BeamChoice::strongest) return "strongest over all beams";
  if (chosen.choice == BeamChoice::mean) return "mean of all beams";
  const double bearing = -degrees(fan.azimuth[chosen.beam]);
  return fmt::format("beam {} at {:+.1f}°", chosen.beam, std::abs(bearing) < 0.05 ? 0.0 : bearing);
}

/// Spectrum of the chosen beams, and the spectrum of the pulse scaled to the same power.
std::vector<SpectrumLine> spectrum_lines(const ImageRun& run, const ImageOptions& o, std::size_t number) {
  const Ping& ping = run.cube.pings[number];
  const ChosenBeam chosen = choose_beam(o, ping.fan);
  std::vector<std::size_t> beams{chosen.beam};
  if (chosen.choice == BeamChoice::mean) {
    beams.resize(ping.fan.beams());
    std::iota(beams.begin(), beams.end(), 0);
  }
  const double step_time = 2 * ping.gate.bin_size / ping.sound_speed;
  const BeamSpectrum received = beam_spectrum(ping.pressure, beams, step_time, {run.cube.centre_frequency, 0});
  const double power = std::accumulate(received.density.begin(), received.density.end(), 0.0) *
                       (received.frequency[1] - received.frequency[0]);
  Pulse pulse;
  if (run.head) pulse = run.head->pulse;
  pulse.centre_frequency = run.cube.centre_frequency;
  pulse.bandwidth = run.cube.bandwidth;
  const std::string name =
      fmt::format("pulse, {} of {:g} kHz", pulse.shape == PulseShape::gaussian ? "Gaussian" : "linear FM sweep",
                  pulse.bandwidth / 1000);
  return {{received.frequency, received.density, beam_text(chosen, ping.fan)},
          {received.frequency, pulse_density(pulse, step_time, received.frequency, power), name}};
}

void draw_spectrum(const ViewJob& job) {
  show_spectrum(spectrum_lines(job.run, job.options, job.ping), job.picture, job.path);
}

/// Image and facts of a ping, and the pattern of the beam if the run says with which array it was received.
Panels panels_of(const ImageRun& run, const ImageOptions& o, std::size_t number) {
  Panels panels;
  panels.image = levels_of(run, o, number);
  const BeamFan& fan = panels.image.fan;
  panels.beam = choose_beam(o, fan).beam;
  panels.facts = facts_of(run.cube, number);
  const double steering = fan.azimuth[panels.beam];
  if (!run.head || std::abs(steering) > pi / 2) return panels;
  const LineArray& array = run.head->array;
  const BeamPatternCurve curve =
      beam_pattern_curve(array, run.cube.pings[number].sound_speed / run.cube.centre_frequency, steering);
  panels.azimuth = curve.azimuth;
  panels.pattern_db = curve.level_db;
  panels.pattern_title = fmt::format("Pattern of {}, {} elements", beam_text({{}, panels.beam}, fan), array.elements());
  return panels;
}

void draw_soundings(const ViewJob& job) {
  const Environment environment = find_run_pings(job.run.path, "").environment;
  const Ping& ping = job.run.cube.pings[job.ping];
  show_soundings(ping, detect_bottom(ping, bottom_options(job.run.cube, ping, environment, 1)), job.picture, job.path);
}

/// The sweep of the ping.
void draw_scan(const ViewJob& job) {
  const bool in_world = job.options.frame == "world";
  PictureOptions picture = job.picture;
  if (job.options.title.empty())
    picture.title =
        fmt::format("{}, sweep {}{}", job.run.cube.sonar, job.run.cube.pings[job.ping].scan.value_or(ScanPlace{}).sweep,
                    in_world ? ", motion compensated" : "");
  show_fan((in_world ? sweep_in_world : sweep_of_head)(job.run, job.options, job.ping), picture, job.path);
}

void draw_panels(const ViewJob& job) { show_panels(panels_of(job.run, job.options, job.ping), job.picture, job.path); }

double next_five(double level_db) { return 5 * std::floor(level_db / 5) + 5; }

double max_db_of_image(const ImageRun& run, const ImageOptions& o, std::size_t ping) {
  return automatic_max_db(levels_of(run, o, ping).level_db, o.window_db);
}

double max_db_of_ascan(const ImageRun& run, const ImageOptions& o, std::size_t ping) {
  const LevelImage levels = levels_of(run, o, ping);
  return next_five(levels.level_db.row(static_cast<Eigen::Index>(choose_beam(o, levels.fan).beam)).maxCoeff());
}

double max_db_of_spectrum(const ImageRun& run, const ImageOptions& o, std::size_t ping) {
  double highest = 0;
  for (const SpectrumLine& line : spectrum_lines(run, o, ping))
    highest = std::max(highest, *std::max_element(line.density.begin(), line.density.end()));
  return next_five(db_from_power(highest / (micropascal * micropascal)));
}

}  // namespace

const std::vector<ViewSpec>& all_views() {
  static const std::vector<ViewSpec> views{
      {"fan", "beams and ranges to scale", {"--annotate", "--animate"}, draw_fan, max_db_of_image},
      {"rect", "beams against range", {"--annotate", "--animate"}, draw_rect, max_db_of_image},
      {.name = "waterfall",
       .shows = "range against pings",
       .options = {"--starboard", "--altitude", "--bottom"},
       .draw = draw_waterfall,
       .beam_word = "max",
       .beam_choice = BeamChoice::strongest},
      {"ascan", "level of one beam against range", {"--animate"}, draw_ascan, max_db_of_ascan},
      {"spectrum",
       "power against frequency",
       {"--animate"},
       draw_spectrum,
       max_db_of_spectrum,
       "all",
       BeamChoice::mean,
       BeamChoice::mean},
      {"panels", "fan, one beam, its pattern and facts", {"--annotate", "--animate"}, draw_panels, max_db_of_image},
      {.name = "soundings", .shows = "soundings of the bottom across the track", .draw = draw_soundings},
      {.name = "scan", .shows = "the sweep of a scanning head", .options = {"--frame"}, .draw = draw_scan},
      {.name = "track", .shows = "a merged survey from above: ways, and mosaic or returns", .draw_alone = draw_track},
      {.name = "scene",
       .shows = "the scene in 3-D with returns, or as the head sees it",
       .options = {"--scene", "--sonar", "--pose", "--range", "--camera", "--colour", "--normals"},
       .draw_alone = image_scene},
      {.name = "labels",
       .shows =
           "what every pixel shows by class, in the colours of a .json beside it, of a run with --keep contributors",
       .options = {"--min-level"},
       .draw = draw_labels},
      {.name = "grey", .shows = "the bare samples as 8- or 16-bit .png or .pgm", .draw = draw_grey},
  };
  return views;
}

std::string chosen_beam_text(const ViewJob& job) {
  const BeamFan& fan = fan_of(job);
  return beam_text(choose_beam(job.options, fan), fan);
}

const ViewSpec& view_of(const ImageOptions& o) {
  const auto is_asked_for = [&](const ViewSpec& view) { return o.view == view.name; };
  return *std::find_if(all_views().begin(), all_views().end(), is_asked_for);
}

std::string views_with(const std::string& option) {
  std::vector<std::string> names;
  for (const ViewSpec& view : all_views())
    if (std::find(view.options.begin(), view.options.end(), option) != view.options.end())
      names.emplace_back(view.name);
  const std::string last = names.back();
  names.pop_back();
  return names.empty() ? last : joined(names) + " or " + last;
}

ChosenBeam choose_beam(const ImageOptions& o, const BeamFan& fan) {
  const ViewSpec& view = view_of(o);
  const std::size_t beams = fan.beams();
  if (o.beam.empty()) return {view.default_choice, middle_beam(fan)};
  if (o.beam == view.beam_word) return {view.beam_choice};
  const double beam = parse_number("--beam", o.beam);
  if (!(beam >= 0 && beam == std::floor(beam)))
    fail(ErrorKind::argument, "--beam = ", o.beam, ", must be the number of a beam, from 0");
  if (beam >= static_cast<double>(beams))
    fail(ErrorKind::argument, "--beam = ", o.beam, ", must be below ", beams, ", the number of beams");
  return {BeamChoice::one, static_cast<std::size_t>(beam)};
}

std::string default_title(const ImageRun& run, const ImageOptions& o, std::size_t ping) {
  return picture_title(run.cube.sonar, run.cube.pings[ping]) + (o.layer.empty() ? "" : ", " + o.layer + " alone");
}

}  // namespace insonify::tool
