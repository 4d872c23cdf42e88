// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "beamforming/engine.hpp"
#include "run/option_rules.hpp"
#include "simulate/simulation_options.hpp"

// Private to run: members of options in the form that the command line and files have.
namespace insonify {

/// The word for the plan's choice among engines, whose words are those of `engines`.
inline constexpr const char* planned_word = "planned";

/// The word of the method that synthesis is asked for: that of an engine, unless the plan may replace it.
inline Shown<std::string> method_word(SynthesisSettings& s) {
  const auto get = [&s] {
    const Engine& engine = engine_of(s.method);
    const bool planned = engine.replaceable && s.true_delays == Choice::as_needed;
    return std::optional<std::string>(planned ? planned_word : engine.word);
  };
  const auto set = [&s](const std::string& word) {
    s.method = SynthesisSettings{}.method, s.true_delays = Choice::as_needed;
    if (word == planned_word) return;
    const Engine& engine = *std::ranges::find(engines(), word, &Engine::word);
    s.method = engine.method, s.true_delays = engine.replaceable ? Choice::never : Choice::as_needed;
  };
  return {{get, set}};
}

/// An order of absorption, where -1 stands for none.
inline Shown<int> order_of(std::optional<int>& order) {
  return {{[&order] { return std::optional(order.value_or(-1)); },
           [&order](int given) { order = given < 0 ? std::nullopt : std::optional(given); }}};
}

/// An effect that is asked for, or left to the plan.
inline Shown<bool> is_requested(Choice& choice) {
  return {{[&choice] { return std::optional(choice == Choice::always); },
           [&choice](bool requested) { choice = requested ? Choice::always : Choice::as_needed; }}};
}

/// The level above which all bins are returns.
inline NumberList all_bins_above(DetectionOptions& d) {
  const auto get = [&d] { return d.all_bins ? std::optional(std::vector{d.above_db}) : std::nullopt; };
  const auto set = [&d](const std::vector<double>& level) {
    d.all_bins = !level.empty();
    d.above_db = d.all_bins ? level.front() : DetectionOptions{}.above_db;
  };
  return {{get, set}, 1, "a level in dB re 1 uPa"};
}

/// Numbers of a list of a known length that may be absent.
template <typename List>
NumberList numbers_in(std::optional<List>& list, const char* meaning) {
  const auto get = [&list] {
    return list ? std::optional(std::vector<double>(list->begin(), list->end())) : std::nullopt;
  };
  const auto set = [&list](const std::vector<double>& numbers) {
    list.reset();
    if (!numbers.empty()) std::ranges::copy(numbers, list.emplace().begin());
  };
  return {{get, set}, static_cast<std::size_t>(List().size()), meaning};
}

/// A number that may be absent.
inline NumberList number_in(std::optional<double>& number, const char* meaning) {
  const auto get = [&number] { return number ? std::optional(std::vector{*number}) : std::nullopt; };
  const auto set = [&number](const std::vector<double>& given) {
    number = given.empty() ? std::nullopt : std::optional(given.front());
  };
  return {{get, set}, 1, meaning};
}

}  // namespace insonify
