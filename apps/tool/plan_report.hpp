#pragma once
#include <nlohmann/json_fwd.hpp>

#include "simulate/plan_ping.hpp"

namespace insonify::tool {

/// The plan for the manifest: stages with name, included, why, bound_db, bound_relative (null: no bound), and the
/// parameters of the synthesis.
nlohmann::ordered_json plan_json(const PingPlan& plan);

/// The plan as a table on stdout.
void print_plan(const PingPlan& plan);

}  // namespace insonify::tool
