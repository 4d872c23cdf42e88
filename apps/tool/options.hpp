#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace insonify::tool {

/// What every verb understands.
struct CommonOptions {
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  int threads = 0;  ///< 0: all cores
  std::uint64_t seed = 1;
  std::vector<std::string> settings;  ///< --set sonar.beams=256 ...
};

/// How a cloud is read and completed.
struct SceneOptions {
  std::string path;
  std::string viewpoint;       ///< "x,y,z" [m] or empty
  std::string materials_file;  ///< TOML table
  std::string material;        ///< name for every surfel, or empty
  std::string material_field;  ///< field of the cloud whose numbers mean materials, or empty: found by name
  std::string unit = "m";
  double mesh_spacing = 0;
};

struct InfoOptions {
  std::vector<std::string> files;
};

struct PrepareOptions {
  SceneOptions scene;
  std::string output;
  double thin = 0;  ///< [m] between the surfels that stay; 0: all stay
  bool force = false;
};

struct MakeSceneOptions {
  std::string name;
  std::string output;
  std::size_t points = 200000;
  std::string size = "40,40";
  double radius = 0.5;
  double lambert_mu_db = -27;
  bool force = false;
};

struct SonarsOptions {
  std::string name;
};

/// What a run of the acoustics needs beside a scene.
struct RunOptions {
  std::string sonar;
  std::string range;        ///< "min:max" [m] or empty: the sonar's own
  std::string environment;  ///< TOML file, or empty
  std::string profile;      ///< CSV of sound speed against depth, or empty
  std::string output;
  double tolerance = 1e-4;
  std::string method = "gridded";
  bool force = false;
  bool no_picture = false;
};

struct PingOptions {
  SceneOptions scene;
  RunOptions run;
  std::string pose;
  std::string world = "z-up";
  std::string sampling = "surfels";
  std::string amplitude = "speckle";
  double scatterers_per_cell = 10;
  int rays_per_beam = 64;
  double level_error_db = 0;  ///< 0: the sampling is taken as it is
  bool noise = false;
  bool multipath = false;
  std::vector<std::string> keep;  ///< "elements", "mask", "contributors", "insonification", "paths"
  int contributors = 4;           ///< of each pixel, if they are kept
  bool layers = false;
  int absorption_order = 0;
  std::string trajectory;  ///< CSV of times and poses, or empty: --pose instead
  double time = 0;         ///< of transmission [s]
  std::string velocity;    ///< "vx,vy,vz" [m/s], or empty: at rest
  std::string turn_rate;   ///< "x,y,z" [deg/s], or empty
  double threshold_db = 11.4;
  std::string all_bins_above;              ///< dB re 1 uPa, or empty
  double memory_limit = 0;                 ///< [GiB] for a .tiles scene; 0: what is available
  std::vector<std::string> with, without;  ///< stages of the plan forced in or out
};

struct SynthesizeOptions {
  RunOptions run;
  std::string scatterers;
};

struct ImageOptions {
  std::string run;
  std::string output;
  std::string view = "fan";
  std::string layer;  ///< name, or empty: the whole pressure
  std::string colour_map = "copper";
  std::string size = "1400x1050";
  std::string title;
  double window_db = 45;
  std::string max_db;  ///< or empty: automatic
  std::size_t ping = 0;
  std::string beam;                     ///< number, "max", "all", or empty: what suits the view
  std::optional<std::string> annotate;  ///< number of maxima, .csv file, or "": five maxima
  bool animate = false;
  bool force = false;
  bool raw = false;
  double tvg = 40;  ///< [dB per decade of range]
  int bits = 8;     ///< of view grey
  bool dark = false;
  // Of view scene:
  std::string scene;               ///< of a run, or empty: where run.toml says
  std::string sonar, pose, range;  ///< to inspect a scene
  std::string world = "z-up";
  std::string camera = "auto", colour;  ///< colour empty: what suits
  bool normals = false;                 ///< drawn as lines
};

struct MergeOptions {
  std::vector<std::string> runs;
  std::string output;
  bool force = false;
};

struct ExportOptions {
  std::string run;
  std::string output;
  bool force = false;
};

struct AccuracyOptions {
  SceneOptions scene;  ///< path empty: built-in tasks
  RunOptions run;      ///< of which sonar, range, environment, output, force and no_picture count
  std::string pose;
  std::string world = "z-up";
  std::vector<std::string> methods, tolerances;  ///< empty: all
  int repeats = 5;
  bool full = false, quick = false;
};

struct BeamPatternOptions {
  RunOptions run;  ///< of which only the sonar counts
  std::string steer = "0";
  std::string output;  ///< picture, or empty: none
  std::string size = "1400x1050";
  bool dark = false;
};

}  // namespace insonify::tool
