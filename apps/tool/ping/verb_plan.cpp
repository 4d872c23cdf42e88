// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "beamforming/engine.hpp"
#include "run/ping_setup.hpp"
#include "run_scenes/run_folder.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"

namespace insonify::tool {
namespace {

std::string bound_text(const PlannedStage& stage) {
  if (std::isinf(stage.bound_relative)) return "not known";
  if (stage.bound_relative == 0) return "0";
  return fmt::format("{:.2g} dB", stage.bound_db);
}

std::string share_text(const PlannedStage& stage, const PingPlan& plan) {
  return stage.by == DecidedBy::budget ? fmt::format("{:.2g} dB", plan.share_db) : decided_by_name(stage.by);
}

void print_plan(const PingPlan& plan) {
  fmt::print("{:<18} {:<4} {:<10} {:<9} {}\n", "stage", "", "bound", "share", "why");
  for (const PlannedStage& s : plan.stages)
    fmt::print("{:<18} {:<4} {:<10} {:<9} {}\n", s.name, s.included ? "in" : "out", bound_text(s), share_text(s, plan),
               s.why);
  fmt::print(
      "bound: largest error of the image without the stage; share: part of the {} dB of --accuracy-db that one stage "
      "may take, or who decides about the stage\n",
      plan.options.accuracy_db);
  fmt::print("all stages left out: {:.2g} dB at most\n", plan.left_out_db);
  fmt::print("synthesis: {}, {} precision", engine_of(plan.options.synthesis.method).word,
             plan.synthesis.single_precision ? "single" : "double");
  if (plan.synthesis.grid > 0)
    fmt::print(", kernel {} on a grid of {} steps, {} samples per pulse", plan.synthesis.kernel_width,
               plan.synthesis.grid, plan.synthesis.pulse_samples);
  fmt::print("\n");
}

void add_plan_verb_options(OptionList list, PingCommand& command) { add_ping_options(list, command, false); }

void plan(const PingCommand& command) {
  Progress progress(command.common, 2);
  PingSetup ready = set_up_ping(complete_run(command));
  progress.step("loading " + ready.run.scene.path);
  const ReadyPing sent = load_ping_scene(ready);
  for (const std::string& note : notes_before(ready, sent.scene.report)) progress.note(note);
  progress.step("planning");
  const PreparedScene& scene = *sent.scene.scene;
  const PingPlan plan = sent.simulator.plan(scene, ready.event);
  const SamplingReport count = sent.simulator.count(scene, ready.event);
  nlohmann::ordered_json json = plan_json(plan);
  json["surfels_in_view"] = count.visible, json["back_facing"] = count.back_facing;
  json["scatterers"] = count.scatterers;
  print_result(command.common, json, [&] {
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
