// SPDX-License-Identifier: BSD-3-Clause
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <map>
#include <memory>
#include <string_view>
#include <system_error>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "store/nearest_word.hpp"
#include "tool/command/option_list.hpp"
#include "tool/command/program.hpp"
#include "tool/command/progress.hpp"
#include "tool/command/verb.hpp"

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

/// Arguments go into files that must be UTF-8, so that others can read them.
void require_utf8(const std::vector<char*>& arguments) {
  for (const char* argument : arguments) try {
      static_cast<void>(nlohmann::json(argument).dump());
    } catch (const nlohmann::json::exception&) {
      fail(ErrorKind::argument, "an argument is not UTF-8: ",
           nlohmann::json(argument).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace),
           "; rename the file, or set your terminal to UTF-8");
    }
}

/// Throws Error(argument) with the nearest name if there is no such verb.
const CommandText* find_verb(const CommandLine& line, const std::string& name) {
  std::vector<std::string> names;
  for (const CommandText& verb : line.verb_texts()) {
    if (verb.name == name) return &verb;
    names.push_back(verb.name);
  }
  fail(ErrorKind::argument, "unknown verb '", name, "'", did_you_mean(name, names), "; see insonify --help");
}

/// The first argument must be a verb or an option.
void require_verb(const std::vector<char*>& arguments, const CommandLine& line) {
  if (arguments.size() > 1 && arguments[1][0] != '-') find_verb(line, arguments[1]);
}

std::string footer_of(const Verb& verb) {
  std::string footer = verb.examples.empty() ? "" : "Examples:";
  for (const std::string& example : verb.examples) footer += "\n  " + example;
  return footer;
}

using VerbRuns = std::map<std::string, std::function<void()>>;

/// Adds the verbs that print what other programs say of insonify: completions and man pages, made of the same texts as
/// --help.
void add_text_verbs(CommandLine& line, VerbRuns& run) {
  const auto shell = std::make_shared<std::string>(), page = std::make_shared<std::string>();
  line.add_verb("completion", "the script with which a shell completes command lines",
                "Examples:\n  source <(insonify completion bash)")
      .add("SHELL", shell.get(), "bash, zsh or fish", {.required = true, .words = {"bash", "zsh", "fish"}});
  line.add_verb("man", "the man page of a verb, or of insonify", "Examples:\n  insonify man ping | man -l -")
      .add("VERB", page.get(), "a verb; without one, the page of insonify itself");
  run["completion"] = [&line, shell] {
    std::fputs(completion_script(*shell, line.text(), line.verb_texts()).c_str(), stdout);
  };
  run["man"] = [&line, page] {
    const CommandText* text = page->empty() ? &line.text() : find_verb(line, *page);
    std::fputs(man_page(line.text(), line.verb_texts(), *text).c_str(), stdout);
  };
}

/// `insonify help ping` as `insonify ping --help`.
std::vector<char*> with_help_as_option(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);
  static char option[] = "--help";
  if (argc < 2 || std::string_view(argv[1]) != "help") return arguments;
  arguments.erase(arguments.begin() + 1);
  arguments.insert(arguments.begin() + std::min<std::ptrdiff_t>(argc - 1, 2), option);
  return arguments;
}

/// Parses the command line and runs the verb that it names. Returns the exit code: 0, or 2 for an error of usage, which
/// is on stderr.
int run_command_line(int argc, char** argv) {
  CommandLine line("insonify", "insonify: what a sonar hears of a captured scene",
                   "insonify help VERB lists the options of a verb.");
  VerbRuns run;
  for (const Verb& verb : all_verbs()) {
    if (verb.run_with && argc > 1 && argv[1] == verb.name) {
      verb.run_with({argv + 2, argv + argc});
      return 0;
    }
    const OptionList options = line.add_verb(verb.name, verb.purpose, footer_of(verb));
    if (verb.add_options) run[verb.name] = verb.add_options(options);
  }
  add_text_verbs(line, run);
  std::vector<char*> arguments = with_help_as_option(argc, argv);
  require_utf8(arguments);
  require_verb(arguments, line);
  if (const auto exit_code = line.parse(static_cast<int>(arguments.size()), arguments.data())) return *exit_code;
  end_on_interrupt();
  run.at(line.verb())();
  return 0;
}

/// Exit code where stdout cannot be written: that of SIGPIPE if its reader has gone, as that of `insonify info x | head
/// -1`. Throws Error(file) for any other reason.
int failed_output(int reason) {
  if (reason == EPIPE) return exit_no_reader;
  fail(ErrorKind::file, "the output cannot be written: ", std::generic_category().message(reason ? reason : EIO),
       "; the files of the result are written, only the printed text is lost");
}

/// Runs the verb and writes what is left of stdout.
int run_and_flush(int argc, char** argv) {
  try {
    const int exit_code = run_command_line(argc, argv);
    errno = 0;
    return std::fflush(stdout) == 0 && !std::ferror(stdout) ? exit_code : failed_output(errno);
  } catch (const std::system_error& error) {  // of fmt::print
    if (!std::ferror(stdout)) throw;
    return failed_output(error.code().value());
  } catch (...) {
    wait_for_end();
    throw;
  }
}

}  // namespace

int run_tool(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a reader that has gone is an error of writing
  const char* less = "use a smaller scene, fewer scatterers per cell or a shorter range";
  const auto run = [&] { return run_program([&] { return run_and_flush(argc, argv); }, less); };
  const bool becomes_another = argc > 1 && argv[1] == view_verb().name;  // which guards itself
  return becomes_another ? run() : under_memory_guard(run, less);
}

}  // namespace insonify::tool
