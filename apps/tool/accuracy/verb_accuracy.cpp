// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "accuracy/accuracy_sweep.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "files/peak_memory.hpp"
#include "run/parse_values.hpp"
#include "run/ping_setup.hpp"
#include "run/run_checks.hpp"
#include "run_scenes/open_scene.hpp"
#include "run_scenes/run_folder.hpp"
#include "store/run_directory.hpp"
#include "tool/accuracy/accuracy_files.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

struct AccuracyOptions {
  CommonOptions common;
  Run run;  ///< scene (without a path: built-in tasks), head and output
  std::string pose;
  std::string world = "z-up";
  std::vector<std::string> methods, tolerances;  ///< empty: all
  int repeats = 5;
  bool full = false, quick = false;
};

void add_options(OptionList list, AccuracyOptions& o) {
  o.run.output.folder = "accuracy";
  list.add("-o,--output", &o.run.output.folder, "run directory that is made; default: accuracy");
  list.add("--scene", &o.run.scene.path, "scene of your own ping, whose echoes are measured; needs --sonar and --pose");
  list.add("--sonar", &o.run.head.sonar, "preset (see `insonify sonars`) or a .toml file");
  list.add("--pose", &o.pose, "x,y,z,yaw,pitch,roll [m, deg] of the head; pitch is positive nose down");
  add_world(list, o.world);
  list.add("--range", range_value(o.run.head), "min:max [m]; default: the sonar's range");
  list.add("--material", &o.run.scene.material, "name of one material for the whole scene, e.g. sand");
  list.add("--methods", &o.methods, "methods that are measured: " + joined(accuracy_methods()) + "; default: all",
           {.comma_separated = true});
  list.add("--tolerances", &o.tolerances, "tolerances of gridded, e.g. 1e-3,1e-6", {.comma_separated = true});
  list.add("--repeats", &o.repeats, "timed runs of each method, after one to warm up; fewer if they take long");
  list.add("--full", &o.full, "measure larger tasks and all tolerances: some ten minutes");
  list.add("--quick", &o.quick, "tiny tasks: seconds", {.group = ""});
  list.add("--set", &o.run.head.settings, "SECTION.KEY=VALUE of sonar or environment", {.one_each = true});
  list.add("--force", &o.run.output.force, "replace an existing run directory");
  list.add("--no-picture", &o.run.output.no_picture, "do not draw the charts");
  add_common(list, o.common);
  add_work(list, o.common.threads, o.common.seed);
}

SweepOptions sweep_options(const AccuracyOptions& o) {
  SweepOptions sweep;
  sweep.size = o.quick ? SweepSize::quick : o.full ? SweepSize::full : SweepSize::standard;
  sweep.seed = o.common.seed;
  sweep.threads = o.common.threads;
  sweep.methods = o.methods;
  in_words_of("--methods", [&] { require_valid(sweep); });
  for (const std::string& text : o.tolerances) sweep.tolerances.push_back(parse_number("--tolerances", text));
  in_words_of("--tolerances", [&] { require_valid(sweep); });
  return sweep;
}

/// The steps for the user's own scene, or for the built-in tasks.
std::vector<AccuracyStep> steps_of(const AccuracyOptions& o, const SweepOptions& sweep, Progress& progress) {
  if (o.run.scene.path.empty()) {
    if (!o.run.head.sonar.empty() || !o.pose.empty() || o.run.head.range)
      fail(ErrorKind::argument,
           "--sonar, --pose and --range need --scene FILE; without a scene the tasks are built in");
    return accuracy_sweep(sweep);
  }
  if (o.run.head.sonar.empty() || o.pose.empty())
    fail(ErrorKind::argument, "--scene needs --sonar and --pose, e.g. --sonar p900-45 --pose=0,0,-3,0,10,0");
  PingSetup setup = set_up_head(o.run.head);
  setup.event.world_from_head = parse_pose(o.pose, o.world) * setup.mount;
  setup.simulation.seed = o.common.seed;
  setup.simulation.threads = o.common.threads;
  progress.step("loading " + o.run.scene.path);
  const auto scene = open_scene(o.run.scene, {{o.common.seed, {}}, o.common.threads});
  const PingScene pinged = scene->ping_scene(setup.simulator(), setup.event);
  for (const std::string& note : loading_notes(pinged.report)) progress.note(note);
  return accuracy_sweep_of(
      task_of(pinged.scene->scene(), setup.head, setup.event.world_from_head, setup.environment, setup.simulation),
      sweep);
}

std::vector<AccuracyRow> run_steps(const std::vector<AccuracyStep>& steps, const AccuracyOptions& o,
                                   Progress& progress) {
  std::vector<AccuracyRow> rows;
  for (const AccuracyStep& step : steps) {
    progress.step(step.what);
    const AccuracyBench bench(step.sweep, step.make(), {.threads = o.common.threads, .repeats = o.repeats});
    for (const AccuracyRun& run : step.runs) rows.push_back(run.measure(bench));
  }
  return rows;
}

ordered_json manifest_of(const AccuracyOptions& o) {
  return {{"schema", 1},
          {"insonify_version", INSONIFY_VERSION},
          {"seed", o.common.seed},
          {"threads", thread_count(o.common.threads)},
          {"size", o.quick  ? "quick"
                   : o.full ? "full"
                            : "standard"},
          {"scene", o.run.scene.path},
          {"sonar", o.run.head.sonar},
          {"pose", o.pose},
          {"protocol",
           {{"referee", "direct sum in double over all echoes and bins, in `checked_beams` evenly picked beams"},
            {"referee_error", "error of the rows `direct`: against long double, at most 2000 echoes, 4 beams, 64 bins"},
            {"local_error", "worst eighth of the range axis, relative to its own level"},
            {"seconds",
             "median of `repeats` runs after one to warm up; plans (FFTW: ESTIMATE) apart in plan_seconds; with "
             "timed_scatterers < scatterers or timed_beams < beams scaled up in proportion"},
            {"peak_mib", "largest resident set of the process during the runs, input and referee included"}}},
          {"machine", machine_json()},
          {"notes", ordered_json::array()}};
}

void print_table(const std::string& output, const std::vector<AccuracyRow>& rows, const ordered_json& summary) {
  const auto first = std::find_if(rows.begin(), rows.end(), [](const auto& r) { return r.sweep == "work-precision"; });
  if (first != rows.end())
    fmt::print("{} scatterers, {} beams, {} bins:\n{:<24}{:>11}{:>10}{:>12}{:>12}\n", first->scatterers, first->beams,
               first->bins, "method", "tolerance", "error", "local error", "seconds");
  for (const AccuracyRow& r : rows)
    if (r.sweep == "work-precision")
      fmt::print("{:<24}{:>11}{:>10.1e}{:>12.1e}{:>12.3g}\n",
                 r.method + (r.parameter > 0 ? fmt::format(" {:g}", r.parameter) : "") +
                     (r.precision == "single" ? ", single" : ""),
                 r.tolerance > 0 ? fmt::format("{:.0e}", r.tolerance) : "-", r.error, r.local_error, r.seconds);
  for (const auto& p : summary["promise"])
    fmt::print("tolerance {:.0e}: worst of {} images {:.1e}, {:.2f} of what was promised\n",
               p["tolerance"].get<double>(), p["images"].get<int>(), p["worst_error"].get<double>(),
               p["worst_error_over_tolerance"].get<double>());
  for (const auto& c : summary["crossover"])
    if (!c["faster_from"].is_null())
      fmt::print("gridded at {:.0e} is faster than {} from {} scatterers on\n", c["tolerance"].get<double>(),
                 c["against"].get<std::string>(), c["faster_from"].get<std::size_t>());
  for (const auto& e : summary["engines"])
    fmt::print("{:<14} {:>3} images by engines, {} refused; worst error {:.2f} of the tolerance\n",
               e["engine"].get<std::string>(), e["rows"].get<int>(), e["refused"].get<int>(),
               e["worst_error_over_tolerance"].get<double>());
  if (const auto& plan = summary["plan"]; !plan.is_null())
    fmt::print("the plan's engine takes at most {:.2f} times as long as {} where both hold ({}, {:.0e})\n",
               plan["slower"].get<double>(), plan["fastest"].get<std::string>(), plan["task"].get<std::string>(),
               plan["tolerance"].get<double>());
  fmt::print("{}: {} measurements in sweep.csv\n", output, rows.size());
}

void accuracy(const AccuracyOptions& o) {
  if (o.repeats < 1 || o.repeats > 1000)
    fail(ErrorKind::argument, "--repeats = ", o.repeats, ", must be within 1 and 1000");
  const SweepOptions sweep = sweep_options(o);
  Progress preparing(o.common, 1);
  const OutputOptions& output = o.run.output;
  RunDirectory directory(output.folder, output.force, {o.run.scene.path, o.run.head.sonar});
  const std::vector<AccuracyStep> steps = steps_of(o, sweep, preparing);
  Progress progress(o.common, static_cast<int>(steps.size()) + 2);
  ordered_json manifest = manifest_of(o);
  const std::vector<AccuracyRow> rows = run_steps(steps, o, progress);

  std::vector<SamplingErrorRow> sampling;
  if (o.run.scene.path.empty() && o.methods.empty()) {
    progress.step("sampling error");
    sampling = measure_sampling_error({.most_rays = o.quick  ? 64
                                                    : o.full ? 16384
                                                             : 4096,
                                       .trials = o.quick ? 1 : 4,
                                       .seed = o.common.seed,
                                       .threads = o.common.threads});
  }

  progress.step("writing " + output.folder);
  write_file(directory.file("sweep.csv"), sweep_csv(rows));
  if (!sampling.empty()) write_file(directory.file("sampling.csv"), sampling_csv(sampling));
  const auto draw = [&] { manifest["pictures"] = draw_accuracy(rows, sampling, directory); };
  if (!output.no_picture) draw_if_possible("no pictures", draw, manifest, progress);
  manifest["summary"] = accuracy_summary(rows);
  manifest["peak_memory_mib"] = peak_memory_mib();
  write_manifest(directory, manifest);
  directory.commit();
  print_result(o.common, manifest, [&] {
    if (!o.common.quiet) print_table(output.folder, rows, manifest["summary"]);
  });
}

}  // namespace

Verb accuracy_verb() {
  return make_verb<AccuracyOptions>(
      "accuracy", "error against run time of all methods, measured on this machine",
      {"insonify accuracy -o accuracy",
       "insonify accuracy --scene harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 -o mine"},
      add_options, accuracy);
}

}  // namespace insonify::tool
