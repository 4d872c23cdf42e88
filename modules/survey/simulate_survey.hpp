// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "survey/randomise.hpp"
#include "survey/scene_source.hpp"
#include "survey/survey_store.hpp"

namespace insonify {

/// What a survey does beside its mission.
struct SurveySettings {
  Randomisation randomisation{};
  std::uint64_t seed = 1;  ///< of the randomisation
  bool coverage = false;   ///< list the surfels that each ping insonified (PingOutcome::covered)
};

/// A mission with a simulator for each of its heads: all pings of a vehicle with sonars along a trajectory.
class Survey {
 public:
  /// `heads` are those of the mission, in its order; every ping runs on one thread. A head of the mission without a
  /// listening time gets that of its range gate in its slowest water. Throws Error(argument) for an invalid mission,
  /// pings closer than the listening time, and another number of simulators than heads.
  Survey(Mission mission, const std::vector<PingSimulator>& heads, SurveySettings settings = {});

  /// The mission, with the listening times that were left out.
  const Mission& mission() const { return mission_; }
  /// All pings, as survey_pings of the mission.
  const std::vector<SurveyPing>& pings() const { return pings_; }
  /// Returns the pings in blocks of at most `most`, head after head.
  std::vector<SurveyBlock> blocks(std::size_t most = 64) const;
  /// Returns the simulator of a ping: that of its head, with what the mission randomises.
  PingSimulator simulator_of(const SurveyPing& ping) const;
  /// Returns time, pose and motion of a ping, with what the mission randomises.
  PingEvent event_of(const SurveyPing& ping) const;

  /// Simulates a ping. With navigation errors, pose and soundings are where the vehicle believes them to be. Several
  /// threads may call it at once. Throws Error as PingSimulator::ping.
  PingOutcome simulate(const SurveyPing& ping, const SceneSource& scene) const;

 private:
  Mission mission_;
  std::vector<PingSimulator> heads_;
  SurveySettings settings_;
  std::vector<SurveyPing> pings_;
};

/// Returns what a survey stores of a simulated ping, as Survey::simulate does.
PingOutcome outcome_of(SimulatedPing&& simulated, const Mission& mission, const SurveyPing& ping);

/// Simulates the pings of some blocks, `threads` (0: all cores) at once, in the order of the blocks. Memory holds the
/// outcomes of unfinished blocks only. The outcome of a ping that throws Error or runs out of memory is a failure.
/// Returns true if no ping is left. The outcomes do not depend on `threads`.
bool simulate_survey(const Survey& survey, const std::vector<SurveyBlock>& blocks, const SceneSource& scene,
                     SurveyStore& store, int threads = 0);

/// Simulates all pings of a survey and returns them. For long surveys give simulate_survey a store of your own.
SurveyInMemory simulate_survey(const Survey& survey, const SceneSource& scene, int threads = 0);

}  // namespace insonify
