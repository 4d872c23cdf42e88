#pragma once
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"
#include "simulate/simulate_ping.hpp"
#include "tool/head_setup.hpp"
#include "tool/options.hpp"

namespace insonify::tool {

/// Everything a ping needs but the scene.
struct PingSetup {
  Pose pose;
  HeadSetup head;
  SimulationOptions simulation;
};

/// Reads what `options` name and finds everything that is wrong on the command line, before any work.
PingSetup set_up_ping(const CommonOptions& common, const PingOptions& options);

/// The options of a ping as they stand in run.toml: tables [scene] and [ping].
std::string run_toml_head(const PingOptions& options);

/// Places of about 10 000 surfels, as seen from the head.
std::vector<Eigen::Vector3d> sampled_places(const SceneCloud& scene, const Pose& pose);

/// Catches clouds in other units and poses elsewhere: the middle one of `places` must be within reach of the range gate.
void require_in_reach(std::vector<Eigen::Vector3d> places, const RangeGate& gate, const std::string& path);

}  // namespace insonify::tool
