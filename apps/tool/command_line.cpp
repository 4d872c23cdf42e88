#include "tool/command_line.hpp"

#include <map>

#include "tool/program.hpp"
#include "tool/progress.hpp"
#include "tool/verb.hpp"

namespace insonify::tool {

// CMake writes the table, VERB(info) VERB(prepare) ..., from the list of verbs.
#define VERB(name) Verb name##_verb();
#include "verb_table.inc"
#undef VERB

namespace {

/// All verbs in the order of --help.
std::vector<Verb> all_verbs() {
  return {
#define VERB(name) name##_verb(),
#include "verb_table.inc"
#undef VERB
  };
}

std::string footer_of(const Verb& verb) {
  std::string footer = verb.examples.empty() ? "" : "Examples:";
  for (const std::string& example : verb.examples) footer += "\n  " + example;
  return footer;
}

/// Parses the command line and runs the verb that it names. Returns the exit code: 0, or 2 for an error of usage, which
/// is on stderr.
int run_command_line(int argc, char** argv) {
  catch_interrupts();
  CommandLine line("insonify", "insonify: what a sonar hears of a captured scene");
  std::map<std::string, std::function<void()>> run;
  for (const Verb& verb : all_verbs()) {
    if (verb.run_with && argc > 1 && argv[1] == verb.name) {
      verb.run_with({argv + 2, argv + argc});
      return 0;
    }
    const OptionList options = line.add_verb(verb.name, verb.purpose, footer_of(verb));
    if (verb.add_options) run[verb.name] = verb.add_options(options);
  }
  if (const auto exit_code = line.parse(argc, argv)) return *exit_code;
  run.at(line.verb())();
  return 0;
}

}  // namespace

int run_tool(int argc, char** argv) {
  return run_program([&] { return run_command_line(argc, argv); },
                     "use a smaller scene, fewer scatterers per cell or a shorter range");
}

}  // namespace insonify::tool
