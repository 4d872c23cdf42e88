// SPDX-License-Identifier: BSD-3-Clause
#include "survey/simulate_survey.hpp"

#include <algorithm>
#include <iterator>
#include <mutex>
#include <new>
#include <utility>

#include "core/error.hpp"
#include "simulate/ping_notes.hpp"
#include "survey/assumed_sound_internal.hpp"
#include "survey/make_blocks_internal.hpp"

namespace insonify {

double listening_time_of(const MissionHead& mounted, const SonarHead& head, const Environment& environment) {
  const double slowest = slowest_sound(environment);
  return 2 * head.gate.max_range / std::min(slowest, mounted.assumed.sound_speed.value_or(slowest));
}

struct Survey::Steered {
  std::mutex guard{};
  std::vector<std::optional<std::pair<double, PingSimulator>>>
      last{};  ///< one for each head, with the true sound speed
};

Survey::Survey(Mission mission, const std::vector<PingSimulator>& heads, SurveySettings settings)
    : mission_(std::move(mission)), steered_(std::make_shared<Steered>()), settings_(settings) {
  if (heads.size() != mission_.heads.size())
    fail(ErrorKind::argument, "Survey: ", heads.size(), " simulators for ", mission_.heads.size(),
         " heads of the mission, must be one for each");
  for (std::size_t h = 0; h < heads.size(); ++h) {
    SimulationOptions of_ping = heads[h].options();
    of_ping.threads = 1;
    of_ping.outputs.scatterers |= settings_.coverage;
    heads_.emplace_back(heads[h].head(), heads[h].environment(), of_ping);
    double& listening = mission_.heads[h].listening_time;
    if (listening == 0) listening = listening_time_of(mission_.heads[h], heads[h].head(), heads[h].environment());
  }
  steered_->last.resize(heads_.size());
  pings_ = survey_pings(mission_);
}

std::vector<SurveyBlock> Survey::blocks(std::size_t most) const {
  return survey_blocks(pings_, std::vector<std::size_t>(mission_.heads.size(), most));
}

Environment Survey::environment_of(const SurveyPing& ping) const {
  return at_tide(heads_.at(ping.head).environment(), mission_.tide, ping.time);
}

double Survey::sound_speed_at(const SurveyPing& ping, const Environment& environment) const {
  const double z = event_of(ping).world_from_head.translation().z();
  const Environment there = environment_at(environment, z, "survey");
  return medium_of(there, heads_.at(ping.head).head().pulse.centre_frequency).sound_speed;
}

PingSimulator Survey::simulator_of(const SurveyPing& ping) const {
  const PingSimulator& simulator = heads_.at(ping.head);
  const std::optional<double>& assumed = mission_.heads[ping.head].assumed.sound_speed;
  const bool tide = !mission_.tide.time.empty(), random = settings_.randomisation.any();
  if (!(assumed || tide || random)) return simulator;
  Environment environment = environment_of(ping);
  if (!random && !assumed) return simulator.in(std::move(environment));
  SonarHead head = simulator.head();
  if (random) apply(randomised(settings_.randomisation, settings_.seed, ping), head, environment);
  const double speed = assumed ? sound_speed_at(ping, environment) : 0;
  if (assumed) head = steered_head(head, speed, *assumed);
  if (random) return PingSimulator(std::move(head), std::move(environment), simulator.options());
  const std::scoped_lock lock(steered_->guard);
  std::optional<std::pair<double, PingSimulator>>& last = steered_->last.at(ping.head);
  if (!last || last->first != speed)
    last.emplace(speed, PingSimulator(std::move(head), environment, simulator.options()));
  return last->second.with(simulator.options()).in(std::move(environment));
}

PingEvent Survey::event_of(const SurveyPing& ping) const {
  PingEvent event = insonify::event_of(mission_, ping);
  if (settings_.randomisation.any())
    event.world_from_head = moved_by(randomised(settings_.randomisation, settings_.seed, ping), event.world_from_head);
  return event;
}

Survey Survey::with_poses(std::vector<Pose> poses) const {
  Survey survey = *this;
  survey.mission_.poses = std::move(poses);
  return survey;
}

Survey Survey::decided(const SceneSource& scene, int threads) const {
  Survey survey = *this;
  for (std::size_t h = 0; h < heads_.size(); ++h) {
    std::vector<SurveyPing> of_head;
    std::copy_if(pings_.begin(), pings_.end(), std::back_inserter(of_head), [h](const auto& p) { return p.head == h; });
    if (of_head.empty()) continue;
    const SurveyPing& middle = of_head[of_head.size() / 2];
    SimulationOptions options = heads_[h].options();
    options.threads = threads;
    try {
      const PingSimulator many = simulator_of(middle).with(options).for_many(of_head.size(), scene, event_of(middle));
      options = heads_[h].options();
      options.sampling.detail = many.options().sampling.detail;
      survey.heads_[h] = heads_[h].with(options);
    } catch (const Error&) {
      // The ping itself fails with the reason.
    } catch (const std::bad_alloc&) {
      // So it does here.
    }
  }
  return survey;
}

PingOutcome Survey::simulate(const SurveyPing& ping, const SceneSource& scene) const {
  const PingSimulator simulator = simulator_of(ping);
  const PingEvent event = event_of(ping);
  const std::shared_ptr<const PreparedScene> prepared = scene.scene_for(simulator, event);
  SimulatedPing simulated = simulator.ping(*prepared, event);
  std::vector<CoveredSurfel> covered;
  if (settings_.coverage)
    covered = coverage_of(prepared->scene(), simulated.outputs.scatterers, simulator.head(), simulated.report.medium,
                          {.threads = 1});
  std::vector<PingNote> notes = notes_of(simulated, simulator.environment(), simulator.head().gate);
  for (PingNote& note : notes) note.first = ping.number;
  if (const auto& assumed = mission_.heads[ping.head].assumed.sound_speed)
    report_as_set(heads_[ping.head].head(), simulated.report.medium.sound_speed, *assumed, simulated);
  PingOutcome outcome = outcome_of(std::move(simulated), mission_, ping);
  outcome.notes = std::move(notes);
  outcome.covered = std::move(covered);
  return outcome;
}

PingOutcome outcome_of(SimulatedPing&& simulated, const Mission& mission, const SurveyPing& ping) {
  PingOutcome outcome{std::move(simulated.ping), std::move(simulated.soundings)};
  outcome.scatterers = simulated.report.sampling.scatterers;
  outcome.ping.number = ping.number;
  const bool assumed = mission.heads[ping.head].assumed.any();
  if (assumed || !mission.navigation.nodes.empty()) {
    const PingEvent believed = believed_event_of(mission, ping);
    Pose& pose = outcome.ping.world_from_head;
    Motion& motion = outcome.ping.motion;
    const Pose truly = pose;
    pose = believed.world_from_head;
    // A random draw of the head stays, as seen from the vehicle.
    if (assumed) pose = pose * (event_of(mission, ping).world_from_head.inverse() * truly);
    const Pose moved = pose * truly.inverse();
    for (Eigen::Vector3d& position : outcome.soundings.position) position = moved * position;
    motion = assumed ? believed.motion : Motion{moved.linear() * motion.velocity, moved.linear() * motion.turn_rate};
  }
  if (mission.heads[ping.head].scan) outcome.ping.scan = ScanDirection{ping.sweep, ping.scan_angle};
  return outcome;
}

bool simulate_survey(const Survey& survey, const std::vector<SurveyBlock>& blocks, const SceneSource& scene,
                     SurveyStore& store, int threads) {
  if (blocks.empty()) return true;
  const Survey decided = survey.decided(scene, threads);
  return make_blocks(
      survey.pings(), blocks, threads, [&](const SurveyPing& ping) { return decided.simulate(ping, scene); }, store);
}

SurveyInMemory simulate_survey(const Survey& survey, const SceneSource& scene, int threads) {
  SurveyInMemory store;
  simulate_survey(survey, survey.blocks(), scene, store, threads);
  return store;
}

void SurveyInMemory::keep(const SurveyBlock& block, BlockOutcomes& outcomes) {
  blocks_.emplace_back(block, std::move(outcomes));
}

std::vector<PingOutcome> SurveyInMemory::of_head(std::size_t head) const {
  std::vector<PingOutcome> all;
  for (const auto& [block, outcomes] : blocks_)
    if (block.head == head)
      for (const std::optional<PingOutcome>& outcome : outcomes)
        if (outcome) all.push_back(*outcome);
  std::sort(all.begin(), all.end(),
            [](const PingOutcome& a, const PingOutcome& b) { return a.ping.number < b.ping.number; });
  return all;
}

}  // namespace insonify
