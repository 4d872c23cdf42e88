// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <utility>

#include "tool/command/parse_values.hpp"
#include "tool/command/run_settings.hpp"

namespace insonify::tool {
namespace {

const OptionRules scene{.required = true}, file, positive{.positive = true}, stages{.one_each = true};
const OptionRules methods{.words = words_of(method_words)};
const OptionRules worlds{.words = {"z-up", "ned"}};
const OptionRules samplings{.words = words_of(sampling_words)};
const OptionRules amplitudes{.words = words_of(amplitude_words)};
const OptionRules outputs{.words = {"elements", "mask", "contributors", "insonification", "paths"},
                          .one_each = true,
                          .comma_separated = true};
const OptionRules contributor_numbers{.within = std::pair(1, 255), .shown_as = "INT"};
const OptionRules ping_numbers{.within = std::pair(-1, 1000000000), .shown_as = "INT"};
const OptionRules draw_numbers{.within = std::pair(0, 1000000000), .shown_as = "INT"};
const OptionRules bits{.within = std::pair(1, 24), .shown_as = "INT"};
const OptionRules looks{.within = std::pair(1, 1024), .shown_as = "INT"};
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

std::vector<RunSetting> scene_settings(SceneOptions& o) {
  std::vector<RunSetting> settings{
      {"scene", "path", "SCENE", &o.path, "cloud, mesh or scene of parts", scene, true},
      {"scene", "viewpoint", "--viewpoint", &o.viewpoint,
       "x,y,z [m] where the capture stood; orients estimated normals; default: the file's, else 0,0,0 of an organised "
       "scan that fans out from there, and from above of a raster of heights"},
      {"scene", "materials", "--materials", &o.materials_file, "TOML table of materials for the labels of the cloud",
       file, true},
      {"scene", "material_field", "--material-field", &o.material_field,
       "field of the cloud that means materials, e.g. classification"},
      {"scene", "material", "--material", &o.material, "one material for everything, by name, e.g. sand"},
      {"scene", "unit", "--unit", &o.unit, "of the file: m, mm, cm, km, ft, or metres per unit"},
      {"scene", "mesh_spacing", "--mesh-spacing", &o.mesh_spacing,
       "[m] between surfels of a mesh or height field; 0: a ping samples it by what its beams resolve, other verbs "
       "take 200 000 "
       "surfels"},
      {"scene", "scan_noise", "--scan-noise", &o.scan_noise,
       "[m] standard deviation of a cloud across its surfaces; default: its field 'noise', else estimated"},
      {"scene", "keep_strays", "--keep-strays", &o.keep_strays,
       "points far from all others keep areas as large as their cells"},
  };
  return under_titles(std::move(settings), {{"viewpoint", scene_title}});
}

std::vector<RunSetting> synthesis_settings(RunOptions& o) {
  std::vector<RunSetting> settings{
      {"", "tolerance", "--tolerance", &o.tolerance, "relative error of the synthesis"},
      {"", "method", "--method", &o.method,
       "planned: true-delays where the narrow band costs too much; gridded: narrow band, far field; true-delays: wide "
       "band and near field, slow within three lengths of the array; direct and element-exact: the slow referees of "
       "both; or incoherent: the expected level, no speckle",
       methods},
  };
  return under_titles(std::move(settings), {{"tolerance", accuracy_title}});
}

RunSetting accuracy_setting(double& accuracy_db, const char* section) {
  return {section, "accuracy_db", "--accuracy-db", &accuracy_db,
          "[dB] budget of all that is left out as not needed; `insonify plan` shows what that is"};
}

RunSetting absorption_setting(int& order, const char* section) {
  return {section,
          "absorption_order",
          "--absorption-order",
          &order,
          "0: one absorption for the pulse; 1, 2: slope, curvature; -1: as --accuracy-db needs",
          absorption_orders};
}

RunSetting seed_setting(CommonOptions& o) {
  return {"", "seed", "--seed", &o.seed, "of all random numbers; same seed, same bytes"};
}

namespace {

/// Where the head is, and what it hears.
std::vector<RunSetting> sent_settings(PingOptions& o) {
  return {
      {"ping", "pose", "--pose", &o.pose, "x,y,z,yaw,pitch,roll [m, deg]; pitch positive nose down"},
      {"ping", "mount", "--mount", &o.mount,
       "x,y,z,yaw,pitch,roll [m, deg] of the head on the vehicle, whose pose --pose is then; default: as the sonar's "
       "file "
       "says (mounting_deg), straight down for swaths, else at the pose itself"},
      {"ping", "trajectory", "--trajectory", &o.trajectory,
       "instead of --pose: CSV time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg", file, true},
      {"ping", "time", "--time", &o.time, "of transmission on the trajectory [s]"},
      {"ping", "ping", "--ping", &o.ping,
       "number of the ping: noise, waves and water are drawn anew for each; -1: the time in milliseconds",
       ping_numbers},
      {"ping", "draw", "--draw", &o.draw,
       "of a scene of parts: number of the draw of its [[scatter]]s, as [randomise] scene of a mission counts them",
       draw_numbers},
      {"ping", "world", "--world", &o.world, "z-up, or ned: z down, pitch positive nose up", worlds},
      accuracy_setting(o.accuracy_db),
      {"ping", "sampling", "--sampling", &o.sampling, "surfels or rays", samplings},
      {"ping", "scatterers_per_cell", "--scatterers-per-cell", &o.scatterers_per_cell,
       "surfels are split until a resolution cell holds so many"},
      {"ping", "detail_width", "--detail-width", &o.detail_width,
       "surfels of dense clouds are merged up to this width, in beam widths; 0: none; --with detail takes 0.5"},
      {"ping", "rays_per_beam", "--rays-per-beam", &o.rays_per_beam, "with --sampling rays"},
      {"ping", "amplitude", "--amplitude", &o.amplitude, "speckle, random-phase or coherent", amplitudes},
      {"ping", "noise", "--noise", &o.noise,
       "add thermal noise, and the wind's and the platform's if the environment has them"},
      {"ping", "multipath", "--multipath", &o.multipath,
       "add echoes by way of the environment's surface and bottom even where --accuracy-db does not need them"},
      {"ping", "double_echoes", "--double-echoes", &o.double_echoes,
       "rays from each resolution cell of the surface for echoes by way of two surfaces; 0: none; --with double-echoes "
       "takes 2"},
  };
}

/// What is kept of it, and what is refined, detected and limited.
std::vector<RunSetting> kept_settings(PingOptions& o) {
  return {
      {"ping", "keep", "--keep", &o.keep,
       "elements: also write elements.h5, the series of every element of a line array; mask: mark in the cube where "
       "the scan has holes; contributors: write contributors.h5, the strongest surfels of every pixel; insonification: "
       "write the scene with the levels received from it as .ply and .pcd; paths: write paths.vtp, the paths of the "
       "strongest echoes as lines; several with commas",
       outputs},
      {"ping", "contributors", "--contributors", &o.contributors, "how many of each pixel, with --keep contributors",
       contributor_numbers},
      {"ping", "keep_bits", "--keep-bits", &o.run.keep_bits,
       "significant bits of the cube's pressures; fewer than 24, which is all, round each number by at most 2^-BITS of "
       "it and deflate the cube: 12 (0.002 dB) halves it",
       bits},
      {"ping", "layers", "--layers", &o.layers, "keep each kind of echo as a layer of the cube"},
      {"ping", "split", "--split", &o.split,
       "keep the phase between the halves of the array, by which soundings of the bottom are found at export; "
       "three times the synthesis"},
      {"ping", "looks_range", "--looks-range", &o.looks_range,
       "range bins over which pictures and /intensity of the cube average", looks},
      {"ping", "looks_pings", "--looks-pings", &o.looks_pings,
       "pulses of independent speckle, each a whole ping of work, over which they average", looks},
      absorption_setting(o.absorption_order),
      {"ping", "velocity", "--velocity", &o.velocity, "vx,vy,vz [m/s] of the head in the world"},
      {"ping", "turn_rate", "--turn-rate", &o.turn_rate, "x,y,z [deg/s]: rotation vector of the head in the world"},
      {"ping", "threshold_db", "--threshold", &o.threshold_db, "[dB] of a detection above the noise floor"},
      {"ping", "false_alarm_rate", "--false-alarm-rate", &o.false_alarm_rate,
       "of a detection above speckle as strong as its surroundings (cell averaging); 1: surroundings do not count"},
      {"ping", "all_bins_above", "--all-bins-above", &o.all_bins_above,
       "[dB re 1 uPa] every bin above is a returned point"},
      {"ping", "memory_limit_gib", "--memory-limit", &o.memory_limit,
       "[GiB] that a ping may take of a .tiles scene, more of which is refused before it is read, default: what is "
       "available; or of a mesh, which is then sampled coarser, default: 1.5",
       positive},
      {"ping", "with", "--with", &o.with, "force a stage of the plan in, any number of times", stages},
      {"ping", "without", "--without", &o.without, "force a stage of the plan out, any number of times", stages},
  };
}

}  // namespace

std::vector<RunSetting> ping_settings(PingOptions& o) {
  std::vector<RunSetting> all = sent_settings(o);
  for (RunSetting& setting : kept_settings(o)) all.push_back(std::move(setting));
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

/// Whether a setting says what is pinged, from where and when.
bool is_of_one_ping(const RunSetting& setting) {
  const std::vector<std::string> keys = {"path", "pose", "mount", "trajectory", "time",
                                         "ping", "draw", "world", "velocity",   "turn_rate"};
  return std::find(keys.begin(), keys.end(), setting.key) != keys.end();
}

}  // namespace

std::vector<RunSetting> simulator_settings(PingOptions& o) {
  std::vector<RunSetting> all{seed_setting(o.common)};
  for (const auto& group : {synthesis_settings(o.run), ping_settings(o)})
    for (const RunSetting& setting : group)
      if (!is_of_one_ping(setting)) all.push_back(setting);
  return all;
}

std::vector<RunSetting> mission_settings(PingOptions& o) {
  // All but what the mission says in its own tables; some outputs are of a single ping alone.
  std::vector<RunSetting> all;
  for (auto& group : {scene_settings(o.scene), synthesis_settings(o.run), ping_settings(o)})
    for (RunSetting setting : group) {
      if (*setting.section == '\0') setting.section = "ping";
      if (std::string_view(setting.key) == "keep") setting.rules.words = {"contributors", "mask"};
      if (!is_of_one_ping(setting)) all.push_back(setting);
    }
  return all;
}

std::vector<RunSetting> all_settings(PingOptions& o) {
  std::vector<RunSetting> all{seed_setting(o.common)};
  for (const auto& group : {synthesis_settings(o.run), scene_settings(o.scene), ping_settings(o)})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

std::vector<std::string> input_files(const std::vector<RunSetting>& settings) {
  std::vector<std::string> files;
  for (const RunSetting& setting : settings)
    if (setting.is_path) files.push_back(*std::get<std::string*>(setting.value));
  return files;
}

}  // namespace insonify::tool
