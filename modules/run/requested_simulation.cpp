// SPDX-License-Identifier: BSD-3-Clause
#include "run/requested_simulation.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "run/run_settings.hpp"
#include "store/toml_tree.hpp"

namespace insonify {
namespace {

constexpr int drawn_paths = 64;  // of each kind; more would hide one another

/// A row by which a problem of a simulation came about, and what is wrong with its value: " = VALUE, must be RULE".
struct RefusedSetting {
  std::string option, key, text;
};

/// Returns the row of the first problem of `simulation`, made of `run`; absent without one, and for a member that no row
/// reaches. A flag that must be false is to be left out; of a list of words, its word is.
std::optional<RefusedSetting> find_refused(Run run, const SimulationOptions& simulation) {
  run.simulation = simulation;
  const std::optional<OptionProblem> problem = problem_of(run.simulation);
  if (!problem) return {};
  std::string kept;
  for (const auto& [word, flag] : kept_outputs)
    if (problem->at == &(run.simulation.outputs.*flag)) kept = fmt::format(" {}", word);
  const auto is_at = [&]<typename Value>(const Value& value) {
    if constexpr (std::is_pointer_v<Value>) return static_cast<const void*>(value) == problem->at;
    return false;
  };
  for (const RunSetting& setting : all_settings(run)) {
    if (!(setting.key == std::string_view("keep") ? !kept.empty() : std::visit(is_at, setting.value))) continue;
    if (const std::string no = "false"; problem->value == "true" && problem->rule.starts_with(no))
      return {{setting.option, setting.key, kept + ": must be left out" + problem->rule.substr(no.size())}};
    return {{setting.option, setting.key, fmt::format(" = {}, must be {}", problem->value, problem->rule)}};
  }
  return {};
}

}  // namespace

SimulationOptions requested_simulation(const Run& run) {
  SimulationOptions requested = run.simulation;
  OutputSettings& outputs = requested.outputs;
  for (const auto& [word, flag] : kept_outputs) outputs.*flag = keeps(run, std::string(word));
  if (outputs.labels && outputs.display_bins == 0) outputs.display_bins = usual_display_bins;
  outputs.contributors = keeps(run, "contributors") ? run.contributors : 0;
  outputs.paths = keeps(run, "paths") ? drawn_paths : 0;
  return requested;
}

void record_detail(Choice requested, Choice decided, Run& run) {
  if (requested != decided) (decided == Choice::always ? run.with : run.without).push_back("detail");
}

bool keeps(const Run& run, const std::string& what) { return std::ranges::find(run.keep, what) != run.keep.end(); }

void require_valid_settings(const Run& run, const SimulationOptions& simulation, NamedBy by) {
  if (const auto refused = find_refused(run, simulation))
    fail(ErrorKind::argument, by == NamedBy::option ? refused->option : refused->key, refused->text);
  require_valid(simulation, "PingSimulator");
}

void require_valid_file(const std::string& path, const Run& run) {
  const auto refused = find_refused(run, requested_simulation(run));
  if (!refused) return;
  const TomlValue document = load_toml(path);
  // A mission has in [ping] what a run.toml has at its top level.
  for (const std::string section : {"ping", ""}) {
    const TomlValue* table = section.empty() ? &document : document.find(section);
    if (const TomlValue* key = table ? table->find(refused->key) : nullptr)
      fail_in_file(path, key->line, section.empty() ? "" : section + ".", refused->key, refused->text);
  }
}

}  // namespace insonify
