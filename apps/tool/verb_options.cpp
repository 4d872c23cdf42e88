#include "tool/verb_options_internal.hpp"

namespace insonify::tool {

void add_info(CLI::App& app, AllOptions& all) {
  CLI::App* verb = app.add_subcommand("info", "what is in a file or run, and what is wrong with it");
  verb->add_option("FILE", all.info.files, "cloud, mesh, sonar .toml, cube.h5 or run directory")->required();
  add_common(*verb, all.common, true);
  verb->footer("Examples:\n  insonify info reef.pcd\n  insonify info reef.pcd --json | jq .bounds");
}

void add_prepare(CLI::App& app, AllOptions& all) {
  CLI::App* verb = app.add_subcommand("prepare", "complete a cloud or mesh once: origin, normals, areas, materials");
  add_scene(*verb, all.prepare.scene);
  verb->add_option("-o,--output", all.prepare.output, "prepared scene, .ply or .pcd")->required();
  verb->add_flag("--force", all.prepare.force, "replace an existing file");
  verb->add_flag_callback(
      "--normals", [] {}, "accepted for clarity: missing normals are always estimated");
  add_common(*verb, all.common, true);
  add_work(*verb, all.common);
  verb->footer(
      "Examples:\n  insonify prepare reef.pcd -o reef.ply --material sand\n"
      "  insonify prepare scan.ply -o scan-m.ply --unit mm --viewpoint 0,0,2");
}

void add_make_scene(CLI::App& app, AllOptions& all) {
  MakeSceneOptions& o = all.make_scene;
  CLI::App* verb = app.add_subcommand("make-scene", "a built-in scene with normals, areas and materials");
  verb->add_option("NAME", o.name, "harbour, plane, sphere, wall or poles")->required();
  verb->add_option("-o,--output", o.output, "scene to write, .ply or .pcd")->required();
  verb->add_option("--points", o.points, "surfels wanted");
  verb->add_option("--size", o.size, "plane: x,y extent; wall: width,height [m]");
  verb->add_option("--radius", o.radius, "of the sphere [m]");
  verb->add_option("--mu-db", o.lambert_mu_db, "10 log10 of the Lambert coefficient of plane, sphere, wall, poles");
  verb->add_flag("--force", o.force, "replace an existing file");
  add_common(*verb, all.common, false);
  verb->add_option("--seed", all.common.seed, "of jitter and ripples; same seed, same bytes");
  verb->footer(
      "Examples:\n  insonify make-scene harbour -o harbour.ply --points 200000\n"
      "  insonify make-scene plane -o plane.ply --size 40,40 --mu-db -27");
}

void add_sonars(CLI::App& app, AllOptions& all) {
  CLI::App* verb = app.add_subcommand("sonars", "the presets; with a name, every number with its source");
  verb->add_option("NAME", all.sonars.name, "preset or .toml file");
  add_common(*verb, all.common, true);
  verb->footer("Examples:\n  insonify sonars\n  insonify sonars oculus-m750d");
}

void add_image(CLI::App& app, AllOptions& all) {
  ImageOptions& o = all.image;
  CLI::App* verb = app.add_subcommand("image", "a picture of a run, drawn without a display");
  verb->add_option("RUN", o.run, "run directory or cube.h5")->required();
  verb->add_option("-o,--output", o.output, "picture to write, .png (grey also .pgm)")->required();
  verb->add_option("--view", o.view, "fan, rect, ascan, or grey: the bare samples as 8- or 16-bit .png or .pgm")
      ->check(CLI::IsMember({"fan", "rect", "ascan", "grey"}))
      ->option_text("WORD");
  verb->add_option("--bits", o.bits, "of grey: 8 or 16")->check(CLI::IsMember({8, 16}))->option_text("INT");
  verb->add_option("--layer", o.layer, "one kind of echo alone, e.g. multipath, of a run made with --layers");
  verb->add_option("--ping", o.ping, "which ping, from 0");
  verb->add_option("--beam", o.beam, "for ascan, from 0; default: the middle one");
  CLI::Option* raw = verb->add_flag("--raw", o.raw, "levels as received; default: range compensated; excludes --tvg");
  raw->option_text(" ");
  verb->add_option("--tvg", o.tvg,
                   "[dB per decade of range] given back, with absorption; 40: a point's, 30: a bottom's")
      ->excludes(raw)
      ->option_text("FLOAT");
  verb->add_option("--window", o.window_db, "[dB] from darkest to brightest");
  verb->add_option("--max", o.max_db, "[dB] brightest level; default: automatic");
  verb->add_option("--colormap", o.colour_map, "copper, viridis, amber, grey or jet");
  verb->add_option("--size", o.size, "WIDTHxHEIGHT [pixels]");
  verb->add_option("--title", o.title, "default: sonar and ping");
  verb->add_flag("--dark", o.dark, "dark background");
  add_common(*verb, all.common, false);
  verb->footer("Examples:\n  insonify image out -o fan.png\n  insonify image out --view ascan --beam 128 -o beam.png");
}

void add_beampattern(CLI::App& app, AllOptions& all) {
  BeamPatternOptions& o = all.beampattern;
  CLI::App* verb = app.add_subcommand("beampattern", "width, side lobes and grating lobes of a sonar's beam");
  verb->add_option("SONAR", o.run.sonar, "preset (see `insonify sonars`) or a .toml file")->required();
  verb->add_option("--steer", o.steer, "azimuth of the beam [deg], positive to port, within -90 and 90");
  verb->add_option("-o,--output", o.output, "picture to write, .png");
  verb->add_option("--set", all.common.settings, "sonar.KEY=VALUE or water.KEY=VALUE, any number of times")
      ->allow_extra_args(false);
  verb->add_option("--size", o.size, "WIDTHxHEIGHT [pixels]");
  verb->add_flag("--dark", o.dark, "dark background");
  add_common(*verb, all.common, true);
  verb->footer(
      "Examples:\n  insonify beampattern p900-45 -o pattern.png\n"
      "  insonify beampattern oculus-m750d --steer=-30 --set sonar.shading=chebyshev --json");
}

void add_accuracy(CLI::App& app, AllOptions& all) {
  AccuracyOptions& o = all.accuracy;
  o.run.output = "accuracy";
  CLI::App* verb = app.add_subcommand("accuracy", "error against run time of all methods, measured on this machine");
  verb->add_option("-o,--output", o.run.output, "run directory to make; default: accuracy");
  verb->add_option("--scene", o.scene.path, "measure on the echoes of your own ping; with --sonar and --pose");
  verb->add_option("--sonar", o.run.sonar, "preset (see `insonify sonars`) or a .toml file");
  verb->add_option("--pose", o.pose, "x,y,z,yaw,pitch,roll [m, deg]; pitch positive nose down");
  verb->add_option("--world", o.world, "z-up, or ned: z down, pitch positive nose up")
      ->check(CLI::IsMember({"z-up", "ned"}))
      ->option_text("WORD");
  verb->add_option("--range", o.run.range, "min:max [m]; default: the sonar's");
  verb->add_option("--material", o.scene.material, "one material for everything, by name, e.g. sand");
  verb->add_option("--methods", o.methods, "only these, e.g. stamped,direct")->delimiter(',');
  verb->add_option("--tolerances", o.tolerances, "of stamped, e.g. 1e-3,1e-6")->delimiter(',');
  verb->add_option("--repeats", o.repeats, "timed runs of each, after one to warm up; fewer if they take long");
  verb->add_flag("--full", o.full, "larger tasks and all tolerances: some ten minutes");
  verb->add_flag("--quick", o.quick, "tiny tasks: seconds")->group("");
  verb->add_option("--set", all.common.settings, "SECTION.KEY=VALUE of sonar or environment")->allow_extra_args(false);
  verb->add_flag("--force", o.run.force, "replace an existing run directory");
  verb->add_flag("--no-picture", o.run.no_picture, "do not draw the charts");
  add_common(*verb, all.common, true);
  add_work(*verb, all.common);
  verb->footer(
      "Examples:\n  insonify accuracy -o accuracy\n"
      "  insonify accuracy --scene harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 -o mine");
}

}  // namespace insonify::tool
