// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "acoustics/multipath_echoes.hpp"
#include "run/requested_simulation.hpp"
#include "scene/scene_cloud.hpp"
#include "scene_io/load_scene.hpp"
#include "simulate/ping_simulator.hpp"
#include "sonar/sonar_spec.hpp"
#include "store/mission_file.hpp"
#include "store/sonar_file.hpp"

namespace insonify {

/// Everything that a ping needs except the scene, or pings of a head with poses of their own. The head does not depend
/// on where it pings: its bins are fine enough for the slowest sound of the water.
struct PingSetup {
  Run run{};                       ///< run that was asked for, with decisions that its run.toml records
  PingEvent event{};               ///< place and time of the ping, if it is of one
  SimulationOptions simulation{};  ///< requested_simulation, with stages forced in or out
  SonarSpec spec{};
  SonarHead head{};
  Environment environment{};
  Medium medium{};                   ///< medium of the water as given; PingReport::medium is that at the head's depth
  Pose mount = Pose::Identity();     ///< mounting on a vehicle, as the sonar's file says
  std::vector<std::string> notes{};  ///< inputs outside the validity of the formulas
  bool range_is_own = false;         ///< true: the sonar's range, neither options nor a run say another
  double farthest = std::numeric_limits<double>::infinity();  ///< greatest range of the sonar's file [m]; inf: a run's
  std::vector<SourcedNumber> doubtful{};  ///< numbers of the sonar that are assumed or unknown, for the manifest

  /// Returns the simulator of the head with these options.
  PingSimulator simulator() const { return {head, environment, simulation}; }
};
/// Returns sonar and environment: presets or files, then --set, then --range. Throws Error(argument) for what
/// environment_at refuses of a head at `head_height` [m], if that is given.
///
/// water_level  replaces that of the environment [m]
/// tide         true: it is that of a tide, with which a sea surface moves, whose height must then be 0
PingSetup set_up_head(const HeadOptions& options, std::optional<double> head_height = std::nullopt,
                      std::optional<double> water_level = std::nullopt, bool tide = false);
/// Returns the setup of a sonar and an environment that are read already: `spec` is that of the file, changed perhaps.
PingSetup set_up_head(const SonarFile& file, const SonarSpec& spec, Environment environment,
                      std::optional<double> head_height = std::nullopt);

/// The mounting that the file of a sonar names; absent if it names none.
std::optional<GivenPose> given_mounting(const SonarFile& sonar);

/// Options of loading a scene. Materials come from --materials, else, with --material, from the table that is part of
/// insonify.
LoadOptions load_options(const SceneOptions& scene, std::uint64_t seed = 1, int threads = 0);

/// One sentence per thing that was dropped, repaired or assumed on loading.
std::vector<std::string> loading_notes(const LoadReport& report);

/// Returns where and when the head pings, and how it moves; Error(argument) names the option.
PingEvent requested_event(const Placement& placement);

/// Returns a sentence if the number of a ping is its time in milliseconds and the time lies between two: other pings
/// within the millisecond have its noise. Empty otherwise.
std::string number_note(const PingEvent& event, const Placement& placement);

/// Completes the setup of a head by the run that it pings for, and checks all options; Error(argument) names them.
PingSetup set_up(PingSetup head, const Run& run, const PingEvent& event = {}, NamedBy by = NamedBy::option);
/// Reads sonar, environment and trajectory and checks all options; Error(argument) names the option. The scene is not
/// read.
PingSetup set_up_ping(const Run& run);

/// Positions of about 10 000 surfels in head axes [m].
std::vector<Eigen::Vector3d> sampled_positions(const SceneCloud& scene, const Pose& pose);

/// Throws Error(content) if the median range of `positions` is far outside the range gate: the cloud is in other units, or
/// the pose in another frame.
void require_in_reach(std::vector<Eigen::Vector3d> positions, const RangeGate& gate, const std::string& path);

/// Returns head `h` of a mission with the settings that its file gives for all. Its run.toml has the pose of no ping.
/// Throws Error(content) for these settings, and Error(argument) for sonar, range and environment, naming the setting.
PingSetup set_up_survey_head(const MissionFile& file, std::size_t h, int threads = 0);

}  // namespace insonify
