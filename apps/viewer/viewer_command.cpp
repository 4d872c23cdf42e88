// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/viewer_command.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/message.hpp"
#include "core/text.hpp"
#include "files/path_status.hpp"
#include "run/parse_values.hpp"
#include "run/ping_setup.hpp"
#include "run/run_checks.hpp"
#include "run/run_settings.hpp"
#include "run/scene_reach.hpp"
#include "run_scenes/open_scene.hpp"
#include "run_scenes/stored_run.hpp"
#include "scene_io/load_scene.hpp"
#include "simulate/resolve_ping.hpp"
#include "store/contributor_file.hpp"
#include "store/cube.hpp"
#include "store/survey_run.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/run/record_file.hpp"
#include "tool/run/run_pings.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify::viewer {
namespace {

std::string footer() {
  return "\nKeys of a run:\n" + viewer_help(ViewerMode::run) + "\nKeys of a scene:\n" +
         viewer_help(ViewerMode::inspect) +
         "\nExamples:\n"
         "  insonify view out                                    a run: fan, 3-D, A-scan, explanation of samples\n"
         "  insonify view survey --head port --ping 100          a survey: plays its pings along the track\n"
         "  insonify view harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0   visibility from a head, without a ping\n"
         "  insonify view out --screenshot viewer.png            the same picture without a display\n"
         "  insonify view line.xtf --head STARBOARD              a channel of a side-scan's recording\n"
         "\nExit codes: 0 ok, 1 run-time failure (no display), 2 usage, 3 bad content, 4 file missing or unwritable.";
}

void add_options(tool::OptionList list, ViewerCommand& c) {
  list.add("TARGET", &c.target,
           "run directory, survey, cube.h5, a recording (" + tool::record_extensions() +
               "), or a scene to inspect: " + scene_extensions() + " .toml",
           {.required = true});
  list.add(
      "--head", &c.head,
      "head of a survey, or channel of a side-scan's recording; default: both sides of a side-scan, else the first");
  list.add("--ping", &c.start.ping, "number of the first ping to show, from 0");
  list.add("--beam", &c.beam, "number of a beam, from 0; its loudest sample is selected");
  list.add("--colormap", &c.start.colour_map, joined(colour_map_names()), {.words = colour_map_names()});
  list.add("--window", &c.start.window_db, "[dB] levels from the darkest to the brightest colour, 5 to 150");
  list.add("--scene", &c.scene.path, "scene of the run, if it is not at the path that run.toml names");
  list.add("--no-scene", &c.no_scene, "show the run without its scene, which starts faster");
  list.add("--sonar", &c.sonar.sonar, "to inspect a scene: preset, .toml file, or the run.toml of a run");
  list.add("--pose", &c.pose,
           "to inspect a scene: x,y,z,yaw,pitch,roll [m, deg] of the head; pitch is positive nose down");
  tool::add_world(list, c.world);
  list.add("--range", tool::range_value(c.sonar),
           "to inspect a scene: min:max [m]; default: to the end of the scene, at most that of the sonar");
  tool::add_completion(list, c.scene);
  list.add("--set", &c.sonar.settings, "to inspect a scene: SECTION.KEY=VALUE that replaces a value of the sonar",
           {.one_each = true});
  list.add("--size", &c.size, "WIDTHxHEIGHT of the window [pixels], at least 800x600");
  list.add("--screenshot", &c.screenshot, "draw one picture into this .png and exit; needs no display");
  list.add("--force", &c.force, "replace an existing screenshot");
  list.add("--script", &c.script, "file of events to play first: click, drag, key, select, wait, screenshot, quit");
  list.add("--events", &c.events, "the same as text, separated by semicolons", {.group = ""});
  list.add("-j,--threads", &c.common.threads, "threads that load the scene; 0: all cores",
           {.within = std::pair(0, 1024)});
  tool::add_verbosity(list, c.common);
}

namespace fs = std::filesystem;

// Reads the cube of a complete run; runs appear atomically, including the manifest.
std::string finished_cube(const std::string& target) {
  const StoredRun run(target);
  std::string cube = run.cube();
  if (is_folder(target) && run.find("manifest.json").empty())
    fail(ErrorKind::content, target,
         ": has no manifest.json, so the run is unfinished or damaged; ping again, or view ", cube, " alone");
  return cube;
}

// Takes the title from the first ping, and the pings as they are shown.
void open_cubes(const std::vector<CubeOfPings>& cubes, LoadedView& view) {
  const Cube first = read_cube(cubes.front().cube, 0, 1);
  view.data.title = first.sonar;
  view.data.pings = lazy_pings_of(cubes);
  std::vector<PingNote> notes;
  for (const CubeOfPings& one : cubes) gather(notes, read_cube(one.cube, 0, 0).notes);
  for (const PingNote& note : notes) view.notes.push_back(sentence(note, view.data.pings.size() == 1));
}

// Opens both sides of a side-scan, if the survey has them and no head was asked for. Returns whether it did.
bool open_sides(const ViewerCommand& command, LoadedView& view) {
  const auto heads = command.head.empty() ? tool::side_scan_heads(command.target) : std::nullopt;
  if (!heads) return false;
  const auto port = find_survey_head(command.target, heads->port);
  const auto starboard = find_survey_head(command.target, heads->starboard);
  std::optional<LazyPings> sides = lazy_pings_of_sides(lazy_pings_of(port->cubes), lazy_pings_of(starboard->cubes));
  if (!sides) return false;
  view.data.pings = std::move(*sides), view.data.sides = true;
  view.data.title = heads->port + " and " + heads->starboard + ", " + read_cube(port->cubes.front().cube, 0, 0).sonar;
  return true;
}

// Opens the heads that are not shown, whose returns are gathered with those of the one that is. A head without a ping
// yet is left out.
void open_others(const ViewerCommand& command, const SurveyHeadRun& shown, LoadedView& view) {
  const auto sides = view.data.sides ? tool::side_scan_heads(command.target) : std::nullopt;
  for (const std::string& name : shown.others) {
    if (sides && (name == sides->port || name == sides->starboard)) continue;
    try {
      LazyPings other = lazy_pings_of(find_survey_head(command.target, name)->cubes);
      if (other.has_returns()) view.data.others.push_back(std::move(other));
    } catch (const Error&) {
      view.notes.push_back(name + ": this head has no pings yet");
    }
  }
}

// The contributors of all pings, where the run has them and they fit into memory.
void load_contributors(const fs::path& run, LoadedView& view) {
  constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 30;
  const std::size_t pings = view.data.pings.size();
  std::vector<std::string> files;
  for (std::size_t p = 0; p < pings; ++p)
    files.push_back((run / (pings == 1 ? "contributors.h5" : fmt::format("contributors/{:06}.h5", p))).string());
  if (!std::all_of(files.begin(), files.end(), [](const std::string& file) { return path_exists(file); })) return;
  std::uintmax_t bytes = 0;
  for (const std::string& file : files) bytes += contributor_bytes(file);
  if (bytes > most_bytes) {
    view.notes.push_back(
        fmt::format("the contributors of all pings are {} MiB and not shown; look at single runs", bytes >> 20));
    return;
  }
  for (const std::string& file : files) {
    NamedContributors named = read_contributor_file(file);
    view.data.contributors.push_back(std::move(named.contributors));
    view.data.material_names = std::move(named.materials);
  }
}

// Opens the head of a survey that is asked for; without one both sides of a side-scan, or the first head, and the
// returns of the others.
LoadedView load_survey_head(const ViewerCommand& command, const SurveyHeadRun& head) {
  LoadedView view{{}, command.start, {}};
  open_cubes(head.cubes, view);
  view.data.title = head.name + ", " + view.data.title;
  const bool whole = command.head.empty() && is_survey_run(command.target);
  if (whole) {
    const bool sides = open_sides(command, view);
    open_others(command, head, view);
    if (!head.others.empty() && !sides)
      view.notes.push_back("the survey has other heads too: --head " + shortened_list(head.others, ", --head "));
  }
  if (head.done < head.blocks)
    view.notes.push_back(fmt::format("{} of {} blocks of {} are not done yet: their pings are missing here",
                                     head.blocks - head.done, head.blocks, head.name));
  view.data.depth_datum = tool::depth_datum_of_run(head.folder);
  show_scene_of_run(command, head.folder, view);
  choose_start(command, view);
  return view;
}

}  // namespace

ViewerCommand parse_viewer_command(int argc, char** argv) {
  ViewerCommand command;
  tool::CommandLine line(
      "insonify view",
      "insonify-view: look at a run, or at a scene before anything is simulated. Explanations, poses and names of\n"
      "screenshots go to stdout.",
      footer());
  add_options(line.options(), command);
  command.exit_code = line.parse(argc, argv);
  return command;
}

bool is_run(const std::string& target) {
  return is_folder(target) || fs::path(target).extension() == ".h5" || tool::is_record(target);
}

LoadedView load_run(const ViewerCommand& command) {
  if (!command.sonar.sonar.empty() || !command.pose.empty())
    fail(ErrorKind::argument, command.target,
         " is a run, whose sonar and poses are known; leave --sonar and --pose out");
  if (tool::is_record(command.target)) return load_record(command);
  if (const auto head = find_survey_head(command.target, command.head)) return load_survey_head(command, *head);
  if (!command.head.empty())
    fail(ErrorKind::argument, "--head = '", command.head, "': ", command.target, " is no survey; leave --head out");
  LoadedView view{{}, command.start, {}};
  open_cubes({{finished_cube(command.target), ""}}, view);
  for (const char* file : {"cube.h5", "returns.ply", "contributors.h5"})
    if (const std::string doubt = integrity_problem(command.target, file); !doubt.empty()) view.notes.push_back(doubt);
  load_contributors(command.target, view);
  if (const std::string returns = StoredRun(command.target).find("returns.ply"); !returns.empty())
    view.data.returns = load_soundings(returns);
  view.data.depth_datum = tool::depth_datum_of_run(command.target);
  show_scene_of_run(command, command.target, view);
  choose_start(command, view);
  return view;
}

LoadedView load_inspection(const ViewerCommand& command) {
  if (!command.head.empty())
    fail(ErrorKind::argument, "--head = '", command.head, "' is of a survey, ", command.target, " is a scene");
  if (command.sonar.sonar.empty())
    fail(ErrorKind::argument, "--sonar must be given to inspect a scene, e.g. --sonar p900-45; see insonify sonars");
  if (command.pose.empty())
    fail(ErrorKind::argument, "--pose must be given to inspect a scene, e.g. --pose=0,0,-3,0,10,0");
  LoadedView view{{}, command.start, {}};
  PingSetup setup = set_up_head(command.sonar);
  view.start.mode = ViewerMode::inspect;
  view.start.head = pose_angles(parse_pose(command.pose, command.world) * setup.mount);
  view.start.scene_colour = SceneColour::visibility;
  view.data.fan = setup.head.fan;
  view.data.vehicle_from_head = setup.mount;
  SceneOptions options = command.scene;
  options.path = command.target;
  LoadedScene loaded = load_any_scene(options, command.common.threads);
  for (const std::string& note : loading_notes(loaded.report)) view.notes.push_back(note);
  view.data.title = setup.head.name + " before " + fs::path(command.target).filename().string();
  view.data.scene = std::move(loaded.scene);
  end_range_with_scene(setup, bounds(view.data.scene), pose_of(view.start.head));
  view.data.gate = setup.head.gate;
  view.data.view =
      resolve_ping(whole_of(view.data.scene), setup.head, {pose_of(view.start.head)}, setup.environment).view;
  return view;
}

}  // namespace insonify::viewer
