// SPDX-License-Identifier: BSD-3-Clause
#include "run/asked_simulation.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "beamforming/engine.hpp"
#include "core/error.hpp"
#include "run/parse_values.hpp"
#include "run/run_settings.hpp"
#include "store/toml_tree.hpp"

namespace insonify {
namespace {

constexpr int drawn_paths = 64;  // of each kind; more would hide one another

/// The member of SimulationOptions without its group: "detail_width" of "sampling.detail_width".
std::string name_of_member(const OptionProblem& problem) {
  return problem.member.substr(problem.member.rfind('.') + 1);
}

/// "NAME = VALUE, must be RULE". A flag that must be false is to be left out; of a list of words, its word is.
std::string refusal(const std::string& name, const RunSetting& setting, const OptionProblem& problem) {
  const bool word = std::holds_alternative<std::vector<std::string>*>(setting.value);
  if (const std::string no = "false"; problem.value == "true" && problem.rule.starts_with(no))
    return fmt::format("{}{}: must be left out{}", name, word ? " " + name_of_member(problem) : "",
                       problem.rule.substr(no.size()));
  return fmt::format("{} = {}, must be {}", name, problem.value, problem.rule);
}

/// The row of the setting by which a problem came about; none for a member that no setting reaches.
const RunSetting* setting_of(const std::vector<RunSetting>& settings, const OptionProblem& problem) {
  const std::string member = name_of_member(problem);
  const auto at = std::find_if(settings.begin(), settings.end(), [&](const RunSetting& setting) {
    return member == (*setting.member ? setting.member : setting.key);
  });
  return at == settings.end() ? nullptr : &*at;
}

}  // namespace

SimulationOptions asked_simulation(const CommonOptions& common, const PingOptions& o) {
  SimulationOptions s;
  s.seed = common.seed;
  s.threads = common.threads;
  s.sampling.kind = *find_named(sampling_words, o.sampling);
  s.sampling.scatterers_per_cell = o.scatterers_per_cell;
  s.sampling.detail_width = o.detail_width;
  s.sampling.detail_spacing = o.detail_spacing;
  s.sampling.rays_per_beam = o.rays_per_beam;
  s.amplitude = *find_named(amplitude_words, o.amplitude);
  s.synthesis = asked_synthesis(o.run);
  s.accuracy_db = o.accuracy_db;
  s.effects.noise = o.noise;
  if (o.multipath) s.effects.multipath = Choice::always;
  s.effects.double_echoes = o.double_echoes;
  s.outputs.layers = o.layers;
  s.outputs.labels = keeps(o, "labels");
  s.outputs.display_bins = s.outputs.labels && o.display == 0 ? usual_display_bins : o.display;
  s.outputs.looks_range = o.looks_range;
  s.outputs.looks_pings = o.looks_pings;
  s.outputs.split_phase = o.split;
  s.outputs.elements = keeps(o, "elements");
  s.outputs.scatterers = keeps(o, "insonification");
  s.outputs.mask = keeps(o, "mask");
  s.outputs.contributors = keeps(o, "contributors") ? o.contributors : 0;
  s.outputs.paths = keeps(o, "paths") ? drawn_paths : 0;
  if (o.absorption_order >= 0) s.effects.absorption_order = o.absorption_order;
  s.detection.threshold_db = o.threshold_db;
  s.detection.false_alarm_rate = o.false_alarm_rate;
  if (!o.all_bins_above.empty()) {
    s.detection.all_bins = true;
    s.detection.above_db = parse_number("--all-bins-above", o.all_bins_above);
  }
  return s;
}

void record_detail(Choice asked, Choice decided, PingOptions& options) {
  if (asked != decided) (decided == Choice::always ? options.with : options.without).push_back("detail");
}

SynthesisSettings asked_synthesis(const RunOptions& o) {
  const SynthesisSettings planned;
  if (o.method == planned_word) return {planned.method, o.tolerance};
  const Engine& engine = *std::ranges::find(engines(), o.method, &Engine::word);
  return {engine.method, o.tolerance, engine.replaceable ? Choice::never : Choice::as_needed};
}

bool keeps(const PingOptions& options, const std::string& what) {
  return std::find(options.keep.begin(), options.keep.end(), what) != options.keep.end();
}

void require_valid_settings(const PingOptions& options, const SimulationOptions& simulation, NamedBy by) {
  const auto problem = problem_of(simulation);
  if (!problem) return;
  PingOptions copy = options;
  const std::vector<RunSetting> settings = all_settings(copy);
  if (const RunSetting* setting = setting_of(settings, *problem))
    fail(ErrorKind::argument, refusal(by == NamedBy::option ? setting->option : setting->key, *setting, *problem));
  require_valid(simulation, "PingSimulator");
}

void require_valid_file(const std::string& path, const PingOptions& options) {
  const auto problem = problem_of(asked_simulation({}, options));
  if (!problem) return;
  PingOptions copy = options;
  const std::vector<RunSetting> settings = all_settings(copy);
  const RunSetting* setting = setting_of(settings, *problem);
  if (!setting) return;
  const TomlValue document = load_toml(path);
  // A mission has in [ping] what a run.toml has at its top level.
  for (const std::string section : {"ping", ""}) {
    const TomlValue* table = section.empty() ? &document : document.find(section);
    if (const TomlValue* key = table ? table->find(setting->key) : nullptr)
      fail_in_file(path, key->line, refusal((section.empty() ? "" : section + ".") + setting->key, *setting, *problem));
  }
}

}  // namespace insonify
