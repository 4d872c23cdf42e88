#include "viewer/viewer_command.hpp"

#include "scene_io/load_scene.hpp"
#include "tool/shared_options.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify::viewer {
namespace {

std::string footer() {
  return "\nKeys of a run:\n" + viewer_help(ViewerMode::run) + "\nKeys of a scene:\n" +
         viewer_help(ViewerMode::inspect) +
         "\nExamples:\n"
         "  insonify view out                                    a run: fan, 3-D, A-scan, explanation of samples\n"
         "  insonify view harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0   visibility from a head, without a ping\n"
         "  insonify view out --screenshot viewer.png            the same picture without a display\n"
         "\nExit codes: 0 ok, 1 run-time failure (no display), 2 usage, 3 bad content, 4 file missing or unwritable.";
}

void add_options(tool::OptionList list, ViewerCommand& c) {
  list.add("TARGET", &c.target, "run directory, cube.h5, or a scene to inspect: " + scene_extensions(),
           {.required = true});
  list.add("--ping", &c.ping, "which ping to begin with, from 0");
  list.add("--beam", &c.beam, "beam to select at its loudest sample, from 0");
  list.add("--colormap", &c.colour_map, "copper, viridis, amber, grey or jet");
  list.add("--window", &c.window_db, "[dB] from darkest to brightest, 5 to 150");
  list.add("--scene", &c.scene.path, "scene of a run, if it is not where run.toml says");
  list.add("--no-scene", &c.no_scene, "a run without its scene: starts faster");
  list.add("--sonar", &c.run.sonar, "to inspect: preset, .toml file, or the run.toml of a run");
  list.add("--pose", &c.pose, "to inspect: x,y,z,yaw,pitch,roll [m, deg]; pitch positive nose down");
  tool::add_world(list, c.world);
  list.add("--range", &c.run.range, "to inspect: min:max [m]; default: the sonar's");
  tool::add_completion(list, c.scene);
  list.add("--set", &c.common.settings, "to inspect: SECTION.KEY=VALUE of the sonar", {.one_each = true});
  list.add("--size", &c.size, "WIDTHxHEIGHT of the window [pixels], at least 800x600");
  list.add("--screenshot", &c.screenshot, "draw one picture off-screen into this .png and exit: needs no display");
  list.add("--force", &c.force, "replace an existing screenshot");
  list.add("--script", &c.script, "file of events to play first: click, drag, key, select, wait, screenshot, quit");
  list.add("--events", &c.events, "the same as text, separated by semicolons", {.group = ""});
  list.add("-j,--threads", &c.common.threads, "threads for loading, 0: all cores", {.within = std::pair(0, 1024)});
  tool::add_common(list, c.common, false);
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

}  // namespace insonify::viewer
