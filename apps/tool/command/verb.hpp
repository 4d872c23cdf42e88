// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tool/command/option_list.hpp"

namespace insonify::tool {

/// A verb of the tool. Results go to stdout, everything else to stderr; errors are thrown as insonify::Error.
///
/// A new verb is one file, verb_<name>.cpp, that defines `Verb <name>_verb()`, and its name in the list of
/// apps/CMakeLists.txt.
struct Verb {
  std::string name;
  std::string purpose;
  std::vector<std::string> examples;  ///< command lines
  /// Adds the options and returns what to do once they are parsed.
  std::function<std::function<void()>(OptionList)> add_options;
  /// Set for a verb whose arguments another program parses: it gets them as they are.
  std::function<void(const std::vector<std::string>& arguments)> run_with = {};
};

/// A verb with the options of type `Options`: `add` adds them, `run` does the work.
template <typename Options>
Verb make_verb(const char* name, const char* purpose, std::vector<std::string> examples,
               void (*add)(OptionList list, Options& options), void (*run)(const Options& options)) {
  const auto add_options = [add, run](OptionList list) -> std::function<void()> {
    const auto options = std::make_shared<Options>();
    add(list, *options);
    return [options, run] { run(*options); };
  };
  return {name, purpose, std::move(examples), add_options};
}

}  // namespace insonify::tool
