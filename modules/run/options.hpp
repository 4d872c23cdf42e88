// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scene/asked_meaning.hpp"
#include "simulate/simulation_options.hpp"

namespace insonify {

/// Defaults of the library, which are those of the tool.
inline const SimulationOptions library_options{};

/// Options of every verb.
struct CommonOptions {
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  int threads = 0;  ///< 0: all cores
  std::uint64_t seed = library_options.seed;
  std::vector<std::string> settings;  ///< --set sonar.beams=256 ...
};

/// How a cloud is read and completed.
struct SceneOptions {
  std::string path;
  std::string viewpoint;       ///< "x,y,z" [m] or empty
  std::string materials_file;  ///< TOML table
  std::string material;        ///< name for every surfel, or empty
  std::string material_field;  ///< field of the cloud whose numbers mean materials, or empty: found by name
  MeaningText meaning;         ///< units, axes and holes of the file
  double mesh_spacing = 0;
  std::string scan_noise;  ///< [m] or empty: the file's, else estimated
  bool keep_strays = false;
};

/// Sonar, environment, synthesis and output of a run.
struct RunOptions {
  std::string sonar;
  std::string range;        ///< "min:max" [m] or empty: the sonar's own, of a ping to the end of the scene at most
  std::string environment;  ///< TOML file, or empty
  std::string profile;      ///< CSV of sound speed against depth, or empty
  std::string output;
  double tolerance = library_options.synthesis.tolerance;
  std::string method = "planned";
  int keep_bits = 24;  ///< significant bits of the cube's pressures; 24: all
  bool force = false;
  bool no_picture = false;
};

/// Options of `ping` and `plan`. The fields that run.toml records are the rows of the table in setting_table.cpp.
struct PingOptions {
  CommonOptions common;
  SceneOptions scene;
  RunOptions run;
  std::string pose;   ///< pose of the vehicle
  std::string mount;  ///< mounting of the head on the vehicle, or empty: as the sonar's file says
  std::string world = "z-up";
  std::string sampling = "surfels";
  std::string amplitude = "speckle";
  double scatterers_per_cell = library_options.sampling.scatterers_per_cell;
  double detail_width = library_options.sampling.detail_width;
  double detail_spacing = library_options.sampling.detail_spacing;
  int rays_per_beam = library_options.sampling.rays_per_beam;
  bool noise = false;
  bool multipath = false;
  double double_echoes = library_options.effects.double_echoes;
  std::vector<std::string> keep;  ///< "elements", "mask", "labels", "contributors", "insonification", "paths"
  int contributors = 4;           ///< surfels kept for each pixel, if `keep` names them
  bool layers = false;
  bool split = false;
  int display = library_options.outputs.display_bins;  ///< display cells along range; 0: samples
  int looks_range = library_options.outputs.looks_range, looks_pings = library_options.outputs.looks_pings;
  int absorption_order = -1;  ///< order of the absorption; -1: as needed
  double accuracy_db = library_options.accuracy_db;
  std::string trajectory;  ///< CSV of times and poses, or empty: --pose instead
  double time = 0;         ///< time of transmission [s]
  int ping = -1;           ///< number of the ping; -1: time in milliseconds
  int draw = 0;            ///< number of the draw of the scatters of a scene of parts
  std::string velocity;    ///< "vx,vy,vz" [m/s], or empty: at rest
  std::string turn_rate;   ///< "x,y,z" [deg/s], or empty
  double threshold_db = library_options.detection.threshold_db;
  double false_alarm_rate = library_options.detection.false_alarm_rate;
  std::string all_bins_above;              ///< dB re 1 uPa, or empty
  double memory_limit = 0;                 ///< [GiB] for a .tiles scene or a mesh; 0: see the help
  std::vector<std::string> with, without;  ///< stages of the plan forced in or out
};

}  // namespace insonify
