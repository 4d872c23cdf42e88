#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sonar/sonar_head.hpp"
#include "store/cube.hpp"
#include "tool/command/options.hpp"
#include "tool/command/parse_values.hpp"
#include "view/show_image.hpp"
#include "view/show_scene.hpp"

/// The parts of the verb `image`.
namespace insonify::tool {

/// Options of `image`.
struct ImageOptions {
  CommonOptions common;
  std::string run;
  std::string output;
  std::string view = "fan";
  std::string layer;  ///< name, or empty: the whole pressure
  std::string colour_map = default_colour_map;
  std::string size;  ///< or empty: 1400x1050, of fans what they fill of it
  std::string title;
  double window_db = 45;
  std::string max_db;  ///< or empty: automatic
  std::uint64_t ping = 0;
  std::string beam;                     ///< number, a word of the view, or empty: the default of the view
  std::optional<std::string> annotate;  ///< number of maxima, .csv file, or "": five maxima
  bool animate = false;
  bool force = false;
  bool raw = false;
  double tvg = 40;             ///< [dB per decade of range]
  int bits = 8;                ///< of view grey
  std::string frame = "head";  ///< of view scan
  std::string min_level;       ///< of view labels [dB] or black; empty: none
  // Of view waterfall:
  std::string starboard;         ///< run to the right of this one
  std::string altitude, bottom;  ///< [m], of the flat bottom of ground range; empty: slant range
  bool dark = false;
  // Of view scene:
  std::string scene;               ///< of a run, or empty: where run.toml says
  std::string sonar, pose, range;  ///< to inspect a scene
  std::string world = "z-up";
  std::string camera = "auto", colour;  ///< colour empty: the default of run or scene
  bool normals = false;                 ///< drawn as lines
};

/// Words of --colour and --camera.
constexpr Named<SceneColour> colour_words[] = {
    {"height", SceneColour::height}, {"material", SceneColour::material}, {"visibility", SceneColour::visibility},
    {"level", SceneColour::level},   {"grazing", SceneColour::grazing},   {"incidence", SceneColour::incidence}};
constexpr Named<ScenePreset> camera_words[] = {{"auto", ScenePreset::automatic},
                                               {"behind", ScenePreset::behind},
                                               {"top", ScenePreset::top},
                                               {"side", ScenePreset::side},
                                               {"iso", ScenePreset::iso}};

/// What `image` reads of a run.
struct ImageRun {
  std::string path;                    ///< as the user gave it
  Cube cube;                           ///< with --layer: holds that layer in place of the whole pressure
  std::optional<SonarHead> head = {};  ///< from the run's run.toml; absent for a bare cube
};

/// Reads a run directory or a cube. Throws Error(file) if there is none, Error(content) if it is unfinished or damaged,
/// Error(argument) for a layer that is not in it.
ImageRun read_image_run(const std::string& path, const std::string& layer);

/// The cube of a run directory, or the path itself if it is a file. Throws Error(file) or Error(content).
std::string run_cube_path(const std::string& run);

/// Reads the cube of a run directory, or a cube file; errors as read_image_run.
Cube read_run_cube(const std::string& path);

/// Size, colours and window of the options; Error(argument) naming the option that is wrong.
PictureOptions picture_options(const ImageOptions& options);

/// The levels of a ping with the gain of the options (--tvg, --raw).
LevelImage levels_of(const ImageRun& run, const ImageOptions& options, std::size_t ping);

/// Sonar, pose, gate, water and settings of one ping of a cube in words.
std::vector<Fact> facts_of(const Cube& cube, std::size_t ping);

/// Draws `image --view scene`: of a run, its returns over its scene; of a scene alone, its visibility from the sonar.
/// Throws Error(argument) for options that exclude one another, and as read_run_cube and load_scene.
void image_scene(const ImageOptions& options, const PictureOptions& picture);

/// One picture to draw: a ping of a run (a waterfall shows all pings), with title and marks in `picture`.
struct ViewJob {
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
  std::size_t beam = 0;  ///< of `one`
};

/// A view: a row of the table from which --view, its help and its checks are made. A new view is a drawing function and
/// its row in image_views.cpp.
struct ViewSpec {
  const char* name;
  const char* shows;                           ///< what --help says
  std::vector<std::string> options = {};       ///< that this view takes and not all views do
  void (*draw)(const ViewJob& job) = nullptr;  ///< of a run that has been read
  /// The highest level that the view chooses for a ping if --max is not given; a series of pictures takes the highest
  /// of all pings, so that it does not flicker. Null for a view that makes no series (--animate).
  double (*max_db)(const ImageRun& run, const ImageOptions& options, std::size_t ping) = nullptr;
  const char* beam_word = "";                   ///< that --beam takes beside a number
  BeamChoice beam_choice = BeamChoice::one;     ///< that the word means
  BeamChoice default_choice = BeamChoice::one;  ///< without --beam
  /// Set for a view that reads what it draws by itself, in place of `draw`.
  void (*draw_alone)(const ImageOptions& options, const PictureOptions& picture) = nullptr;
};

const std::vector<ViewSpec>& all_views();
const ViewSpec& view_of(const ImageOptions& options);

/// Names of the views that take an option, as "fan, rect or panels".
std::string views_with(const std::string& option);

/// --beam: a number, the word of the view, or empty: the view's default, of one beam the middle one. Throws
/// Error(argument).
ChosenBeam choose_beam(const ImageOptions& options, const BeamFan& fan);

/// The chosen beam in words, with its bearing.
std::string chosen_beam_text(const ViewJob& job);

/// The title of the picture of a ping where the user gives none.
std::string default_title(const ImageRun& run, const ImageOptions& options, std::size_t ping);

}  // namespace insonify::tool
