// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "run/parse_values.hpp"
#include "sonar/sonar_head.hpp"
#include "store/cube.hpp"
#include "tool/command/option_list.hpp"
#include "view/ping_record.hpp"

/// The parts of the verb `image`.
namespace insonify::tool {

/// Options of `image`.
struct ImageOptions {
  ImageOptions() { picture.trim = true; }

  CommonOptions common;
  std::string run;
  std::string output;
  std::string view = "fan";
  std::string layer;       ///< name, or empty: the whole pressure
  PictureOptions picture;  ///< size, colours and levels; of fans without --size what they fill
  std::uint64_t ping = 0;
  std::string beam;                     ///< number, a word of the view, or empty: the default of the view
  std::optional<std::string> annotate;  ///< number of maxima, .csv file, or "": five maxima
  bool animate = false;
  bool force = false;
  bool raw = false;
  std::optional<double> tvg;   ///< [dB per decade of range]; absent: 40 of a run, none of a recording
  int bits = 8;                ///< bits of a grey value in view grey
  std::string frame = "head";  ///< frame of view scan
  std::string min_level;       ///< least level of surfaces in view labels [dB], or black; empty: none
  std::string head;            ///< name of the head, of a survey with several
  std::string cell;            ///< [m], of view bathymetry; empty: by the extent
  // Options of view waterfall:
  std::string starboard;         ///< run to the right of this one
  std::string altitude, bottom;  ///< [m], of the flat bottom of ground range; empty: slant range
  // Options of view scene:
  std::string scene;               ///< path of the scene of a run; empty: where run.toml says
  std::string sonar, pose, range;  ///< sonar, pose and range to inspect a scene
  std::string world = "z-up";
  std::string camera = "auto", colour;  ///< colour empty: the default of run or scene
  bool normals = false;                 ///< drawn as lines
};

/// A run or recording as `image` reads it.
struct ImageRun {
  std::string path;                    ///< path that the user gave
  Cube cube;                           ///< with --layer: holds that layer in place of the whole pressure
  std::optional<SonarHead> head = {};  ///< head in the run's run.toml; absent for a bare cube
  std::string unit = {};               ///< unit of levels of a recording; empty: that of sound
  bool side_scan = false;              ///< a recording whose beams are its channels, as Record has them
};

/// Reads a run directory, a cube, or a recording. Throws Error(file) if there is none, Error(content) if it is
/// unfinished or damaged, Error(argument) for a layer that is not in it.
ImageRun read_image_run(const std::string& path, const std::string& layer);

/// The gain of the options (--tvg, --raw) for a ping of a run or of a recording; absent: as received, or as recorded.
std::optional<Tvg> tvg_of(const ImageOptions& options, double absorption_db_per_m, bool recording = false);

/// The levels of a ping with that gain.
LevelImage levels_of(const ImageRun& run, const ImageOptions& options, std::size_t ping);

/// One picture to draw: a ping of a run (a waterfall shows all pings), with title and marks in `picture`.
struct PictureRequest {
  const ImageRun& run;
  const ImageOptions& options;
  const PictureOptions& picture;
  std::size_t ping = 0;
  std::string path;
};

/// Where on the beam axis a view looks.
enum class BeamChoice { one, strongest, mean };
struct ChosenBeam {
  BeamChoice choice = BeamChoice::one;
  std::size_t beam = 0;  ///< number of the beam for `one`
};

/// An option that not all views take.
struct ViewOption {
  const char* name;
  std::variant<std::string ImageOptions::*, bool ImageOptions::*, std::optional<std::string> ImageOptions::*> value;
  std::string help;
  OptionRules rules = {};
};
inline const ViewOption annotate_option{
    "--annotate",
    &ImageOptions::annotate,
    "name so many of the strongest maxima (5), or the places in a .csv: bearing_deg,range_m,text",
    {.shown_as = "[N|CSV]"}};
inline const ViewOption animate_option{
    "--animate", &ImageOptions::animate,
    "one picture per ping in the folder -o, all with the same levels; at most 10000"};

/// A view, from which --view, its options, their help and checks are made. A new view is one file, view_<name>.cpp,
/// that defines `ViewSpec <name>_view()`, and its name in the list of apps/CMakeLists.txt.
struct ViewSpec {
  const char* name;
  const char* shows;                                  ///< what --help says
  std::vector<ViewOption> options = {};               ///< that this view takes and not all views do
  void (*draw)(const PictureRequest& job) = nullptr;  ///< draws a run that has been read
  /// The highest level that the view chooses for a ping if --max is not given; a series of pictures takes the highest
  /// of all pings, so that it does not flicker. Null for a view that makes no series (--animate).
  double (*max_db)(const PictureRequest& job) = nullptr;
  const char* beam_word = "";                   ///< word that --beam takes beside a number
  BeamChoice beam_choice = BeamChoice::one;     ///< choice that the word means
  BeamChoice default_choice = BeamChoice::one;  ///< choice without --beam
  bool of_levels = false;                       ///< shows title, levels and marks of a ping, and nothing else
  bool of_bearings = false;  ///< shows beams by bearing, which the sides of a recorded side-scan have not
  bool of_phases = false;    ///< shows what follows from phases, which recordings of levels have not
  bool of_survey = false;    ///< takes the folder of a survey itself, with all of its heads
  /// Set for a view that reads what it draws by itself, in place of `draw`.
  void (*draw_alone)(const ImageOptions& options) = nullptr;
};

const std::vector<ViewSpec>& all_views();
const ViewSpec& view_of(const ImageOptions& options);

/// --beam: a number, the word of the view, or empty: the view's default, of one beam the middle one. Throws
/// Error(argument).
ChosenBeam choose_beam(const ImageOptions& options, const BeamFan& fan);

/// Return the levels of the picture to draw, and the fan of its ping.
LevelImage levels_of(const PictureRequest& job);
const BeamFan& fan_of(const PictureRequest& job);

/// Returns the highest level, as ViewSpec::max_db does, for pictures of all samples.
double max_db_of_image(const PictureRequest& job);

/// A beam in words, with its bearing.
std::string beam_text(const ChosenBeam& chosen, const BeamFan& fan);

/// The levels of the chosen beam in some pings, with the gain of the options.
BeamRecord beam_record(const ImageRun& run, const ImageOptions& options, const std::vector<std::size_t>& pings);

/// The title of the picture of a ping where the user gives none.
std::string default_title(const ImageRun& run, const ImageOptions& options, std::size_t ping);

/// The sweep of a scanning head that a ping belongs to, a beam for each of its pings, at its scan angle: what an
/// operator sees, bent where the vehicle moved. Throws Error(content) for a run that is not of a scanning head of one
/// beam.
LevelImage sweep_of_head(const ImageRun& run, const ImageOptions& options, std::size_t ping);

/// Draws that sweep where it was in the world, seen from the middle of the sweep: every sample at the position and
/// bearing that its beam had, the strongest of those that meet in a cell. Cells are half a step of the head wide and a
/// bin long; those that no beam saw are silent. Errors as sweep_of_head.
LevelImage sweep_in_world(const ImageRun& run, const ImageOptions& options, std::size_t ping);

/// Levels of the chosen beam (--beam) in all pings of a run, by slant range. Throws Error(content) for a run of one
/// ping, Error(argument) as choose_beam.
PingHistory beam_history(const ImageRun& run, const ImageOptions& options);

/// Height of the head above the flat bottom in each ping [m]: --altitude, or by the pose above --bottom; empty if
/// neither is given. Throws Error(argument) for a height that is not above the bottom.
std::vector<double> altitudes_of(const ImageRun& run, const ImageOptions& options);

/// A history by slant range drawn on a flat and level bottom `altitude[ping]` below the head: at ground range g the
/// sample at slant range sqrt(g^2 + altitude^2), in bins of the same size from 0 to where the lowest ping ends; what
/// arrives from the water before the bottom is left out, and ground not reached is silent. Throws Error(argument)
/// unless each altitude is below the range.
PingHistory on_flat_bottom(const PingHistory& slant, const std::vector<double>& altitude);

}  // namespace insonify::tool
