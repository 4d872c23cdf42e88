// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run/options.hpp"
#include "tool/command/option_list.hpp"
#include "tool/run/swath_pings.hpp"
#include "viewer/viewer_data.hpp"

namespace insonify::viewer {

/// Options of insonify-view.
struct ViewerCommand {
  tool::CommonOptions common;
  SceneOptions scene;  ///< path: of --scene, or the target itself
  HeadOptions sonar;   ///< --sonar, --range and --set
  std::string target;  ///< run directory, cube.h5, recording, or scene
  std::string pose;
  std::string world = "z-up";
  std::string head;   ///< name of the head of a survey, or of the channel of a side-scan's recording; empty: the first
  std::string beam;   ///< number, or empty: nothing is selected
  ViewerState start;  ///< with ping, colour map and window
  std::string size = "1600x1000";
  std::string screenshot;  ///< file, or empty: a window
  bool force = false;
  bool no_scene = false;
  std::string events, script;
  std::optional<int> exit_code;  ///< set if nothing is left to do: help or version was asked for, or the usage is wrong
};
ViewerCommand parse_viewer_command(int argc, char** argv);

struct LoadedView {
  ViewerData data;
  ViewerState start;
  std::vector<std::string> notes;  ///< for the user, one sentence each
};

/// True if the target is a run directory, a cube or a recording rather than a scene.
bool is_run(const std::string& target);

/// Opens a run: its cube, whose pings are read as they are shown, and contributors, returns and scene if they exist. Of
/// a survey one head, merged or as far as its blocks are done. Throws Error(file) if there is no such run,
/// Error(content) if it is unfinished or damaged, Error(argument) for options that do not fit it.
LoadedView load_run(const ViewerCommand& command);

/// Opens a recording, whose levels are shown as they are recorded: a swath, both sides of a side-scan or the channel that
/// --head names, or the images of an imaging sonar. Throws as load_run.
LoadedView load_record(const ViewerCommand& command);

/// Sets ping, selection and colours that a view with its pings and scene begins with. Throws Error(argument) for a ping or
/// a beam that it lacks.
void choose_start(const ViewerCommand& command, LoadedView& view);

/// Reads a scene to inspect. Throws as load_scene and find_sonar; Error(argument) without --sonar or --pose.
LoadedView load_inspection(const ViewerCommand& command);

/// A cube, and the returns of its pings (PLY) or "".
struct CubeOfPings {
  std::string cube, returns;
};

/// The pings of cubes in turn, read one at a time; of the returns those of one cube are kept. Errors as read_cube.
LazyPings lazy_pings_of(const std::vector<CubeOfPings>& cubes);

/// The pings of the two sides of a side-scan, as pings of two beams in the axes of the port head, turned ahead. Pings that only one
/// side has yet are left out. Absent if a side has several beams, if their ranges differ, or if they begin so far away
/// that a waterfall from the head on would be nearly empty.
std::optional<LazyPings> lazy_pings_of_sides(const LazyPings& port, const LazyPings& starboard);

/// Pings that are in memory.
LazyPings lazy_pings_of(std::vector<Ping> pings);

/// The pings of a recorded swath, drawn one at a time.
LazyPings lazy_pings_of(std::shared_ptr<const tool::SwathPings> swath);

/// One head of a survey.
struct SurveyHeadRun {
  std::string folder;  ///< folder of the head, with its run.toml
  std::string name;
  std::vector<CubeOfPings> cubes;   ///< the finished blocks; if they are gone, the merged cube
  std::vector<std::string> others;  ///< names of the other heads
  std::size_t blocks = 0, done = 0;
};

/// The head that `target` (the folder of a survey, or of one of its heads) and `head` (or "": the first) name; nothing
/// if the target is of no survey. Throws Error(argument) for a head that the survey lacks, Error(content) if none of
/// its blocks is done.
std::optional<SurveyHeadRun> find_survey_head(const std::string& target, const std::string& head);

/// Adds the scene of the run in `run_folder` to a view that has its pings, and notes on it; of a scene of parts that of
/// each ping. Without the scene, or with contributors of another one, a note says so. Throws as load_any_scene and
/// PartsOfPings.
void show_scene_of_run(const ViewerCommand& command, const std::string& run_folder, LoadedView& view);

}  // namespace insonify::viewer
