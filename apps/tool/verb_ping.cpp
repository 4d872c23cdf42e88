#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "acoustics/reflection.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "scene_io/save_cloud.hpp"
#include "simulate/simulate_ping.hpp"
#include "store/element_file.hpp"
#include "store/trajectory_file.hpp"
#include "tool/parse_values.hpp"
#include "tool/plan_report.hpp"
#include "tool/run_files.hpp"
#include "tool/verbs.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

SimulationOptions simulation_options(const CommonOptions& common, const PingOptions& o) {
  SimulationOptions s;
  s.seed = common.seed;
  s.threads = common.threads;
  s.sampling = o.sampling == "rays" ? SamplingKind::rays : SamplingKind::surfels;
  s.scatterers_per_cell = o.scatterers_per_cell;
  s.rays_per_beam = o.rays_per_beam;
  s.amplitude = o.amplitude == "coherent"       ? SurfaceAmplitude::coherent
                : o.amplitude == "random-phase" ? SurfaceAmplitude::random_phase
                                                : SurfaceAmplitude::complex_normal;
  s.method = parse_method(o.run.method);
  s.tolerance = o.run.tolerance;
  s.noise = o.noise;
  s.multipath = o.multipath;
  s.keep_layers = o.layers;
  s.keep_elements = !o.keep.empty();
  s.absorption_order = o.absorption_order;
  if (!o.velocity.empty()) s.motion.velocity = parse_vector("--velocity", o.velocity, "vx,vy,vz in m/s");
  if (!o.turn_rate.empty())
    s.motion.turn_rate = parse_vector("--turn-rate", o.turn_rate, "x,y,z in deg/s") * radians(1);
  s.detection.threshold_db = o.threshold_db;
  if (!o.all_bins_above.empty()) {
    s.detection.all_bins = true;
    s.detection.above_db = parse_number("--all-bins-above", o.all_bins_above);
  }
  return s;
}

/// Where the head is, and how it moves if a trajectory says so.
struct Track {
  Pose pose;
  Motion motion;
};

Track track_of(const PingOptions& o) {
  if (!std::isfinite(o.time)) fail(ErrorKind::argument, "--time = ", o.time, " s, must be finite");
  if (o.pose.empty() == o.trajectory.empty())
    fail(ErrorKind::argument, "--pose or --trajectory must be given, one of them, e.g. --pose=0,0,-3,0,10,0");
  if (o.trajectory.empty()) return {parse_pose(o.pose, o.world), {}};
  if (o.world != "z-up") fail(ErrorKind::argument, "--world ", o.world, ": trajectories are z-up; leave --world out");
  if (!o.velocity.empty() || !o.turn_rate.empty())
    fail(ErrorKind::argument, "--velocity and --turn-rate follow from --trajectory; leave them out");
  const Trajectory trajectory = load_trajectory(o.trajectory);
  return {pose_at(trajectory, o.time), motion_at(trajectory, o.time)};
}

/// Boundaries must be there to send anything back.
void require_boundaries(const PingOptions& o, const Environment& environment) {
  if (o.multipath && !environment.surface && !environment.bottom)
    fail(ErrorKind::argument, "--multipath: the environment has neither surface nor bottom; give their heights, e.g. ",
         "--set surface.height_m=0");
}

/// Places of about 10 000 surfels, as seen from the head.
std::vector<Eigen::Vector3d> glance(const SceneCloud& scene, const Pose& pose) {
  std::vector<Eigen::Vector3d> places;
  const std::size_t step = std::max<std::size_t>(1, scene.size() / 10000);
  for (std::size_t i = 0; i < scene.size(); i += step)
    places.push_back(pose.linear().transpose() * (scene.origin - pose.translation() + scene.point[i].cast<double>()));
  return places;
}

/// Catches clouds in other units and poses elsewhere: the middle point must be within reach of the range gate.
void require_in_reach(std::vector<Eigen::Vector3d> places, const RangeGate& gate, const std::string& path) {
  const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
  std::nth_element(places.begin(), middle, places.end(),
                   [](const auto& a, const auto& b) { return a.norm() < b.norm(); });
  const double range = middle->norm();
  if (range > 10 * gate.max_range)
    fail(ErrorKind::content, path, ": the middle point is ", range,
         " m from the head, more than ten times the max range of ", gate.max_range,
         " m; is the cloud in millimetres (--unit mm), or the pose in another frame?");
  if (range < gate.min_range / 10)
    fail(ErrorKind::content, path, ": the middle point is ", range,
         " m from the head, less than a tenth of the min range of ", gate.min_range,
         " m; is the cloud in kilometres (--unit km), or the pose in another frame?");
}

/// What refraction does here, and whether it was left out.
std::string refraction_note(const RefractionReport& r, const RangeGate& gate) {
  const std::string bound =
      fmt::format("straight rays would be off by at most {:.2g} m in range and {:.2g} deg in angle", r.bound.range,
                  degrees(r.bound.elevation));
  if (!r.bent) return fmt::format("refraction left out: {} (bin {:.3g} m)", bound, gate.bin_size);
  return fmt::format("rays bent by the sound-speed profile: {}; {} scatterers in shadow zones", bound, r.silenced);
}

/// What to tell a user who asked for multipath and hears none: most often the sea is too rough.
std::string no_multipath_note(const Environment& environment) {
  const double waves = environment.surface ? rms_wave_height(environment) : 0;
  const std::string sea = waves > 0
                              ? fmt::format("waves of {:.2g} m rms scatter what a smooth surface would reflect", waves)
                              : std::string("boundaries are out of reach, hidden or off the pattern");
  return "no echo comes by way of surface or bottom: " + sea;
}

ordered_json motion_json(const Motion& motion) {
  const auto list = [](const Eigen::Vector3d& v) { return ordered_json{v.x(), v.y(), v.z()}; };
  return {{"velocity_m_s", list(motion.velocity)}, {"turn_rate_deg_s", list(motion.turn_rate * degrees(1))}};
}

/// What to tell a user whose ping is silent: where the scene is.
std::string silence_note(const std::vector<Eigen::Vector3d>& places) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const auto& p : places) centre += p / static_cast<double>(places.size());
  const Direction d = direction_of(centre);
  return fmt::format(
      "nothing of the scene is inside fan and range gate: the ping is silent; the scene's centre is {:.3g} m away, "
      "{:.0f} deg to {} and {:.0f} deg {} the head's axis",
      centre.norm(), std::abs(degrees(d.azimuth)), d.azimuth > 0 ? "port" : "starboard", std::abs(degrees(d.elevation)),
      d.elevation > 0 ? "above" : "below");
}

ordered_json scene_json(const LoadedScene& loaded) {
  const LoadReport& r = loaded.report;
  return {{"path", r.path},
          {"format", r.format},
          {"points_read", r.points_read},
          {"triangles_read", r.triangles_read},
          {"surfels", loaded.scene.size()},
          {"dropped_not_finite", r.dropped_not_finite},
          {"dropped_duplicates", r.dropped_duplicates},
          {"dropped_degenerate_triangles", r.dropped_degenerate},
          {"dropped_without_normal", r.dropped_without_normal},
          {"repaired_normals", r.repaired_normals},
          {"normals", r.normals_estimated ? "estimated" : "from file"},
          {"normals_oriented", loaded.scene.normals_oriented},
          {"material_field", r.material_field},
          {"outside_intervals", r.outside_intervals},
          {"areas", r.areas_estimated ? "estimated" : "from file"},
          {"origin", {loaded.scene.origin.x(), loaded.scene.origin.y(), loaded.scene.origin.z()}}};
}

ordered_json layers_json(const std::vector<LayerReport>& layers) {
  ordered_json json = ordered_json::array();
  for (const LayerReport& layer : layers) json.push_back({{"name", layer.name}, {"echoes", layer.echoes}});
  return json;
}

ordered_json sampling_json(const SimulatedPing& p) {
  const SamplingReport& s = p.sampling;
  return {{"surfels", s.surfels},
          {"in_fan_and_gate", s.in_gate},
          {"back_facing", s.back_facing},
          {"hidden", s.hidden},
          {"visible", s.visible},
          {"rays_missed", s.rays_missed},
          {"scatterers", s.scatterers},
          {"soundings", p.soundings.size()},
          {"noise_floor_db", p.noise_floor_db}};
}

std::string run_toml_head(const PingOptions& o) {
  return fmt::format(
      "\n[scene]\npath = {}\nunit = {}\nmaterial = {}\nmaterials = {}\nmaterial_field = {}\nviewpoint = {}\n"
      "mesh_spacing = {}\n\n[ping]\npose = {}\nworld = {}\ntrajectory = {}\ntime = {}\nvelocity = {}\nturn_rate = {}\n"
      "sampling = {}\nscatterers_per_cell = {}\nrays_per_beam = {}\namplitude = {}\nnoise = {}\nmultipath = {}\n"
      "layers = {}\nabsorption_order = {}\nthreshold_db = {}\nall_bins_above = {}\n",
      toml_text(o.scene.path), toml_text(o.scene.unit), toml_text(o.scene.material), toml_text(o.scene.materials_file),
      toml_text(o.scene.material_field), toml_text(o.scene.viewpoint), o.scene.mesh_spacing, toml_text(o.pose),
      toml_text(o.world), toml_text(o.trajectory), o.time, toml_text(o.velocity), toml_text(o.turn_rate),
      toml_text(o.sampling), o.scatterers_per_cell, o.rays_per_beam, toml_text(o.amplitude), o.noise, o.multipath,
      o.layers, o.absorption_order, o.threshold_db, toml_text(o.all_bins_above));
}

void print_summary(const CommonOptions& common, const std::string& output, const ordered_json& manifest) {
  if (common.json) {
    fmt::print("{}\n", manifest.dump(2));
    return;
  }
  fmt::print("{}: {} scatterers of {} visible surfels, {} soundings, peak {:.1f} dB re 1 uPa\n", output,
             manifest["sampling"]["scatterers"].get<std::size_t>(), manifest["sampling"]["visible"].get<std::size_t>(),
             manifest["sampling"]["soundings"].get<std::size_t>(), manifest["peak_level_db"].get<double>());
}

/// Everything a ping needs but the scene.
struct PingSetup {
  Pose pose;
  HeadSetup head;
  SimulationOptions simulation;
};

PingSetup set_up_ping(const CommonOptions& common, const PingOptions& o) {
  const Track track = track_of(o);
  PingSetup setup{track.pose, set_up_head(common, o.run), simulation_options(common, o)};
  if (!o.trajectory.empty()) setup.simulation.motion = track.motion;
  setup.simulation.time = o.time;
  for (const std::string& stage : o.with) force_stage(stage, true, setup.head.environment, setup.simulation);
  for (const std::string& stage : o.without) force_stage(stage, false, setup.head.environment, setup.simulation);
  require_boundaries(o, setup.head.environment);
  return setup;
}

}  // namespace

void plan(const CommonOptions& common, const PingOptions& o) {
  Progress progress(common, 2);
  const PingSetup ready = set_up_ping(common, o);
  const LoadOptions loading = load_options(common, o.scene);
  progress.step("loading " + o.scene.path);
  const LoadedScene loaded = load_scene(o.scene.path, loading);
  require_in_reach(glance(loaded.scene, ready.pose), ready.head.head.gate, o.scene.path);
  for (const std::string& note : ready.head.notes) progress.note(note);
  for (const std::string& note : loading_notes(loaded.report)) progress.note(note);
  progress.step("planning");
  const PingPlan plan = plan_ping(loaded.scene, ready.head.head, ready.pose, ready.head.environment, ready.simulation);
  if (common.json)
    fmt::print("{}\n", plan_json(plan).dump(2));
  else
    print_plan(plan);
}

void ping(const CommonOptions& common, const PingOptions& o) {
  // Everything that can be wrong on the command line is found before any work.
  Progress progress(common, 4);
  const PingSetup ready = set_up_ping(common, o);
  const Pose& pose = ready.pose;
  const HeadSetup& setup = ready.head;
  const SimulationOptions& simulation = ready.simulation;
  const LoadOptions loading = load_options(common, o.scene);
  RunDirectory directory(o.run.output, o.run.force);

  progress.step("loading " + o.scene.path);
  auto start = Clock::now();
  const LoadedScene loaded = load_scene(o.scene.path, loading);
  const double load_seconds = seconds_since(start);
  const std::vector<Eigen::Vector3d> places = glance(loaded.scene, pose);
  require_in_reach(places, setup.head.gate, o.scene.path);
  ordered_json manifest = {{"schema", 1},
                           {"insonify_version", INSONIFY_VERSION},
                           {"seed", common.seed},
                           {"scene", scene_json(loaded)},
                           {"notes", ordered_json::array()}};
  const auto tell = [&](const std::string& note) {
    progress.note(note);
    manifest["notes"].push_back(note);
  };
  for (const std::string& note : setup.notes) tell(note);
  for (const std::string& note : loading_notes(loaded.report)) tell(note);

  manifest["plan"] = plan_json(plan_ping(loaded.scene, setup.head, pose, setup.environment, simulation));

  progress.step("pinging");
  const SimulatedPing result = simulate_ping(loaded.scene, setup.head, pose, setup.environment, simulation);
  for (const std::string& note : result.notes) tell(note);
  if (result.scatterers.size() == 0) tell(silence_note(places));

  progress.step("writing " + o.run.output);
  start = Clock::now();
  save_soundings(directory.file("returns.pcd"), result.soundings);
  save_soundings(directory.file("returns.ply"), result.soundings);
  if (simulation.keep_elements)
    write_element_file(directory.file("elements.h5"), result.elements, setup.head, result.medium.sound_speed);
  manifest["sampling"] = sampling_json(result);
  manifest["layers"] = layers_json(result.layers);
  if (!simulation.motion.none()) manifest["motion"] = motion_json(simulation.motion);
  for (const LayerReport& layer : result.layers)
    if (layer.name == "multipath" && layer.echoes == 0) tell(no_multipath_note(setup.environment));
  if (setup.environment.profile) tell(refraction_note(result.refraction, setup.head.gate));
  manifest["peak_level_db"] = std::max(-200.0, pressure_level_db(result.ping.pressure.abs().maxCoeff()));
  write_run(directory, common, o.run, setup, result.ping, run_toml_head(o), manifest, progress);
  manifest["seconds"] = {{"load", load_seconds},
                         {"sampling", result.seconds.sampling},
                         {"acoustics", result.seconds.acoustics},
                         {"synthesis", result.seconds.synthesis},
                         {"detection", result.seconds.detection},
                         {"output", seconds_since(start)}};
  write_text_file(directory.file("manifest.json"), manifest.dump(2) + "\n");
  progress.step("done");
  directory.commit();
  print_summary(common, o.run.output, manifest);
}

}  // namespace insonify::tool
