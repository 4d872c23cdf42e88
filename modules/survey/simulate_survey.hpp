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
  /// listening time gets that of its range gate in its slowest water. Throws Error(argument) for an invalid mission, pings
  /// closer than the listening time, and another number of simulators than heads.
  Survey(Mission mission, const std::vector<PingSimulator>& heads, SurveySettings settings = {});

  /// The mission, with the listening times that were left out.
  const Mission& mission() const { return mission_; }
  /// All pings, as survey_pings of the mission.
  const std::vector<SurveyPing>& pings() const { return pings_; }
  /// The pings in blocks of at most `most`, head after head.
  std::vector<SurveyBlock> blocks(std::size_t most = 64) const;
  /// The simulator of a ping: that of its head, but for what is randomised.
  PingSimulator simulator_of(const SurveyPing& ping) const;
  /// When and from where it is sent, with what is randomised.
  PingEvent event_of(const SurveyPing& ping) const;

  /// Simulates a ping. With navigation errors, its pose and its soundings are where the vehicle believes them to be. May be
  /// called by several threads at once. Throws Error as PingSimulator::ping.
  PingOutcome simulate(const SurveyPing& ping, const SceneSource& scene) const;

 private:
  Mission mission_;
  std::vector<PingSimulator> heads_;
  SurveySettings settings_;
  std::vector<SurveyPing> pings_;
};

/// What is stored of a ping of a mission, as Survey::simulate describes it.
PingOutcome outcome_of(SimulatedPing&& simulated, const Mission& mission, const SurveyPing& ping);

/// Makes the pings of some blocks, `threads` (0: all cores) of them at once. Pings are begun in the order of the blocks; no
/// more outcomes are held than those of the blocks begun and not finished. A ping that throws Error or runs out of memory
/// has failed, which is its outcome. True if no ping is left. The outcomes do not depend on `threads`.
bool simulate_survey(const Survey& survey, const std::vector<SurveyBlock>& blocks, const SceneSource& scene,
                     SurveyStore& store, int threads = 0);

/// All pings of a survey, in memory; for long ones give simulate_survey a store of your own.
SurveyInMemory simulate_survey(const Survey& survey, const SceneSource& scene, int threads = 0);

}  // namespace insonify
