// Stages of the plan that decide which surfels count: directions, ranges, occlusion. Bounds add up the echo power of a
// sample of the scene outside sector and gate, relative to the power inside.
#include <algorithm>
#include <cmath>
#include <limits>

#include "beamforming/beam_pattern.hpp"
#include "core/units.hpp"
#include "simulate/plan_stages_internal.hpp"

namespace insonify {
namespace {

using E = Environment;
using O = SimulationOptions;

StageVerdict judge_back_faces(const PlanFacts& facts) {
  if (!facts.scene.normals_oriented) return {true, "normals have no side: both sides reflect", 0};
  return {false, std::to_string(facts.sample.back_facing) + " surfels in view turn away: Lambert's law gives nothing",
          0};
}

StageVerdict judge_other_ranges(const PlanFacts& facts) {
  return {false, "pulses from there have ended before the gate begins, or begin after it",
          relative_amplitude(facts, facts.sample.beyond_gate)};
}

StageVerdict judge_outer_elevations(const PlanFacts& facts) {
  const auto floor_db = static_cast<int>(facts.ping.options.sampling.elevation_floor_db);
  return {false, "the elevation pattern is below " + std::to_string(floor_db) + " dB there",
          relative_amplitude(facts, facts.sample.off_elevation)};
}

/// Highest response beside the main lobe, of the beam ahead and of the outermost ones.
double side_lobe(const ResolvedPing& ping) {
  const SonarHead& head = ping.head;
  const double wavelength = ping.sent.medium.sound_speed / head.pulse.centre_frequency;
  double highest = 0;
  const auto [low, high] = std::minmax_element(head.fan.azimuth.begin(), head.fan.azimuth.end());
  for (const double azimuth : {0.0, *low, *high}) {
    const double steering = std::clamp(azimuth, -pi / 2, pi / 2);
    const BeamPatternReport beam = measure_beam_pattern(head.array, wavelength, steering);
    if (!beam.grating_lobes.empty() || head.array.elements() == 1) return 1;
    highest = std::max(highest, amplitude_from_db(beam.highest_side_lobe_db));
  }
  return highest;
}

StageVerdict judge_outer_azimuths(const PlanFacts& facts) {
  return {false, "beams hear only side lobes from there",
          side_lobe(facts.ping) / facts.synthesis.share * relative_amplitude(facts, facts.sample.off_azimuth)};
}

StageVerdict judge_occlusion(const PlanFacts& facts) {
  const bool occlusion = facts.ping.options.sampling.occlusion;
  return {occlusion, occlusion ? "surfels hide others" : "left out on request",
          std::numeric_limits<double>::infinity()};
}

constexpr PlanStage stages[] = {
    {"back-faces", judge_back_faces},
    {"other-ranges", judge_other_ranges},
    {"outer-elevations", judge_outer_elevations,
     [](bool in, E&, O& o) { o.sampling.elevation_floor_db = in ? -400 : SamplingSettings{}.elevation_floor_db; }},
    {"outer-azimuths", judge_outer_azimuths, [](bool in, E&, O& o) { o.sampling.azimuth_margin = in ? pi : 0; }},
    {"occlusion", judge_occlusion, [](bool in, E&, O& o) { o.sampling.occlusion = in; }}};

}  // namespace

std::span<const PlanStage> geometry_stages() { return stages; }

}  // namespace insonify
