// Stages of the plan that decide which surfels count: directions, ranges, occlusion. Bounds compare the energy that
// beams receive of a sample of the scene outside sector and gate with that from inside.
#include <limits>

#include "simulate/plan_stages_internal.hpp"

namespace insonify {
namespace {

using E = Environment;
using O = SimulationOptions;

StageVerdict judge_back_faces(const PlanFacts& facts) {
  if (!facts.scene.normals_oriented) return {true, "normals have no side: both sides reflect", 0};
  return {false, "of surfels that turn away Lambert's law gives nothing", 0};
}

StageVerdict judge_other_ranges(const PlanFacts& facts) {
  return {false, "pulses from there have ended before the gate begins, or begin after it",
          added_bound(facts, facts.sample.other_ranges)};
}

StageVerdict judge_outer_elevations(const PlanFacts& facts) {
  const auto floor_db = static_cast<int>(facts.ping.options.sampling.elevation_floor_db);
  return {false, "the elevation pattern is below " + std::to_string(floor_db) + " dB there",
          added_bound(facts, facts.sample.off_elevation)};
}

StageVerdict judge_outer_azimuths(const PlanFacts& facts) {
  return {false, "side lobes of the beams receive it", added_bound(facts, facts.sample.off_azimuth)};
}

StageVerdict judge_occlusion(const PlanFacts& facts) {
  const bool occlusion = facts.ping.options.sampling.occlusion;
  return {occlusion, occlusion ? "surfels hide others" : "off by the options", std::numeric_limits<double>::infinity()};
}

constexpr PlanStage geometry[] = {
    {"back-faces", DecidedBy::scene, judge_back_faces},
    {"other-ranges", DecidedBy::scene, judge_other_ranges},
    {"outer-elevations", DecidedBy::budget, judge_outer_elevations,
     [](bool in, E&, O& o) { o.sampling.outer_elevations = chosen(in); }, nullptr,
     [](const O& o) { return o.sampling.outer_elevations; }},
    {"outer-azimuths", DecidedBy::budget, judge_outer_azimuths,
     [](bool in, E&, O& o) { o.sampling.outer_azimuths = chosen(in); }, nullptr,
     [](const O& o) { return o.sampling.outer_azimuths; }},
    {"occlusion", DecidedBy::choice, judge_occlusion, [](bool in, E&, O& o) { o.sampling.occlusion = in; }}};

}  // namespace

std::span<const PlanStage> geometry_stages() { return geometry; }

}  // namespace insonify
