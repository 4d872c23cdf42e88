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

/// The settings of a run whose simulation has a problem, and the problem.
class JudgedSettings {
 public:
  JudgedSettings(const Run& run, const SimulationOptions& simulation) : run_(run) {
    run_.simulation = simulation;
    problem_ = problem_of(run_.simulation);
    settings_ = all_settings(run_);
  }
  JudgedSettings(const JudgedSettings&) = delete;
  JudgedSettings& operator=(const JudgedSettings&) = delete;

  /// Returns the row by which the problem came about; null without a problem, and for a member that no row reaches.
  const RunSetting* setting() const {
    const auto at = std::ranges::find_if(settings_, [&](const RunSetting& s) { return problem_ && reaches(s); });
    return at == settings_.end() ? nullptr : &*at;
  }
  /// Returns "NAME = VALUE, must be RULE". A flag that must be false is to be left out; of a list of words, its word is.
  std::string refusal(const std::string& name) const {
    const std::string word = kept_word(), no = "false";
    if (problem_->value == "true" && problem_->rule.starts_with(no))
      return fmt::format("{}{}{}: must be left out{}", name, word.empty() ? "" : " ", word,
                         problem_->rule.substr(no.size()));
    return fmt::format("{} = {}, must be {}", name, problem_->value, problem_->rule);
  }

 private:
  /// The word of `keep` that asks for the member with the problem; empty: none.
  std::string kept_word() const {
    for (const auto& [word, flag] : kept_outputs)
      if (problem_->at == &(run_.simulation.outputs.*flag)) return std::string(word);
    return {};
  }
  bool reaches(const RunSetting& setting) const {
    if (std::get_if<std::vector<std::string>*>(&setting.value) && setting.key == std::string_view("keep"))
      return !kept_word().empty();
    return std::visit(
        [&]<typename Value>(const Value& value) {
          if constexpr (std::is_pointer_v<Value>) return static_cast<const void*>(value) == problem_->at;
          return false;
        },
        setting.value);
  }

  Run run_;
  std::optional<OptionProblem> problem_;
  std::vector<RunSetting> settings_;
};

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
  const JudgedSettings judged(run, simulation);
  if (const RunSetting* setting = judged.setting())
    fail(ErrorKind::argument, judged.refusal(by == NamedBy::option ? setting->option : setting->key));
  require_valid(simulation, "PingSimulator");
}

void require_valid_file(const std::string& path, const Run& run) {
  const JudgedSettings judged(run, requested_simulation(run));
  const RunSetting* setting = judged.setting();
  if (!setting) return;
  const TomlValue document = load_toml(path);
  // A mission has in [ping] what a run.toml has at its top level.
  for (const std::string section : {"ping", ""}) {
    const TomlValue* table = section.empty() ? &document : document.find(section);
    if (const TomlValue* key = table ? table->find(setting->key) : nullptr)
      fail_in_file(path, key->line, judged.refusal((section.empty() ? "" : section + ".") + setting->key));
  }
}

}  // namespace insonify
