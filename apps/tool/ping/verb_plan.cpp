// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "run/ping_setup.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/ping/ping_report.hpp"
#include "tool/run/scene_files.hpp"

namespace insonify::tool {
namespace {

void add_plan_verb_options(OptionList list, PingCommand& command) { add_ping_options(list, command, false); }

void plan(const PingCommand& command) {
  const PingOptions o = complete_options(command);
  Progress progress(o.common, 2);
  PingSetup ready = set_up_ping(o);
  progress.step("loading " + o.scene.path);
  const PingScene in_reach = load_ping_scene(o, ready);
  for (const std::string& note : ready.head.notes) progress.note(note);
  for (const std::string& note : loading_notes(in_reach.loaded.report)) progress.note(note);
  progress.step("planning");
  const std::shared_ptr<const PreparedScene> scene = in_reach.prepared(ready.simulation.threads);
  const PingSimulator simulator = ready.simulator();
  const PingPlan plan = simulator.plan(*scene, ready.event);
  const SamplingReport count = simulator.count(*scene, ready.event);
  nlohmann::ordered_json json = plan_json(plan);
  json["surfels_in_view"] = count.visible, json["back_facing"] = count.back_facing;
  json["scatterers"] = count.scatterers;
  print_result(o.common, json, [&] {
    print_plan(plan);
    fmt::print("{} surfels are in view, {} more face away; {} scatterers\n", count.visible, count.back_facing,
               count.scatterers);
  });
}

}  // namespace

Verb plan_verb() {
  return make_verb<PingCommand>(
      "plan", "the stages that a ping computes and leaves out, with the error of each one left out",
      {"insonify plan reef.pcd --sonar oculus-m750d --pose=-1,4,-2.2,0,15,0 --range 0.5:9",
       "insonify plan harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --set surface.height_m=0 --json"},
      add_plan_verb_options, plan);
}

}  // namespace insonify::tool
