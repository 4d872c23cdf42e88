// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <deque>
#include <string>
#include <vector>

namespace insonify::tool {

/// The text on an option for --help, the man page and the completion of a shell.
struct OptionText {
  std::vector<std::string> names;  ///< "-o", "--output"; of a positional argument "SCENE"
  std::string value;               ///< "INT", "WORD"; empty for a flag
  std::string help;                ///< with unit, range and default
  std::string group;               ///< title under which it is listed; empty: nowhere
  std::vector<std::string> words;  ///< allowed values; empty: any
  bool required = false;

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
/// line is completed as a file.
std::string completion_script(const std::string& shell, const CommandText& program,
                              const std::deque<CommandText>& verbs);

}  // namespace insonify::tool
