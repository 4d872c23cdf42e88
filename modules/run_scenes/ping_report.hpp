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
/// Adds to a manifest what a ping was made of: surfels, scatterers and returns, holes, layers, motion, peak level.
void describe_ping(const SimulatedPing& ping, const PingSetup& setup, nlohmann::ordered_json& manifest);

/// Returns the notes on head, water, place and scene of a ping, before it is made.
std::vector<std::string> notes_before(const PingSetup& setup, const LoadReport& report);

/// Notes on the result: a silent ping, refraction, multipath without any echo. `positions` as from sampled_positions.
std::vector<std::string> ping_notes(const SimulatedPing& ping, const PingSetup& setup,
                                    const std::vector<Eigen::Vector3d>& positions);

/// The plan for the manifest: stages with name, included, why, bound_db, bound_relative (null: no bound), and the
/// parameters of the synthesis.
nlohmann::ordered_json plan_json(const PingPlan& plan);

}  // namespace insonify
