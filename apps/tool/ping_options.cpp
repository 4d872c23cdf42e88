#include "tool/verb_options_internal.hpp"

namespace insonify::tool {
namespace {

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
  verb.add_option("--level-error-db", o.level_error_db,
                  "[dB] sampling is refined until 99 % of the cells have a smaller error of their expected level");
  verb.add_option("--amplitude", o.amplitude, "speckle, random-phase or coherent")
      ->check(CLI::IsMember({"speckle", "random-phase", "coherent"}))
      ->option_text("WORD");
  verb.add_flag("--noise", o.noise, "add thermal noise, and the wind's and the platform's if the environment has them");
  verb.add_flag("--multipath", o.multipath, "add echoes by way of the environment's surface and bottom");
  verb.add_option(
          "--keep", o.keep,
          "elements: also write elements.h5, the series of every element of a line array; mask: mark in the cube "
          "where the scan has holes; contributors: write contributors.h5, the strongest surfels of every pixel; "
          "insonification: write the scene with what was heard of it as .ply and .pcd; paths: write paths.vtp, "
          "the ways of the strongest echoes as lines; several with commas")
      ->check(CLI::IsMember({"elements", "mask", "contributors", "insonification", "paths"}))
      ->option_text("WORD")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("--contributors", o.contributors, "how many of each pixel, with --keep contributors")
      ->check(CLI::Range(1, 255))
      ->option_text("INT");
  verb.add_flag("--layers", o.layers, "keep each kind of echo as a layer of the cube");
  verb.add_option("--absorption-order", o.absorption_order, "0: one absorption for the pulse; 1, 2: slope, curvature")
      ->check(CLI::Range(0, 2))
      ->option_text("INT");
  verb.add_option("--velocity", o.velocity, "vx,vy,vz [m/s] of the head in the world");
  verb.add_option("--turn-rate", o.turn_rate, "x,y,z [deg/s]: rotation vector of the head in the world");
  verb.add_option("--threshold", o.threshold_db, "[dB] of a detection above the noise floor");
  verb.add_option("--all-bins-above", o.all_bins_above, "[dB re 1 uPa] every bin above is a returned point");
  verb.add_option("--memory-limit", o.memory_limit,
                  "[GiB] that a .tiles scene may take; more is refused before it is read; default: what is available")
      ->check(CLI::PositiveNumber)
      ->option_text("FLOAT");
  verb.add_option("--with", o.with, "force a stage of the plan in, any number of times")->allow_extra_args(false);
  verb.add_option("--without", o.without, "force a stage of the plan out, any number of times")
      ->allow_extra_args(false);
}

}  // namespace

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

}  // namespace insonify::tool
