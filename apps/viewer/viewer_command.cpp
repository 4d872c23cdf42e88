#include "viewer/viewer_command.hpp"

#include <cstdio>

#include <CLI/CLI.hpp>

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

void add_options(CLI::App& app, ViewerCommand& c) {
  app.add_option("TARGET", c.target, "run directory, cube.h5, or a scene to inspect: .pcd .ply .obj .stl .vtk .xyz ...")
      ->required();
  app.add_option("--ping", c.ping, "which ping to begin with, from 0");
  app.add_option("--beam", c.beam, "beam to select at its loudest sample, from 0");
  app.add_option("--colormap", c.colour_map, "copper, viridis, amber, grey or jet");
  app.add_option("--window", c.window_db, "[dB] from darkest to brightest, 5 to 150");
  app.add_option("--scene", c.scene.path, "scene of a run, if it is not where run.toml says");
  app.add_flag("--no-scene", c.no_scene, "a run without its scene: starts faster");
  app.add_option("--sonar", c.run.sonar, "to inspect: preset, .toml file, or the run.toml of a run");
  app.add_option("--pose", c.pose, "to inspect: x,y,z,yaw,pitch,roll [m, deg]; pitch positive nose down");
  app.add_option("--world", c.world, "z-up, or ned: z down, pitch positive nose up")
      ->check(CLI::IsMember({"z-up", "ned"}))
      ->option_text("WORD");
  app.add_option("--range", c.run.range, "to inspect: min:max [m]; default: the sonar's");
  app.add_option("--viewpoint", c.scene.viewpoint, "x,y,z [m] where the capture stood; orients estimated normals");
  app.add_option("--materials", c.scene.materials_file, "TOML table of materials for the labels of the cloud");
  app.add_option("--material-field", c.scene.material_field, "field of the cloud that means materials");
  app.add_option("--material", c.scene.material, "one material for everything, by name, e.g. sand");
  app.add_option("--unit", c.scene.unit, "of the scene: m, mm, cm, km, ft, or metres per unit");
  app.add_option("--mesh-spacing", c.scene.mesh_spacing, "[m] between surfels of a mesh; 0: about 200 000 surfels");
  app.add_option("--set", c.common.settings, "to inspect: SECTION.KEY=VALUE of the sonar")->allow_extra_args(false);
  app.add_option("--size", c.size, "WIDTHxHEIGHT of the window [pixels], at least 800x600");
  app.add_option("--screenshot", c.screenshot, "draw one picture off-screen into this .png and exit: needs no display");
  app.add_flag("--force", c.force, "replace an existing screenshot");
  app.add_option("--script", c.script,
                 "file of events to play first: click, drag, key, select, wait, screenshot, quit");
  app.add_option("--events", c.events, "the same as text, separated by semicolons")->group("");
  app.add_option("-j,--threads", c.common.threads, "threads for loading, 0: all cores")
      ->check(CLI::Range(0, 1024))
      ->option_text("INT");
  app.add_flag("-q,--quiet", c.common.quiet, "errors only");
  app.add_flag("-v,--verbose", c.common.verbose, "say each step");
}

}  // namespace

ViewerCommand parse_viewer_command(int argc, char** argv) {
  ViewerCommand command;
  CLI::App app{
      "insonify-view: look at a run, or at a scene before anything is simulated. Explanations, poses and names of\n"
      "screenshots go to stdout.",
      "insonify view"};
  app.set_version_flag("--version", INSONIFY_VERSION);
  add_options(app, command);
  app.footer(footer());
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    command.exit_code = app.exit(e);
    command.finished = true;
  } catch (const CLI::ParseError& e) {
    std::fprintf(stderr, "insonify: %s; see insonify view --help\n", e.what());
    command.exit_code = 2;
    command.finished = true;
  }
  return command;
}

}  // namespace insonify::viewer
