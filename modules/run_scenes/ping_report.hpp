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
namespace insonify {

/// Returns what was read of a scene, and what it became.
nlohmann::ordered_json scene_json(const LoadReport& report, const SceneCloud& scene);
/// Returns the numbers of surfels, scatterers and returns of a ping.
nlohmann::ordered_json sampling_json(const SimulatedPing& ping);
/// Returns the part of the view that holes of the scan leave open.
nlohmann::ordered_json holes_json(const HoleReport& holes);
/// Returns the echoes of each layer.
nlohmann::ordered_json layers_json(const std::vector<LayerReport>& layers);
/// Returns a motion in m/s and degrees a second.
nlohmann::ordered_json motion_json(const Motion& motion);

/// Returns the notes on head, water, place and scene of a ping, before it is made.
std::vector<std::string> notes_before(const PingSetup& setup, const LoadReport& report);

/// Notes on the result: a silent ping, refraction, multipath without any echo. `positions` as from sampled_positions.
std::vector<std::string> ping_notes(const SimulatedPing& ping, const PingSetup& setup,
                                    const std::vector<Eigen::Vector3d>& positions);

/// The plan for the manifest: stages with name, included, why, bound_db, bound_relative (null: no bound), and the
/// parameters of the synthesis.
nlohmann::ordered_json plan_json(const PingPlan& plan);

}  // namespace insonify
