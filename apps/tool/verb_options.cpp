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
  verb->add_option("-o,--output", all.prepare.output,
                   "prepared scene, .ply or .pcd; or .tiles, for any size: a ping reads what it sees")
      ->required();
  verb->add_option("--thin", all.prepare.thin, "[m] between surfels: denser parts are thinned, area and materials kept")
      ->check(CLI::PositiveNumber);
  verb->add_flag("--force", all.prepare.force, "replace an existing file");
  verb->add_flag_callback(
      "--normals", [] {}, "accepted for clarity: missing normals are always estimated");
  add_common(*verb, all.common, true);
  add_work(*verb, all.common);
  verb->footer(
      "Examples:\n  insonify prepare reef.pcd -o reef.ply --material sand\n"
      "  insonify prepare scan.ply -o scan-m.ply --unit mm --viewpoint 0,0,2\n"
      "  insonify prepare dense.pcd -o reef.ply --thin 0.02");
}

void add_make_scene(CLI::App& app, AllOptions& all) {
  MakeSceneOptions& o = all.make_scene;
  CLI::App* verb = app.add_subcommand("make-scene", "a built-in scene with normals, areas and materials");
  verb->add_option("NAME", o.name, "harbour, plane, sphere, wall or poles")->required();
  verb->add_option("-o,--output", o.output, "scene to write, .ply or .pcd; or .tiles, for any size")->required();
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
  verb->add_option("RUN", o.run, "run directory or cube.h5; for view scene also a cloud or mesh")->required();
  verb->add_option("-o,--output", o.output, "picture to write, .png (grey also .pgm); with --animate a folder")
      ->required();
  verb->add_option("--view", o.view,
                   "fan, rect, waterfall, ascan, spectrum, panels, scene, or grey: the bare samples as 8- or 16-bit "
                   ".png or .pgm")
      ->check(CLI::IsMember({"fan", "rect", "waterfall", "ascan", "spectrum", "panels", "scene", "grey"}))
      ->option_text("WORD");
  verb->add_option("--bits", o.bits, "of grey: 8 or 16")->check(CLI::IsMember({8, 16}))->option_text("INT");
  verb->add_option("--layer", o.layer, "one kind of echo alone, e.g. multipath, of a run made with --layers");
  verb->add_option("--ping", o.ping, "which ping, from 0");
  verb->add_option("--beam", o.beam,
                   "from 0, max (waterfall) or all (spectrum); default: the middle one, of a spectrum all");
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
  verb->add_option("--annotate", o.annotate,
                   "name so many of the strongest maxima (5), or the places in a .csv: bearing_deg,range_m,text")
      ->expected(0, 1)
      ->option_text("[N|CSV]");
  verb->add_flag("--animate", o.animate, "one picture per ping in the folder -o, all with the same levels");
  verb->add_flag("--force", o.force, "replace existing pictures");
  const char* group = "Of view scene";
  verb->add_option("--scene", o.scene, "the run's scene, if it is not where run.toml says")->group(group);
  verb->add_option("--sonar", o.sonar, "to inspect a scene: preset, .toml file, or run.toml of a run")->group(group);
  verb->add_option("--pose", o.pose, "to inspect a scene: x,y,z,yaw,pitch,roll [m, deg]")->group(group);
  verb->add_option("--range", o.range, "to inspect a scene: MIN:MAX [m]; default: the sonar's")->group(group);
  verb->add_option("--world", o.world, "z-up or ned")
      ->check(CLI::IsMember({"z-up", "ned"}))
      ->option_text("WORD")
      ->group(group);
  verb->add_option("--camera", o.camera, "auto, behind (the head), top, side or iso")
      ->check(CLI::IsMember({"auto", "behind", "top", "side", "iso"}))
      ->option_text("WORD")
      ->group(group);
  verb->add_flag("--normals", o.normals, "of view scene: draw some 4000 normals as lines");
  verb->add_option("--colour", o.colour,
                   "height, material, visibility, level, grazing or incidence; default: what suits")
      ->check(CLI::IsMember({"height", "material", "visibility", "level", "grazing", "incidence"}))
      ->option_text("WORD")
      ->group(group);
  add_common(*verb, all.common, false);
  verb->footer(
      "Examples:\n  insonify image out -o fan.png --annotate\n  insonify image out --view ascan --beam 128 -o "
      "beam.png\n"
      "  insonify image track --animate -o frames\n  insonify image track --view waterfall --beam max -o "
      "waterfall.png\n  insonify image out --view scene -o scene.png\n"
      "  insonify image reef.ply --view scene --sonar p900-45 --pose=-1,4,-2.2,0,15,0 -o visibility.png");
}

void add_merge(CLI::App& app, AllOptions& all) {
  CLI::App* verb = app.add_subcommand("merge", "pings of several runs of one sonar in one run, by time");
  verb->add_option("RUN", all.merge.runs, "run directories or cubes with the same fan and gate")->required();
  verb->add_option("-o,--output", all.merge.output, "run directory to make")->required();
  verb->add_flag("--force", all.merge.force, "replace an existing run directory");
  add_common(*verb, all.common, true);
  verb->footer(
      "Examples:\n  insonify merge out-0 out-1 out-2 -o track\n"
      "  insonify merge run-* -o track && insonify image track --view waterfall -o waterfall.png");
}

void add_export(CLI::App& app, AllOptions& all) {
  ExportOptions& o = all.exporting;
  CLI::App* verb = app.add_subcommand("export", "a run for ParaView and other VTK programs: .vts, .vti and .pvd");
  verb->add_option("RUN", o.run, "run directory or cube.h5")->required();
  verb->add_option("-o,--output", o.output, "directory to make")->required();
  verb->add_flag("--force", o.force, "replace an existing directory of an earlier export");
  add_common(*verb, all.common, false);
  verb->footer("Examples:\n  insonify export out -o out-vtk\n  insonify export survey -o vtk && paraview vtk/fan.pvd");
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
  verb->add_option("--methods", o.methods, "only these, e.g. gridded,direct")->delimiter(',');
  verb->add_option("--tolerances", o.tolerances, "of gridded, e.g. 1e-3,1e-6")->delimiter(',');
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
