// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "run/ping_setup.hpp"
#include "scene_io/load_scene.hpp"
#include "simulate/plan_ping.hpp"

/// The parts of a ping's manifest, its notes, and its plan.
namespace insonify::tool {

nlohmann::ordered_json scene_json(const LoadReport& report, const SceneCloud& scene);
nlohmann::ordered_json sampling_json(const SimulatedPing& ping);
nlohmann::ordered_json holes_json(const HoleReport& holes);
nlohmann::ordered_json layers_json(const std::vector<LayerReport>& layers);
nlohmann::ordered_json motion_json(const Motion& motion);

/// Notes on the result: a silent ping, refraction, multipath without any echo. `places` as from sampled_places;
/// `mounted`: the pose of the options is that of a vehicle.
std::vector<std::string> ping_notes(const SimulatedPing& ping, const PingSetup& setup,
                                    const std::vector<Eigen::Vector3d>& places, bool mounted);

/// The plan for the manifest: stages with name, included, why, bound_db, bound_relative (null: no bound), and the
/// parameters of the synthesis.
nlohmann::ordered_json plan_json(const PingPlan& plan);

/// The plan as a table on stdout.
void print_plan(const PingPlan& plan);

}  // namespace insonify::tool
