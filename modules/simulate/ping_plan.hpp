#pragma once
#include <string>
#include <vector>

#include "beamforming/synthesis_choice.hpp"
#include "simulate/simulation_options.hpp"

namespace insonify {

/// Who decides whether a stage is computed.
enum class DecidedBy {
  budget,  ///< in where leaving it out costs more than its share of the budget, or if the options say so
  choice,  ///< noise, reverberation, occlusion, the way of summing: of what user and environment ask for
  scene    ///< in where the scene has a cause for it, or exact
};

/// As reports spell them: "budget", "choice", "scene".
const char* decided_by_name(DecidedBy by);

/// A stage or effect of the model: whether simulate_ping computes it for this scene, and the error of leaving it out.
struct PlannedStage {
  std::string name;
  DecidedBy by = DecidedBy::scene;
  bool included = false;
  std::string why;
  double bound_relative = 0;  ///< relative L2 error of the image from leaving it out; 0 exactly where nothing is lost
  double bound_db = 0;        ///< the same as a level, 20 log10(1 + bound_relative)
};

/// What a ping will compute and leave out.
struct PingPlan {
  std::vector<PlannedStage> stages;
  SimulationOptions options;  ///< the given ones with nothing left open: a ping of them is the ping of this plan
  double share_relative = 0;  ///< of the budget, for each stage that it decides
  double share_db = 0;        ///< 20 log10(1 + share_relative)
  double left_out_db = 0;     ///< bound of all that the budget decides and that is out, together
  SynthesisChoice synthesis;  ///< for one row of beams
};

}  // namespace insonify
