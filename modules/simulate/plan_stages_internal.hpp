#pragma once
#include <span>
#include <string>

#include "beamforming/ping_synthesizer.hpp"
#include "simulate/scene_sample_internal.hpp"

/// The stages of a plan, group by group. A new stage is an entry in the table of its group, in the order of the plan.
namespace insonify {

/// What stages are judged by.
struct PlanFacts {
  const SceneCloud& scene;
  const ResolvedPing& ping;
  SceneSample sample;
  SynthesisChoice synthesis;  ///< for one row of beams
};

/// Factor in amplitude for speckle, and for what of the scene hides other parts of it.
constexpr double plan_margin = 2;

/// Amplitude of what `power` adds to the image, relative to what is in view, times the margin; infinite if nothing is.
double relative_amplitude(const PlanFacts& facts, double power);

struct StageVerdict {
  bool included;
  std::string why;
  double bound;  ///< relative error of the image without it; does not count if it is included
};

struct PlanStage {
  const char* name;
  StageVerdict (*judge)(const PlanFacts&);
  /// Sets the options, or takes the cause out of the environment, so that the stage is in or out; nullptr: it cannot.
  void (*force)(bool included, Environment&, SimulationOptions&) = nullptr;
  /// What keeps it from being forced in; nullptr if nothing does.
  const char* (*obstacle)(const Environment&, const SimulationOptions&) = nullptr;
};

std::span<const PlanStage> geometry_stages();
std::span<const PlanStage> effect_stages();
std::span<const PlanStage> synthesis_stages();

}  // namespace insonify
