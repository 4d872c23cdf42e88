// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include <fmt/format.h>

#include "beamforming/engine.hpp"
#include "core/units.hpp"
#include "run/scene_reach.hpp"
#include "run_scenes/run_folder.hpp"
#include "simulate/ping_notes.hpp"

namespace insonify {

using nlohmann::ordered_json;

namespace {

/// The options with which a head that receives nothing looks at the scene.
std::string remedy_of_silence(const std::vector<Eigen::Vector3d>& positions, const Eigen::Vector3d& centre,
                              const PingSetup& setup) {
  const Eigen::Vector3d way = setup.event.world_from_head.linear() * centre,
                        at = setup.event.world_from_head.translation();
  std::string remedy =
      setup.run.placement.mount
          ? "move or turn the vehicle by --pose, or the head on it by --mount"
          : fmt::format("--pose={} looks at the scene", pose_text(at, std::atan2(way.y(), way.x()),
                                                                  std::atan2(-way.z(), std::hypot(way.x(), way.y()))));
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const auto& p : positions) nearest = std::min(nearest, p.norm()), farthest = std::max(farthest, p.norm());
  const RangeGate& gate = setup.head.gate;
  if (centre.norm() <= gate.max_range) return remedy;
  // No range beyond that of the sonar itself is proposed.
  const double most = setup.farthest, end = std::min(end_of_range(farthest), most);
  if (nearest > most)
    return remedy + fmt::format("; move the head nearer too: the scene begins {:.3g} m away, {} hears to {:g} m",
                                nearest, setup.spec.name, most);
  if (end > gate.max_range) remedy += fmt::format(", with --range {}", range_text(gate.min_range, end));
  return remedy;
}

/// States that the ping is silent, where the scene lies and what to do.
std::string silence_note(const std::vector<Eigen::Vector3d>& positions, const SamplingReport& sampling,
                         const PingSetup& setup) {
  if (sampling.in_gate > 0)
    return fmt::format(
        "the ping is silent: of {} surfels inside fan and range gate, {} face away from the head and {} are hidden; "
        "move the head to the side to which the normals point, or orient the normals by --viewpoint",
        sampling.in_gate, sampling.back_facing, sampling.hidden);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const auto& p : positions) centre += p / static_cast<double>(positions.size());
  const Direction d = direction_of(centre);
  return fmt::format(
      "the ping is silent: no surfel is inside fan and range gate; the centre of the scene is {:.3g} m away, {:.0f} "
      "deg to {} and {:.0f} deg {} the axis of the head: {}",
      centre.norm(), std::abs(degrees(d.azimuth)), d.azimuth > 0 ? "port" : "starboard", std::abs(degrees(d.elevation)),
      d.elevation > 0 ? "above" : "below", remedy_of_silence(positions, centre, setup));
}

/// JSON has no infinity: null is no bound.
ordered_json finite_or_null(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr); }

}  // namespace

ordered_json scene_json(const LoadReport& r, const SceneCloud& scene) {
  ordered_json json = {{"path", r.path},
                       {"format", r.format},
                       {"points_read", r.points_read},
                       {"triangles_read", r.triangles_read},
                       {"surfels", scene.size()},
                       {"dropped_not_finite", r.dropped_not_finite},
                       {"dropped_withheld", r.dropped_withheld},
                       {"dropped_classes", r.dropped_classes},
                       {"dropped_duplicates", r.dropped_duplicates},
                       {"dropped_degenerate_triangles", r.dropped_degenerate},
                       {"dropped_without_normal", r.dropped_without_normal},
                       {"repaired_normals", r.repaired_normals},
                       {"normals", r.normals_estimated ? "estimated" : "from file"},
                       {"normals_oriented", scene.normals_oriented},
                       {"material_field", r.material_field},
                       {"outside_intervals", r.outside_intervals},
                       {"areas", r.areas_estimated ? "estimated" : "from file"},
                       {"origin", {scene.origin.x(), scene.origin.y(), scene.origin.z()}}};
  if (!r.meaning.system.value.empty()) json["system"] = r.meaning.system.value;
  return json;
}

namespace {

double peak_level_db(const Ping& ping) {
  const auto power = [](const std::complex<float>& p) { return std::norm(std::complex<double>(p)); };
  return std::max(silence_db, pressure_level_db(std::sqrt(ping.pressure.unaryExpr(power).maxCoeff())));
}

ordered_json layers_json(const std::vector<LayerReport>& layers) {
  ordered_json json = ordered_json::array();
  for (const LayerReport& layer : layers) json.push_back({{"name", layer.name}, {"echoes", layer.echoes}});
  return json;
}

ordered_json sampling_json(const SimulatedPing& p) {
  const SamplingReport& s = p.report.sampling;
  ordered_json json{{"surfels", s.surfels},           {"in_fan_and_gate", s.in_gate},
                    {"back_facing", s.back_facing},   {"hidden", s.hidden},
                    {"visible", s.visible},           {"rays_missed", s.rays_missed},
                    {"sparse_beams", s.sparse_beams}, {"scatterers", s.scatterers},
                    {"returns", p.soundings.size()},  {"noise_floor_db", p.report.noise_floor_db}};
  if (s.merged_to > 0) json["merged_to"] = s.merged_to;
  return json;
}

ordered_json holes_json(const HoleReport& holes) {
  return {{"directions", holes.directions},
          {"unknown", holes.unknown},
          {"share", static_cast<double>(holes.unknown) / static_cast<double>(holes.directions)}};
}

ordered_json motion_json(const Motion& motion) {
  const auto list = [](const Eigen::Vector3d& v) { return ordered_json{v.x(), v.y(), v.z()}; };
  return {{"velocity_m_s", list(motion.velocity)}, {"turn_rate_deg_s", list(motion.turn_rate * degrees(1))}};
}

}  // namespace

void describe_ping(const SimulatedPing& ping, const PingSetup& setup, ordered_json& manifest) {
  const Motion& motion = setup.event.motion;
  manifest["sampling"] = sampling_json(ping);
  if (setup.simulation.outputs.mask) manifest["holes"] = holes_json(ping.report.holes);
  manifest["layers"] = layers_json(ping.report.layers);
  if (!motion.none()) manifest["motion"] = motion_json(motion);
  manifest["peak_level_db"] = peak_level_db(ping.ping);
}

std::vector<std::string> notes_before(const PingSetup& setup, const LoadReport& report) {
  std::vector<std::string> notes = setup.notes;
  for (std::string& note : loading_notes(report)) notes.push_back(std::move(note));
  return notes;
}

std::vector<std::string> ping_notes(const SimulatedPing& ping, const PingSetup& setup,
                                    const std::vector<Eigen::Vector3d>& positions) {
  std::vector<std::string> notes;
  for (PingNote& note : notes_of(ping, setup.environment, setup.head.gate))
    notes.push_back(note.kind == silent_note_kind ? silence_note(positions, ping.report.sampling, setup)
                                                  : std::move(note.text));
  return notes;
}

ordered_json plan_json(const PingPlan& plan) {
  ordered_json stages = ordered_json::array();
  for (const PlannedStage& s : plan.stages)
    stages.push_back({{"name", s.name},
                      {"by", decided_by_name(s.by)},
                      {"included", s.included},
                      {"why", s.why},
                      {"bound_db", finite_or_null(s.bound_db)},
                      {"bound_relative", finite_or_null(s.bound_relative)}});
  return {{"accuracy_db", plan.options.accuracy_db},
          {"share_db", plan.share_db},
          {"left_out_db", finite_or_null(plan.left_out_db)},
          {"stages", stages},
          {"synthesis",
           {{"method", engine_of(plan.options.synthesis.method).word},
            {"precision", plan.synthesis.single_precision ? "single" : "double"},
            {"kernel_width", plan.synthesis.kernel_width},
            {"grid", plan.synthesis.grid},
            {"pulse_samples", plan.synthesis.pulse_samples}}}};
}

}  // namespace insonify
