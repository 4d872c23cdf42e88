// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "survey/randomise.hpp"
#include "survey/scene_source.hpp"
#include "survey/survey_store.hpp"

namespace insonify {

/// Options of a survey beside its mission.
struct SurveySettings {
  Randomisation randomisation{};
  std::uint64_t seed = 1;  ///< seed of the randomisation
  bool coverage = false;   ///< list the surfels that each ping insonified (PingOutcome::covered)
};

/// Returns 2 max_range / c [s], c the slowest sound of the environment, or that to which the head is set if it is
/// slower: the time after which the head may ping again.
double listening_time_of(const MissionHead& mounted, const SonarHead& head, const Environment& environment);

/// A mission with a simulator for each of its heads: all pings of a vehicle with sonars along a trajectory.
class Survey {
 public:
  /// Sets up a survey. `heads` are the simulators of the mission's heads, in its order; every ping runs on one thread.
  /// A head without a listening time gets that of its range gate in its slowest water. Throws Error(argument) for an
  /// invalid mission, for pings closer than the listening time, and if the numbers of simulators and heads differ.
  Survey(Mission mission, const std::vector<PingSimulator>& heads, SurveySettings settings = {});

  /// Returns the mission, with all listening times set.
  const Mission& mission() const { return mission_; }
  /// Returns all pings: survey_pings of the mission.
  const std::vector<SurveyPing>& pings() const { return pings_; }
  /// Returns the pings in blocks of at most `most`, head after head.
  std::vector<SurveyBlock> blocks(std::size_t most = 64) const;
  /// Returns the simulator of a ping: that of its head, with the random differences of the mission applied, in water of
  /// the height that the tide has, and with beams steered as another sound speed at the head steers them.
  PingSimulator simulator_of(const SurveyPing& ping) const;
  /// Returns the environment of a ping: that of its head, with the water level of the mission's tide.
  Environment environment_of(const SurveyPing& ping) const;
  /// Returns time, pose and motion of a ping, with the random differences of the mission applied.
  PingEvent event_of(const SurveyPing& ping) const;

  /// Returns the survey with these poses of its vehicle, of a mission with random poses.
  Survey with_poses(std::vector<Pose> poses) const;
  /// Returns the survey with SamplingSettings::detail of each head decided by its middle ping (PingSimulator::for_many);
  /// what ping and scene refuse leaves it open. threads: 0: all cores; the decision does not depend on it.
  Survey decided(const SceneSource& scene, int threads = 0) const;
  /// Returns the options of a head's simulator.
  const SimulationOptions& options_of(std::size_t head) const { return heads_.at(head).options(); }

  /// Simulates a ping and returns its outcome. With navigation errors or an assumed installation, pose, motion, beams,
  /// ranges and soundings are those that navigation and head report. Several threads may call it at once. Throws Error
  /// as PingSimulator::ping.
  PingOutcome simulate(const SurveyPing& ping, const SceneSource& scene) const;

 private:
  Mission mission_;
  struct Steered;
  double sound_speed_at(const SurveyPing& ping, const Environment& environment) const;

  std::vector<PingSimulator> heads_;
  std::shared_ptr<Steered>
      steered_;  ///< simulators of heads set to another sound speed, which copies of the survey share
  SurveySettings settings_;
  std::vector<SurveyPing> pings_;
};

/// Returns the outcome that a survey stores for a simulated ping, as Survey::simulate does.
PingOutcome outcome_of(SimulatedPing&& simulated, const Mission& mission, const SurveyPing& ping);

/// Simulates the pings of some blocks, `threads` (0: all cores) at once, in the order of the blocks. Memory holds the
/// outcomes of unfinished blocks only. The outcome of a ping that throws Error or runs out of memory is a failure.
/// Returns true if no ping is left. The outcomes do not depend on `threads`. What survey.decided decides is decided
/// first.
bool simulate_survey(const Survey& survey, const std::vector<SurveyBlock>& blocks, const SceneSource& scene,
                     SurveyStore& store, int threads = 0);

/// Simulates all pings of a survey and returns them. For long surveys pass your own store to simulate_survey.
SurveyInMemory simulate_survey(const Survey& survey, const SceneSource& scene, int threads = 0);

}  // namespace insonify
