#pragma once
#include <string>
#include <vector>

#include "beamforming/ping_synthesizer.hpp"
#include "simulate/simulate_ping.hpp"

namespace insonify {

/// A stage or effect of the model: whether simulate_ping computes it for this scene, and the error of leaving it out.
struct PlannedStage {
  std::string name;
  bool included = false;
  std::string why;
  double bound_relative = 0;  ///< relative L2 error of the image from leaving it out; 0 exactly where nothing is lost
  double bound_db = 0;        ///< the same as a change of mean level, 20 log10(1 + bound_relative)
};

/// What a ping will compute and leave out.
struct PingPlan {
  std::vector<PlannedStage> stages;
  SynthesisChoice synthesis;        ///< for one row of beams
  std::size_t surfels_in_view = 0;  ///< estimated from a sample of the scene: inside fan and gate, facing the head
  double scatterers = 0;            ///< estimated number after splitting, occlusion not counted
  double seconds = 0;               ///< rough estimate of the wall time on one core
  double mib = 0;                   ///< rough estimate of the memory of scatterers, echoes and image
};

/// The plan of simulate_ping for the same arguments, from a sample of the scene (20 000 surfels at most), head,
/// environment and options; nothing is simulated.
///
/// Bounds of what lies outside sector and gate come from the incoherent sum of all surfels without occlusion, with a
/// factor of 2 in amplitude for speckle and for occlusion. A bound is 0 where an effect has no cause (no boundary, no
/// motion, no relief). bound_relative may exceed 1: then the stage changes the image altogether, and was left out
/// because it was not asked for. Throws Error as simulate_ping does.
PingPlan plan_ping(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head,
                   const Environment& environment, const SimulationOptions& options = {});

/// Forces a stage in or out, by its name in the plan. Forcing direct-sum or true-delays out of a ping of another method
/// changes nothing. Throws Error(argument) for a stage that is unknown or cannot be forced, naming those that can, and
/// for one that cannot be forced in, naming what is missing.
void force_stage(const std::string& name, bool included, Environment& environment, SimulationOptions& options);

}  // namespace insonify
