// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/engine.hpp"
#include "beamforming/head_patterns.hpp"
#include "beamforming/synthesize.hpp"
#include "core/stop_watch.hpp"
#include "core/units.hpp"
#include "run/parse_values.hpp"
#include "run/run_checks.hpp"
#include "run/run_settings.hpp"
#include "run_scenes/run_files.hpp"
#include "simulate/plan_ping.hpp"
#include "store/csv_tables.hpp"
#include "store/toml_tree.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/shared_options.hpp"
#include "tool/command/verb.hpp"
#include "tool/run/vtk_pictures.hpp"

namespace insonify::tool {
namespace {

struct SynthesizeOptions {
  CommonOptions common;
  RunOptions run;
  std::string scatterers;
  double accuracy_db = library_options.accuracy_db;
  int absorption_order = -1;  ///< order of absorption about fc, 0 to 2; -1: as needed
};

/// The settings that run.toml records at its top level.
std::vector<RunSetting> settings(SynthesizeOptions& o) {
  return {accuracy_setting(o.accuracy_db, ""), absorption_setting(o.absorption_order, "")};
}

void add_options(OptionList list, SynthesizeOptions& o) {
  list.add("SCATTERERS", &o.scatterers, "CSV: range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im",
           {.required = true});
  add_sonar(list, o.common, o.run);
  add_settings(list, settings(o));
  add_output(list, o.run);
  add_common(list, o.common);
  add_work(list, o.common);
}

/// Returns the text of run.toml beside sonar and environment.
std::string settings_of(SynthesizeOptions o) {
  return settings_as_toml({seed_setting(o.common)}) + settings_as_toml(synthesis_settings(o.run)) +
         settings_as_toml(settings(o)) + fmt::format("scatterers = {}\n", as_toml(o.scatterers));
}

/// Returns the options that the user asks for; the plan decides the rest.
SimulationOptions asked_of(const SynthesizeOptions& o) {
  SimulationOptions options;
  options.threads = o.common.threads;
  options.accuracy_db = o.accuracy_db;
  options.synthesis = asked_synthesis(o.run);
  if (o.absorption_order >= 0) options.effects.absorption_order = o.absorption_order;
  return options;
}

void synthesize(const SynthesizeOptions& o) {
  const CommonOptions& common = o.common;
  Progress progress(common, 3);
  const HeadSetup setup = set_up_head(common, o.run);
  RunDirectory directory(o.run.output, o.run.force, {o.scatterers, o.run.sonar, o.run.environment, o.run.profile});

  progress.step("reading " + o.scatterers);
  const ScattererTable table = load_scatterer_table(o.scatterers);

  // Use the elevation pattern and beams of a ping; amplitudes and cross-sections are those of the caller.
  progress.step("synthesizing");
  StopWatch watch;
  const SonarHead& head = setup.head;
  const EchoOptions echo_options =
      with_patterns({.amplitude = SurfaceAmplitude::coherent, .threads = common.threads}, head);
  const Echoes echoes = target_echoes(table.scatterers, table.sigma, table.xi, head.pulse, setup.medium, echo_options);
  const SimulationOptions settled = decided_synthesis(table.scatterers, echoes, head, setup.environment, asked_of(o));
  const auto& [method, tolerance, true_delays, phases] = settled.synthesis;
  const Medium medium = medium_of(setup.environment, head.pulse.centre_frequency, *settled.effects.absorption_order);
  const ComplexGrid pressure = synthesize(echoes, head, medium, method, {tolerance, common.threads});
  Ping ping{0, 0, Pose::Identity(), head.fan, head.gate, stored_pressure(pressure, "synthesize")};
  ping.expected_level = gives_power(method);
  note_water(medium, ping);
  const double seconds = watch.lap();

  progress.step("writing " + o.run.output);
  nlohmann::ordered_json manifest = {
      {"schema", 1},
      {"insonify_version", INSONIFY_VERSION},
      {"seed", common.seed},
      {"scatterers", {{"path", o.scatterers}, {"count", table.scatterers.size()}}},
      {"synthesis", {{"method", engine_of(method).word}, {"absorption_order", *settled.effects.absorption_order}}},
      {"notes", nlohmann::ordered_json::array()}};
  for (const std::string& note : setup.notes) {
    progress.note(note);
    manifest["notes"].push_back(note);
  }
  manifest["peak_level_db"] = std::max(silence_db, pressure_level_db(pressure.abs().maxCoeff()));
  write_run(directory, common, o.run, setup, {std::move(ping)}, settings_of(o), manifest, VtkPictures(), progress);
  manifest["seconds"] = {{"synthesis", seconds}};
  write_manifest(directory, manifest);
  directory.commit();
  print_summary(common, manifest,
                fmt::format("{}: {} scatterers, peak {:.4f} dB re 1 uPa", o.run.output, table.scatterers.size(),
                            manifest["peak_level_db"].get<double>()));
}

}  // namespace

Verb synthesize_verb() {
  return make_verb<SynthesizeOptions>("synthesize", "beams from the scatterers of another program (CSV)",
                                      {"insonify synthesize rays.csv --sonar p900-45 --range 1:20 -o out",
                                       "insonify synthesize rays.csv --sonar p900-45 --method direct -o referee"},
                                      add_options, synthesize);
}

}  // namespace insonify::tool
