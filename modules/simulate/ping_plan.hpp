// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "beamforming/gridded/synthesis_choice.hpp"
#include "simulate/simulation_options.hpp"

namespace insonify {

/// The rule that decides whether a stage is computed.
enum class DecidedBy {
  budget,  ///< included if omitting it costs more than its share of the budget, or if the options say so
  choice,  ///< included if user or environment ask for it: noise, reverberation, occlusion, method of summation
  scene    ///< included if the scene has a cause for it; exact either way
};

/// Returns the name for reports: "budget", "choice", "scene".
const char* decided_by_name(DecidedBy by);

/// An effect of the model: whether a ping of this scene computes it, and the error of omitting it.
struct PlannedStage {
  std::string name;
  DecidedBy by = DecidedBy::scene;
  bool included = false;
  std::string why;
  double bound_relative = 0;  ///< relative L2 error of the image without it; exactly 0 where nothing is lost
  double bound_db = 0;        ///< the same as a level, 20 log10(1 + bound_relative)
};

/// The effects that a ping will compute and omit.
struct PingPlan {
  std::vector<PlannedStage> stages;
  SimulationOptions options;  ///< the given options with all effects decided; a ping with them follows this plan
  double share_relative = 0;  ///< relative error that the budget allows each effect that it decides
  double share_db = 0;        ///< 20 log10(1 + share_relative)
  double left_out_db = 0;     ///< joint bound of the effects that the budget omits
  SynthesisChoice synthesis;  ///< for one row of beams
};

}  // namespace insonify
