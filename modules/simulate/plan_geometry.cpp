// SPDX-License-Identifier: BSD-3-Clause
// Stages of the plan that decide which surfels count: directions, ranges, occlusion. Bounds compare the energy that
// beams receive of a sample of the scene outside sector and gate with that from inside.
#include <limits>

#include "simulate/plan_stages_internal.hpp"

namespace insonify {
namespace {

using E = Environment;
using O = SimulationOptions;

constexpr PlanStage geometry[] = {
    {"back-faces", DecidedBy::scene, [](const PlanCause& of) { return !of.scene.normals_oriented; },
     "normals have no side: both sides reflect", "of surfels that turn away Lambert's law gives nothing"},
    {"other-ranges", DecidedBy::scene, never, "",
     "pulses from there have ended before the gate begins, or begin after it",
     [](const PlanFacts& facts) { return bound_of_added_echoes(facts, facts.sample.other_ranges); }},
    {"outer-elevations", DecidedBy::budget, always, "the elevation pattern is below elevation_floor_db there", "",
     [](const PlanFacts& facts) { return bound_of_added_echoes(facts, facts.sample.off_elevation); },
     [](bool in, E&, O& o) { o.sampling.outer_elevations = chosen(in); },
     [](const O& o) { return o.sampling.outer_elevations; }},
    {"outer-azimuths", DecidedBy::budget, always, "side lobes of the beams receive it", "",
     [](const PlanFacts& facts) { return bound_of_added_echoes(facts, facts.sample.off_azimuth); },
     [](bool in, E&, O& o) { o.sampling.outer_azimuths = chosen(in); },
     [](const O& o) { return o.sampling.outer_azimuths; }},
    {"detail", DecidedBy::choice, [](const PlanCause& of) { return merges_surfels(of.scene, of.options); },
     "surfels finer than the head resolves are merged; of nodes a beam wide, errors are at most 0.05 dB in total, 0.1 "
     "dB in "
     "a tenth of the ranges, and 3 cells of range at the edges of shadows",
     "not asked for, or the scene, an output or the number of its pings has no use for it", nullptr,
     [](bool in, E&, O& o) {
       SamplingSettings& s = o.sampling;
       s.detail = chosen(in);
       if (!in) s.detail_width = s.detail_spacing = 0;
     }},
    {"occlusion", DecidedBy::choice, [](const PlanCause& of) { return of.options.sampling.occlusion; },
     "surfels hide others", "off by the options",
     [](const PlanFacts&) { return std::numeric_limits<double>::infinity(); },
     [](bool in, E&, O& o) { o.sampling.occlusion = in; }}};

}  // namespace

std::span<const PlanStage> geometry_stages() { return geometry; }

}  // namespace insonify
