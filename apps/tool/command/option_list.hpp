// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run/option_rules.hpp"

namespace CLI {
class App;
}

namespace insonify::tool {

/// The text on an option for --help, the man page and the completion of a shell.
struct OptionText {
  std::vector<std::string> names;  ///< "-o", "--output"; of a positional argument "SCENE"
  std::string value;               ///< "INT", "WORD"; empty for a flag
  std::string help;                ///< with unit, range and default
  std::string group;               ///< title under which it is listed; empty: nowhere
  std::vector<std::string> words;  ///< allowed values; empty: any
  bool required = false;
  std::vector<std::string> extensions{};  ///< endings of the files that a positional argument takes; empty: any

  bool positional() const { return names.front().front() != '-'; }
};

/// The text on the program or on a verb.
struct CommandText {
  std::string name, purpose, footer;
  std::vector<OptionText> options;
};

/// Breaks text into lines of at most `width` characters, the first after `used` characters, all others after `indent`
/// blanks. Line breaks of the text are kept.
std::string wrapped(const std::string& text, std::size_t width, std::size_t indent, std::size_t used);

/// All exit codes with their meanings, "0 ok, 1 ...".
std::string exit_codes_text();

/// Page of section 1 of a verb, insonify-ping(1), or of the program itself if `verb` is the program's text, in groff's
/// man macros.
std::string man_page(const CommandText& program, const std::deque<CommandText>& verbs, const CommandText& verb);

/// Script that completes verbs, options and their words in a shell: "bash", "zsh" or "fish". Anything else in a command
/// line is completed as a file, a scene as one of the formats that are read.
std::string completion_script(const std::string& shell, const CommandText& program,
                              const std::deque<CommandText>& verbs);

/// Options of every verb.
struct CommonOptions {
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  int threads = 0;  ///< 0: all cores
  std::uint64_t seed = 1;
};

/// The options of a program or of one of its verbs. Values are written by CommandLine::parse, in the order in which the
/// options were added; an option that is not given leaves its value as it is. Names with a dash are options
/// ("-o,--output"), others are positional.
class OptionList {
 public:
  OptionList(CLI::App* app, CommandText* text) : app_(app), text_(text) {}
  void add(const std::string& name, const OptionValue& value, const std::string& help, const OptionRules& rules = {});
  /// Lets shells complete a positional argument with files of these extensions, separated by blanks.
  void complete_with(const std::string& name, const std::string& extensions);
  /// Makes a required option optional.
  void release(const std::string& name);

 private:
  CLI::App* app_;
  CommandText* text_;
};

/// The command line of a program, with or without verbs. Only option_list.cpp includes CLI11.
class CommandLine {
 public:
  CommandLine(const std::string& name, const std::string& purpose, const std::string& footer = "");
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Options of the program itself.
  OptionList options();
  /// Options of a verb; once there is one, a command line must name a verb.
  OptionList add_verb(const std::string& name, const std::string& purpose, const std::string& footer);

  /// Parses. Returns an exit code if nothing is left to do: 0 after --help and --version, which go to stdout, 2 after
  /// an error of usage, which goes to stderr. Throws what the functions of options throw.
  std::optional<int> parse(int argc, char** argv);
  /// The verb that was named.
  std::string verb() const;
  /// Return the texts of --help on the program and on its verbs, these in the order in which they were added.
  const CommandText& text() const { return text_; }
  const std::deque<CommandText>& verb_texts() const { return verb_texts_; }

 private:
  /// Describes what is wrong with arguments that the parsed command line does not take.
  std::string extras_message() const;

  std::unique_ptr<CLI::App> app_;
  CommandText text_;
  std::deque<CommandText> verb_texts_;  // OptionLists point to its entries
};

}  // namespace insonify::tool
