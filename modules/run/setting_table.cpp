// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "beamforming/engine.hpp"
#include "core/text.hpp"
#include "run/parse_values.hpp"
#include "run/requested_simulation.hpp"
#include "run/run_settings.hpp"
#include "run/setting_values_internal.hpp"

namespace insonify {
namespace {

constexpr Named<SamplingKind> sampling_words[] = {{"surfels", SamplingKind::surfels}, {"rays", SamplingKind::rays}};
constexpr Named<SurfaceAmplitude> amplitude_words[] = {{"speckle", SurfaceAmplitude::complex_normal},
                                                       {"random-phase", SurfaceAmplitude::random_phase},
                                                       {"coherent", SurfaceAmplitude::coherent}};
constexpr const char *place_meaning = "x,y,z in metres",
                     *pose_meaning = "x,y,z,yaw,pitch,roll in metres and degrees, e.g. 0,0,-3,0,10,0";

std::vector<std::string> words_of_methods() {
  std::vector<std::string> words{planned_word};
  for (const Engine& engine : engines()) words.emplace_back(engine.word);
  return words;
}

std::vector<std::string> words_of_outputs() {
  std::vector<std::string> words = words_of(kept_outputs);
  words.insert(words.end(), {"contributors", "paths"});
  return words;
}

const OptionRules scene{.required = true}, file, above_zero{.positive = true}, stages{.one_each = true};
const OptionRules methods{.words = words_of_methods()};
const OptionRules worlds{.words = words_of(world_words)};
const OptionRules samplings{.words = words_of(sampling_words)};
const OptionRules amplitudes{.words = words_of(amplitude_words)};
const OptionRules outputs{.words = words_of_outputs(), .one_each = true, .comma_separated = true};
const OptionRules contributor_numbers{.within = std::pair(1, 255), .shown_as = "INT"};
const OptionRules ping_numbers{.within = std::pair(-1, 1000000000), .shown_as = "INT"};
const OptionRules draw_numbers{.within = std::pair(0, 1000000000), .shown_as = "INT"};
const OptionRules bits{.within = std::pair(1, 24), .shown_as = "INT"};
const OptionRules looks{.within = std::pair(1, 1024), .shown_as = "INT"};
const OptionRules display_cells{.within = std::pair(0, 65536), .shown_as = "CELLS"};
const OptionRules absorption_orders{.within = std::pair(-1, 2), .shown_as = "INT"};

/// The settings, each under the title of the last key in `titles` at or before it.
std::vector<RunSetting> under_titles(std::vector<RunSetting> settings,
                                     const std::map<std::string, const char*>& titles) {
  const char* title = nullptr;
  for (RunSetting& setting : settings) {
    if (const auto begins = titles.find(setting.key); begins != titles.end()) title = begins->second;
    setting.rules.group = title;
  }
  return settings;
}

}  // namespace

std::vector<RunSetting> meaning_settings(MeaningOverride& o) {
  std::vector<RunSetting> settings;
  for (const MeaningOption& row : meaning_options()) {
    const auto get = [&o, row] { return std::optional(row.text(o)); };
    const auto set = [&o, row](const std::string& text) { row.parse(text, o); };
    settings.push_back({"scene", row.key, row.option, Shown<std::string>{{get, set}, meaning(o, row)}, row.help});
  }
  return settings;
}

std::vector<RunSetting> scene_settings(SceneOptions& o) {
  std::vector<RunSetting> settings{
      {"scene", "path", "SCENE", &o.path, "cloud, mesh or scene of parts", scene, true},
      {"scene", "viewpoint", "--viewpoint", numbers_in(o.viewpoint, place_meaning),
       "x,y,z [m] of the scanner, to which estimated normals turn; default: the viewpoint in the file, else 0,0,0 for "
       "an organised scan that fans out from there, and a point above for a raster of heights"},
      {"scene", "materials", "--materials", &o.materials_file, "TOML table of materials for the labels of the cloud",
       file, true},
      {"scene", "material_field", "--material-field", &o.material_field,
       "field of the cloud that holds materials, e.g. classification"},
      {"scene", "material", "--material", &o.material, "name of one material for the whole scene, e.g. sand"},
      {"scene", "mesh_spacing", "--mesh-spacing", &o.mesh_spacing,
       "[m] distance between surfels of a mesh or height field; 0: ping samples as finely as its beams resolve, other "
       "verbs take 200 000 surfels"},
      {"scene", "scan_noise", "--scan-noise", number_in(o.scan_noise, "metres"),
       "[m] standard deviation of the points across the surfaces; 0: heights are not smoothed; default: the field "
       "'noise' of the cloud, else an estimate"},
      {"scene", "keep_strays", "--keep-strays", &o.keep_strays, "give isolated points the area of their whole cell"},
  };
  const auto behind = std::ranges::find(settings, std::string_view("material"), &RunSetting::key) + 1;
  std::vector<RunSetting> meaning = meaning_settings(o.meaning);
  settings.insert(behind, std::make_move_iterator(meaning.begin()), std::make_move_iterator(meaning.end()));
  return under_titles(std::move(settings), {{"viewpoint", scene_title}});
}

std::vector<RunSetting> synthesis_settings(SynthesisSettings& s) {
  std::vector<RunSetting> settings{
      {"", "tolerance", "--tolerance", &s.tolerance, "relative error of the synthesis"},
      {"", "method", "--method", method_word(s),
       std::string(planned_word) + ": true-delays if the error of the narrow band is too large, else gridded; " +
           joined(engines(), "; ", [](const Engine& e) { return fmt::format("{}: {}", e.word, e.says); }),
       methods},
  };
  return under_titles(std::move(settings), {{"tolerance", accuracy_title}});
}

RunSetting accuracy_setting(double& accuracy_db, const char* section) {
  return {section, "accuracy_db", "--accuracy-db", &accuracy_db,
          "[dB] largest error by effects that the plan leaves out; `insonify plan` lists these effects"};
}

RunSetting absorption_setting(std::optional<int>& order, const char* section) {
  return {section,
          "absorption_order",
          "--absorption-order",
          order_of(order),
          "absorption within the pulse's band: 0: constant; 1: with its slope; 2: with its curvature too; -1: the "
          "order that --accuracy-db needs",
          absorption_orders};
}

RunSetting seed_setting(std::uint64_t& seed) {
  return {"", "seed", "--seed", &seed, "seed of all random numbers; the same seed gives the same bytes"};
}

namespace {

/// Where the head is, and what it receives.
std::vector<RunSetting> sent_settings(Run& run) {
  Placement& at = run.placement;
  SimulationOptions& o = run.simulation;
  return {
      {"ping", "pose", "--pose", numbers_in(at.pose, pose_meaning),
       "x,y,z,yaw,pitch,roll [m, deg] of the head; pitch is positive nose down"},
      {"ping", "mount", "--mount", numbers_in(at.mount, pose_meaning),
       "x,y,z,yaw,pitch,roll [m, deg] of the head on a vehicle; --pose is then the pose of the vehicle. Default: "
       "mounting_deg of the sonar's file (straight down for swath sonars), else the head is at --pose"},
      {"ping", "trajectory", "--trajectory", &at.trajectory,
       "CSV time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg that replaces --pose", file, true},
      {"ping", "time", "--time", &at.time, "[s] time of transmission on the trajectory"},
      {"ping", "ping", "--ping", &at.number,
       "number of the ping; each number draws other noise, waves and water; -1: the time in milliseconds",
       ping_numbers},
      {"ping", "draw", "--draw", &at.draw,
       "number of the draw of the [[scatter]] tables of a scene of parts, counted as by [randomise] scene of a mission",
       draw_numbers},
      {"ping", "world", "--world", shown_as_word(at.world, world_words),
       "axes of --pose: z-up, or ned (z down, pitch positive nose up)", worlds},
      accuracy_setting(o.accuracy_db),
      {"ping", "sampling", "--sampling", shown_as_word(o.sampling.kind, sampling_words),
       "how the scene is sampled: surfels or rays", samplings},
      {"ping", "scatterers_per_cell", "--scatterers-per-cell", &o.sampling.scatterers_per_cell,
       "least number of scatterers in a resolution cell; surfels are split until it holds them"},
      {"ping", "detail_width", "--detail-width", &o.sampling.detail_width,
       "[beam widths] surfels of dense clouds are merged up to this width; 0: none, but of many display images of a "
       "scene where that pays; --with detail takes 1"},
      {"ping", "detail_spacing", "--detail-spacing", &o.sampling.detail_spacing,
       "[m] instead of --detail-width: surfels are merged up to this width at all ranges, so that passes over one "
       "place share their scatterers"},
      {"ping", "rays_per_beam", "--rays-per-beam", &o.sampling.rays_per_beam,
       "rays for each beam, with --sampling rays"},
      {"ping", "amplitude", "--amplitude", shown_as_word(o.amplitude, amplitude_words),
       "phases of the scatterers: speckle, random-phase or coherent", amplitudes},
      {"ping", "noise", "--noise", &o.effects.noise,
       "add thermal noise, and noise of wind and platform if the environment gives them"},
      {"ping", "multipath", "--multipath", is_requested(o.effects.multipath),
       "add echoes by way of the environment's surface and bottom, even if --accuracy-db does not need them"},
      {"ping", "double_echoes", "--double-echoes", &o.effects.double_echoes,
       "rays from each resolution cell of a surface, for echoes by way of two surfaces; 0: no such echoes; --with "
       "double-echoes takes 2"},
  };
}

/// Lists the settings of what is kept of a ping, refined, detected and limited.
std::vector<RunSetting> kept_settings(Run& run) {
  SimulationOptions& o = run.simulation;
  return {
      {"ping", "keep", "--keep", &run.keep,
       "further outputs, separated by commas. elements: elements.h5, the series of every element of a line array; "
       "mask: the holes of the scan, marked in the cube; labels: what every display cell shows (--display, 600 unless "
       "given); contributors: contributors.h5, the strongest surfels of every pixel; insonification: the scene with "
       "the received levels as .ply and .pcd; paths: paths.vtp, the paths of the strongest echoes as lines",
       outputs},
      {"ping", "contributors", "--contributors", &run.contributors, "surfels of each pixel, with --keep contributors",
       contributor_numbers},
      {"ping", "keep_bits", "--keep-bits", &run.output.keep_bits,
       "significant bits of the cube's pressures. 24 keeps all bits. Fewer bits round each number by at most 2^-BITS "
       "of it, and the cube is deflated: 12 bits (0.002 dB) halve its size",
       bits},
      {"ping", "layers", "--layers", &o.outputs.layers, "write each kind of echo as a layer of the cube"},
      {"ping", "split", "--split", &o.outputs.split_phase,
       "write the phase between the halves of the array, from which export finds soundings of the bottom; the "
       "synthesis takes three times as long"},
      {"ping", "display", "--display", &o.outputs.display_bins,
       "display cells along range, e.g. 600: the run holds the mean level of each cell in place of samples of "
       "pressure. "
       "Cells cost a small part of the samples, which are formed only where the plan's row phases says so; 0: samples",
       display_cells},
      {"ping", "looks_range", "--looks-range", &o.outputs.looks_range,
       "range bins that pictures and /intensity of the cube average", looks},
      {"ping", "looks_pings", "--looks-pings", &o.outputs.looks_pings,
       "pulses of independent speckle that pictures and /intensity average; each pulse takes the time of a whole ping",
       looks},
      absorption_setting(o.effects.absorption_order),
      {"ping", "velocity", "--velocity", numbers_in(run.placement.velocity, "vx,vy,vz in m/s"),
       "vx,vy,vz [m/s] of the head in the world"},
      {"ping", "turn_rate", "--turn-rate", numbers_in(run.placement.turn_rate, "x,y,z in deg/s"),
       "x,y,z [deg/s]: rotation vector of the head in the world"},
      {"ping", "threshold_db", "--threshold", &o.detection.threshold_db,
       "[dB] least level of a detection above the noise floor"},
      {"ping", "false_alarm_rate", "--false-alarm-rate", &o.detection.false_alarm_rate,
       "rate of detections in speckle as strong as its surroundings (cell averaging); 1: surroundings do not count"},
      {"ping", "all_bins_above", "--all-bins-above", all_bins_above(o.detection),
       "[dB re 1 uPa] every bin above this level becomes a return"},
      {"ping", "memory_limit_gib", "--memory-limit", &run.memory_limit,
       "[GiB] memory for the scene of a ping. Tiles that need more are refused before they are read; default: the "
       "available memory. A mesh that needs more is sampled more coarsely; default: 1.5",
       above_zero},
      {"ping", "with", "--with", &run.with, "include this stage of the plan; may be given several times", stages},
      {"ping", "without", "--without", &run.without, "leave out this stage of the plan; may be given several times",
       stages},
  };
}

}  // namespace

std::vector<RunSetting> ping_settings(Run& run) {
  std::vector<RunSetting> all = sent_settings(run);
  for (RunSetting& setting : kept_settings(run)) all.push_back(std::move(setting));
  return under_titles(std::move(all), {{"pose", head_title},
                                       {"accuracy_db", accuracy_title},
                                       {"amplitude", sound_title},
                                       {"keep", output_title},
                                       {"absorption_order", sound_title},
                                       {"velocity", head_title},
                                       {"threshold_db", detection_title},
                                       {"memory_limit_gib", scene_title},
                                       {"with", accuracy_title}});
}

namespace {

/// Returns true if a setting says what is pinged, from where and when.
bool is_of_one_ping(const RunSetting& setting) {
  const std::vector<std::string> keys = {"path", "pose", "mount", "trajectory", "time",
                                         "ping", "draw", "world", "velocity",   "turn_rate"};
  return std::find(keys.begin(), keys.end(), setting.key) != keys.end();
}

}  // namespace

std::vector<RunSetting> simulator_settings(Run& run) {
  std::vector<RunSetting> all{seed_setting(run.simulation.seed)};
  for (const auto& group : {synthesis_settings(run.simulation.synthesis), ping_settings(run)})
    for (const RunSetting& setting : group)
      if (!is_of_one_ping(setting)) all.push_back(setting);
  return all;
}

std::vector<RunSetting> mission_settings(Run& run) {
  // All but what the mission says in its own tables; some outputs are of a single ping alone.
  std::vector<RunSetting> all;
  for (auto& group : {scene_settings(run.scene), synthesis_settings(run.simulation.synthesis), ping_settings(run)})
    for (RunSetting setting : group) {
      if (*setting.section == '\0') setting.section = "ping";
      if (std::string_view(setting.key) == "keep") setting.rules.words = {"labels", "contributors", "mask"};
      if (!is_of_one_ping(setting)) all.push_back(setting);
    }
  return all;
}

std::vector<RunSetting> all_settings(Run& run) {
  std::vector<RunSetting> all{seed_setting(run.simulation.seed)};
  for (const auto& group :
       {synthesis_settings(run.simulation.synthesis), scene_settings(run.scene), ping_settings(run)})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

std::vector<std::string> input_files(const std::vector<RunSetting>& settings) {
  std::vector<std::string> files;
  for (const RunSetting& setting : settings)
    if (setting.is_path) files.push_back(*std::get<std::string*>(setting.value));
  return files;
}

}  // namespace insonify
