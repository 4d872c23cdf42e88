#pragma once
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"
#include "simulate/simulate_ping.hpp"
#include "tool/head_setup.hpp"
#include "tool/options.hpp"

namespace insonify::tool {

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

}  // namespace insonify::tool
