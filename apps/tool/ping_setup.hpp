#pragma once
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"
#include "scene_io/load_scene.hpp"
#include "simulate/simulate_ping.hpp"
#include "tool/head_setup.hpp"
#include "tool/options.hpp"

namespace insonify::tool {

/// Whether --keep names `what`.
bool keeps(const PingOptions& options, const std::string& what);

/// Everything that a ping needs except the scene.
struct PingSetup {
  Pose pose;
  HeadSetup head;
  SimulationOptions simulation;
};

/// Reads sonar, environment and trajectory and checks all options; Error(argument) names the option. The scene is not
/// read.
PingSetup set_up_ping(const PingOptions& options);

/// Places of about 10 000 surfels in head axes [m].
std::vector<Eigen::Vector3d> sampled_places(const SceneCloud& scene, const Pose& pose);

/// Throws Error(content) if the median range of `places` is far outside the range gate: the cloud is in other units, or
/// the pose in another frame.
void require_in_reach(std::vector<Eigen::Vector3d> places, const RangeGate& gate, const std::string& path);

constexpr double bytes_to_ping = 192;  ///< per surfel read: surfel, index, scatterers and echoes

/// Replaces the overview of a mesh by the surfels that the ping needs (E70), within --memory-limit, and notes what could
/// not be kept; leaves other scenes as they are.
void sample_for_ping(const PingOptions& options, const PingSetup& setup, LoadedScene& loaded);

}  // namespace insonify::tool
