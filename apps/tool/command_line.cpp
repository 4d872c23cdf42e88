#include "tool/command_line.hpp"

#include <cstdio>
#include <cstdlib>
#include <memory>

#include <CLI/CLI.hpp>

#include "tool/verbs.hpp"

namespace insonify::tool {
namespace {

void add_common(CLI::App& verb, CommonOptions& o, bool json) {
  verb.add_flag("-q,--quiet", o.quiet, "errors only");
  verb.add_flag("-v,--verbose", o.verbose, "say each step");
  if (json) verb.add_flag("--json", o.json, "result as JSON on stdout");
}

void add_work(CLI::App& verb, CommonOptions& o) {
  verb.add_option("-j,--threads", o.threads, "threads, at most 1024; 0: all cores (results do not depend on it)")
      ->check([](const std::string& text) {
        const int threads = std::atoi(text.c_str());
        return threads >= 0 && threads <= 1024 ? "" : text + " must be within 0 and 1024";
      });
  verb.add_option("--seed", o.seed, "of all random numbers; same seed, same bytes");
}

void add_scene(CLI::App& verb, SceneOptions& o) {
  verb.add_option("SCENE", o.path, "cloud or mesh: .pcd .ply .obj .stl .vtk .vtp .xyz .txt .csv")->required();
  verb.add_option("--viewpoint", o.viewpoint, "x,y,z [m] where the capture stood; orients estimated normals");
  verb.add_option("--materials", o.materials_file, "TOML table of materials for the labels of the cloud");
  verb.add_option("--material-field", o.material_field, "field of the cloud that means materials, e.g. classification");
  verb.add_option("--material", o.material, "one material for everything, by name, e.g. sand");
  verb.add_option("--unit", o.unit, "of the file: m, mm, cm, km, ft, or metres per unit");
  verb.add_option("--mesh-spacing", o.mesh_spacing, "[m] between surfels of a mesh; 0: about 200 000 surfels");
}

void add_sonar(CLI::App& verb, CommonOptions& common, RunOptions& o) {
  verb.add_option("--sonar", o.sonar, "preset (see `insonify sonars`), a .toml file, or the run.toml of a run")
      ->required();
  verb.add_option("--range", o.range, "min:max [m]; default: the sonar's");
  verb.add_option("--tolerance", o.tolerance, "relative error of the synthesis");
  verb.add_option("--method", o.method, "stamped, direct: the slow referee, or element-exact: true delays per element")
      ->check(CLI::IsMember({"stamped", "direct", "element-exact"}))
      ->option_text("WORD");
  verb.add_option("--environment", o.environment,
                  "TOML file: [water] [surface] [bottom] [volume] [wind] [noise] [profile], or the run.toml of a run");
  verb.add_option("--profile", o.profile,
                  "CSV depth_m,sound_speed (or depth_m,temperature_c,salinity_psu): bends rays");
  verb.add_option("--set", common.settings, "SECTION.KEY=VALUE of sonar or environment, e.g. water.temperature_c=4")
      ->allow_extra_args(false);
}

void add_run(CLI::App& verb, CommonOptions& common, RunOptions& o) {
  add_sonar(verb, common, o);
  verb.add_option("-o,--output", o.output, "run directory to make")->required();
  verb.add_flag("--force", o.force, "replace an existing run directory");
  verb.add_flag("--no-picture", o.no_picture, "do not draw fan.png");
}

/// All options of all verbs; lives as long as the command that runs.
struct AllOptions {
  CommonOptions common;
  InfoOptions info;
  PrepareOptions prepare;
  MakeSceneOptions make_scene;
  SonarsOptions sonars;
  PingOptions ping;
  SynthesizeOptions synthesize;
  ImageOptions image;
  BeamPatternOptions beampattern;
  AccuracyOptions accuracy;
};

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

void add_ping_options(CLI::App& verb, PingOptions& o) {
  verb.add_option("--pose", o.pose, "x,y,z,yaw,pitch,roll [m, deg]; pitch positive nose down");
  verb.add_option("--trajectory", o.trajectory, "instead of --pose: CSV time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg");
  verb.add_option("--time", o.time, "of transmission on the trajectory [s]");
  verb.add_option("--world", o.world, "z-up, or ned: z down, pitch positive nose up")
      ->check(CLI::IsMember({"z-up", "ned"}))
      ->option_text("WORD");
  verb.add_option("--sampling", o.sampling, "surfels or rays")
      ->check(CLI::IsMember({"surfels", "rays"}))
      ->option_text("WORD");
  verb.add_option("--scatterers-per-cell", o.scatterers_per_cell,
                  "surfels are split until a resolution cell holds so many");
  verb.add_option("--rays-per-beam", o.rays_per_beam, "with --sampling rays");
  verb.add_option("--amplitude", o.amplitude, "speckle, random-phase or coherent")
      ->check(CLI::IsMember({"speckle", "random-phase", "coherent"}))
      ->option_text("WORD");
  verb.add_flag("--noise", o.noise, "add thermal noise, and the wind's and the platform's if the environment has them");
  verb.add_flag("--multipath", o.multipath, "add echoes by way of the environment's surface and bottom");
  verb.add_option("--keep", o.keep, "elements: also write elements.h5, the series of every element of a line array")
      ->check(CLI::IsMember({"elements"}))
      ->option_text("WORD")
      ->allow_extra_args(false);
  verb.add_flag("--layers", o.layers, "keep each kind of echo as a layer of the cube");
  verb.add_option("--absorption-order", o.absorption_order, "0: one absorption for the pulse; 1, 2: slope, curvature")
      ->check(CLI::Range(0, 2))
      ->option_text("INT");
  verb.add_option("--velocity", o.velocity, "vx,vy,vz [m/s] of the head in the world");
  verb.add_option("--turn-rate", o.turn_rate, "x,y,z [deg/s]: rotation vector of the head in the world");
  verb.add_option("--threshold", o.threshold_db, "[dB] of a detection above the noise floor");
  verb.add_option("--all-bins-above", o.all_bins_above, "[dB re 1 uPa] every bin above is a returned point");
  verb.add_option("--with", o.with, "force a stage of the plan in, any number of times")->allow_extra_args(false);
  verb.add_option("--without", o.without, "force a stage of the plan out, any number of times")
      ->allow_extra_args(false);
}

void add_plan(CLI::App& app, AllOptions& all) {
  PingOptions& o = all.ping;
  CLI::App* verb = app.add_subcommand("plan", "what a ping would compute and leave out, and what leaving it out costs");
  add_scene(*verb, o.scene);
  add_sonar(*verb, all.common, o.run);
  add_ping_options(*verb, o);
  add_common(*verb, all.common, true);
  add_work(*verb, all.common);
  verb->footer(
      "Examples:\n  insonify plan reef.pcd --sonar oculus-m750d --pose=-1,4,-2.2,0,15,0 --range 0.5:9\n"
      "  insonify plan harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --set surface.height_m=0 --json");
}

void add_ping(CLI::App& app, AllOptions& all) {
  PingOptions& o = all.ping;
  CLI::App* verb = app.add_subcommand("ping", "what the sonar hears of the scene: the main job");
  add_scene(*verb, o.scene);
  add_run(*verb, all.common, o.run);
  add_ping_options(*verb, o);
  add_common(*verb, all.common, true);
  add_work(*verb, all.common);
  verb->footer(
      "Examples:\n  insonify ping reef.pcd --sonar oculus-m750d --pose=-1,4,-2.2,0,15,0 --range 0.5:9 -o out\n"
      "  insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --set water.temperature_c=4 -o cold\n"
      "  insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,0,0 --multipath --set surface.height_m=0 --layers "
      "-o sea\n"
      "  insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --noise --set wind.speed_m_s=8 "
      "--profile ctd.csv -o gale");
}

void add_synthesize(CLI::App& app, AllOptions& all) {
  CLI::App* verb = app.add_subcommand("synthesize", "beams from scatterers of another program (CSV)");
  verb->add_option("SCATTERERS", all.synthesize.scatterers,
                   "CSV: range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im")
      ->required();
  add_run(*verb, all.common, all.synthesize.run);
  add_common(*verb, all.common, true);
  add_work(*verb, all.common);
  verb->footer(
      "Examples:\n  insonify synthesize rays.csv --sonar p900-45 --range 1:20 -o out\n"
      "  insonify synthesize rays.csv --sonar p900-45 --method direct -o referee");
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

}  // namespace

Command parse_command_line(int argc, char** argv) {
  const auto all = std::make_shared<AllOptions>();
  CLI::App app{"insonify: what a sonar hears of a captured scene", "insonify"};
  app.set_version_flag("--version", INSONIFY_VERSION);
  app.require_subcommand(1);
  add_info(app, *all);
  add_prepare(app, *all);
  add_make_scene(app, *all);
  add_sonars(app, *all);
  add_plan(app, *all);
  add_ping(app, *all);
  add_synthesize(app, *all);
  add_image(app, *all);
  add_beampattern(app, *all);
  add_accuracy(app, *all);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {  // help and version: asked for, so on stdout
    return {{}, app.exit(e)};
  } catch (const CLI::ParseError& e) {
    std::fprintf(stderr, "insonify: %s; see insonify --help\n", e.what());
    return {{}, 2};
  }
  const std::string verb = app.get_subcommands().front()->get_name();
  return {[all, verb] {
            if (verb == "info") info(all->common, all->info);
            if (verb == "prepare") prepare(all->common, all->prepare);
            if (verb == "make-scene") make_scene(all->common, all->make_scene);
            if (verb == "sonars") sonars(all->common, all->sonars);
            if (verb == "plan") plan(all->common, all->ping);
            if (verb == "ping") ping(all->common, all->ping);
            if (verb == "synthesize") synthesize(all->common, all->synthesize);
            if (verb == "image") image(all->common, all->image);
            if (verb == "accuracy") accuracy(all->common, all->accuracy);
            if (verb == "beampattern") beampattern(all->common, all->beampattern);
          },
          0};
}

}  // namespace insonify::tool
