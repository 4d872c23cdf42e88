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
#include "run/run_settings.hpp"
#include "run_scenes/run_folder.hpp"
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
  Run run;  ///< budget, order of absorption and synthesis are all that counts of its simulation
  std::string scatterers;
};

/// The settings that run.toml records at its top level.
std::vector<RunSetting> settings(SynthesizeOptions& o) {
  SimulationOptions& simulation = o.run.simulation;
  return {accuracy_setting(simulation.accuracy_db, ""), absorption_setting(simulation.effects.absorption_order, "")};
}

void add_options(OptionList list, SynthesizeOptions& o) {
  list.add("SCATTERERS", &o.scatterers, "CSV: range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im",
           {.required = true});
  add_sonar(list, o.run);
  add_settings(list, settings(o));
  add_output(list, o.run.output);
  add_common(list, o.common);
  add_work(list, o.run.simulation.threads, o.run.simulation.seed);
}

/// Returns the text of run.toml beside sonar and environment.
std::string settings_of(SynthesizeOptions o) {
  return settings_as_toml({seed_setting(o.run.simulation.seed)}) +
         settings_as_toml(synthesis_settings(o.run.simulation.synthesis)) + settings_as_toml(settings(o)) +
         fmt::format("scatterers = {}\n", as_toml(o.scatterers));
}

void synthesize(const SynthesizeOptions& o) {
  const CommonOptions& common = o.common;
  Progress progress(common, 3);
  const Run& run = o.run;
  PingSetup setup = set_up_head(run.head);
  setup.run = run;
  const VtkPictures pictures;
  RunFolder folder(setup, {o.scatterers, run.head.sonar, run.head.environment, run.head.profile}, pictures, progress);

  progress.step("reading " + o.scatterers);
  const ScattererTable table = load_scatterer_table(o.scatterers);

  // Use the elevation pattern and beams of a ping; amplitudes and cross-sections are those of the caller.
  progress.step("synthesizing");
  StopWatch watch;
  const SonarHead& head = setup.head;
  const EchoOptions echo_options =
      with_patterns({.amplitude = SurfaceAmplitude::coherent, .threads = run.simulation.threads}, head);
  const Echoes echoes = target_echoes(table.scatterers, table.sigma, table.xi, head.pulse, setup.medium, echo_options);
  const SimulationOptions decided =
      decided_synthesis(table.scatterers, echoes, head, setup.environment, run.simulation);
  const auto& [method, tolerance, true_delays, phases] = decided.synthesis;
  const Medium medium = medium_of(setup.environment, head.pulse.centre_frequency, *decided.effects.absorption_order);
  const ComplexGrid pressure = synthesize(echoes, head, medium, method, {tolerance, run.simulation.threads});
  Ping ping{{}, head.fan, head.gate, stored_pressure(pressure, "synthesize")};
  ping.expected_level = gives_power(method);
  note_water(medium, ping);
  const double seconds = watch.lap();

  progress.step("writing " + run.output.folder);
  nlohmann::ordered_json manifest = {
      {"schema", 1},
      {"insonify_version", INSONIFY_VERSION},
      {"seed", run.simulation.seed},
      {"scatterers", {{"path", o.scatterers}, {"count", table.scatterers.size()}}},
      {"synthesis", {{"method", engine_of(method).word}, {"absorption_order", *decided.effects.absorption_order}}},
      {"notes", nlohmann::ordered_json::array()}};
  for (const std::string& note : setup.notes) {
    progress.note(note);
    manifest["notes"].push_back(note);
  }
  manifest["peak_level_db"] = std::max(silence_db, pressure_level_db(pressure.abs().maxCoeff()));
  folder.write_image(std::move(ping), {}, settings_of(o), manifest);
  manifest["seconds"] = {{"synthesis", seconds}};
  folder.finish(manifest);
  folder.commit();
  print_summary(common, manifest,
                fmt::format("{}: {} scatterers, peak {:.4f} dB re 1 uPa", run.output.folder, table.scatterers.size(),
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
