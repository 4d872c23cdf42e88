// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/text.hpp"
#include "tool/command/option_list.hpp"
#include "tool/command/program.hpp"

namespace insonify::tool {
namespace {

// groff takes backslashes and a dot or apostrophe at the start of a line for commands.
std::string groff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (out.empty() || out.back() == '\n')
      if (c == '.' || c == '\'') out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

std::string option_page(const OptionText& option) {
  std::string names;
  for (const std::string& name : option.names)
    names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", groff(name));
  if (!option.value.empty() && !option.positional()) names += fmt::format(" \\fI{}\\fR", groff(option.value));
  std::string help = groff(option.help);
  if (!option.words.empty() && option.help.find(option.words.front()) == std::string::npos)
    help += fmt::format(" ({})", groff(fmt::format("{}", fmt::join(option.words, ", "))));
  return fmt::format(".TP\n{}\n{}{}\n", names, help, option.required ? "; required" : "");
}

// Title of a section for options of one group; CLI's own group is called Options.
std::string options_page(const CommandText& verb) {
  std::vector<std::string> groups;
  for (const OptionText& option : verb.options)
    if (!option.group.empty() && std::ranges::find(groups, option.group) == groups.end())
      groups.push_back(option.group);
  std::string page;
  for (const std::string& group : groups) {
    page += fmt::format(".SH {}\n", groff(group == "Options" ? "OPTIONS" : group));
    for (const OptionText& option : verb.options)
      if (option.group == group) page += option_page(option);
  }
  return page;
}

std::string usage(const CommandText& program, const CommandText& verb) {
  std::string line = &program == &verb ? fmt::format(".B {}\n.I VERB\n", program.name)
                                       : fmt::format(".B {} {}\n", program.name, verb.name);
  for (const OptionText& option : verb.options) {
    if (option.positional())
      line += (option.required ? ".I " + option.names.front() : ".RI [ " + option.names.front() + " ]") + "\n";
    else if (option.required)
      line += fmt::format(".B {}\n.I {}\n", groff(option.names.back()), groff(option.value));
  }
  return line + ".RI [ OPTIONS ]\n";
}

std::string all_names(const CommandText& verb) {
  std::string names;
  for (const OptionText& option : verb.options)
    if (!option.positional()) names += fmt::format("{} ", fmt::join(option.names, " "));
  return names + "-h --help";
}

std::string verb_names(const std::deque<CommandText>& verbs) {
  std::string names = "help";
  for (const CommandText& verb : verbs) names += " " + verb.name;
  return names;
}

// Words of the option that stands before the cursor: one line of a case for each option that has any.
std::string bash_script(const CommandText& program, const std::deque<CommandText>& verbs) {
  std::string script = fmt::format(
      "_{0}() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}\n"
      "  local words=\"\" options=\"\" endings=\"\" ending\n"
      "  if ((COMP_CWORD == 1)) || {{ ((COMP_CWORD == 2)) && [[ $before == help ]]; }}; then\n"
      "    mapfile -t COMPREPLY < <(compgen -W \"{1} --help --version\" -- \"$word\")\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}} in\n",
      program.name, verb_names(verbs));
  for (const CommandText& verb : verbs) {
    script += fmt::format("    {})\n      options=\"{}\"\n", verb.name, all_names(verb));
    std::string cases;
    for (const OptionText& option : verb.options) {
      if (!option.extensions.empty())
        script += fmt::format("      endings=\"{}\"\n", fmt::join(option.extensions, " "));
      if (option.words.empty()) continue;
      if (option.positional())
        script += fmt::format("      words=\"{}\"\n", fmt::join(option.words, " "));
      else
        cases += fmt::format("        {}) words=\"{}\" options=\"\" ;;\n", fmt::join(option.names, " | "),
                             fmt::join(option.words, " "));
    }
    if (!cases.empty()) script += "      case $before in\n" + cases + "      esac\n";
    script += "      ;;\n";
  }
  return script + fmt::format(
                      "  esac\n"
                      "  [[ $word == -* ]] && words=$options\n"
                      "  if [[ -n $words ]]; then\n"
                      "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
                      "  elif [[ -n $endings && $before != -* ]]; then\n"
                      "    mapfile -t COMPREPLY < <(compgen -d -- \"$word\"\n"
                      "      for ending in $endings; do compgen -G \"$word*$ending\"; done)\n"
                      "    compopt -o filenames 2>/dev/null\n"
                      "  fi\n"
                      "}}\n"
                      "complete -o default -F _{0} {0}\n",
                      program.name);
}

// Text within single quotes of zsh or fish, where zsh gives brackets and colons a meaning.
std::string quoted(const std::string& text, const char* special) {
  std::string out;
  for (const char c : text) {
    if (c == '\'')
      out += "'\\''";
    else if (std::string(special).find(c) != std::string::npos)
      out += std::string("\\") + c;
    else
      out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string zsh_script(const CommandText& program, const std::deque<CommandText>& verbs) {
  std::string script = fmt::format("#compdef {0}\n\n_{0}() {{\n  local -a verbs=(\n", program.name);
  for (const CommandText& verb : verbs) script += fmt::format("    '{}:{}'\n", verb.name, quoted(verb.purpose, ":"));
  script +=
      "  )\n"
      "  if ((CURRENT == 2)); then\n    _describe verb verbs\n    return\n  fi\n"
      "  local verb=$words[2]\n  shift words\n  ((CURRENT--))\n"
      "  case $verb in\n";
  for (const CommandText& verb : verbs) {
    script += fmt::format("    {})\n      _arguments \\\n", verb.name);
    for (const OptionText& option : verb.options) {
      std::string values = option.words.empty() ? "_files" : fmt::format("({})", fmt::join(option.words, " "));
      if (!option.extensions.empty()) values += fmt::format(" -g \"*({})\"", fmt::join(option.extensions, "|"));
      if (option.positional()) {
        script += fmt::format("        '::{}:{}' \\\n", option.names.front(), values);
        continue;
      }
      for (const std::string& name : option.names)
        script += fmt::format("        '*{}[{}]{}' \\\n", name, quoted(option.help, "[]:"),
                              option.value.empty() ? "" : fmt::format(":{}:{}", quoted(option.value, "[]:"), values));
    }
    script += "        '--help[print the help]'\n      ;;\n";
  }
  return script + fmt::format("  esac\n}}\n\ncompdef _{0} {0}\n", program.name);
}

std::string fish_script(const CommandText& program, const std::deque<CommandText>& verbs) {
  std::string script;
  for (const CommandText& verb : verbs) {
    script += fmt::format("complete -c {} -n __fish_use_subcommand -f -a {} -d '{}'\n", program.name, verb.name,
                          quoted(verb.purpose, "\\"));
    for (const OptionText& option : verb.options) {
      std::string line = fmt::format("complete -c {} -n '__fish_seen_subcommand_from {}'", program.name, verb.name);
      if (!option.positional())
        for (const std::string& name : option.names)
          line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      if (!option.words.empty()) line += fmt::format(" -x -a '{}'", fmt::join(option.words, " "));
      if (option.words.empty() && !option.value.empty() && !option.positional()) line += " -r";
      if (!option.extensions.empty())
        line += fmt::format(" -k -a '(__fish_complete_suffix {})'", fmt::join(option.extensions, " "));
      else if (option.positional() && option.words.empty())
        continue;
      script += fmt::format("{} -d '{}'\n", line, quoted(option.help, "\\"));
    }
  }
  return script;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t width, std::size_t indent, std::size_t used) {
  std::istringstream lines(text);
  std::string out, line;
  std::size_t column = used;
  const auto new_line = [&] {
    out += "\n" + std::string(indent, ' ');
    column = indent;
  };
  for (bool first = true; std::getline(lines, line); first = false) {
    if (!first) new_line();
    std::istringstream words(line);
    for (std::string word, space; words >> word; space = " ") {
      if (column > indent && column + space.size() + word.size() > width) {
        new_line();
        space.clear();
      }
      out += space + word;
      column += space.size() + word.size();
    }
  }
  return out;
}

std::string exit_codes_text() {
  return joined(exit_code_texts, ", ",
                [](const ExitCodeText& row) { return fmt::format("{} {}", int{row.code}, row.meaning); });
}

std::string man_page(const CommandText& program, const std::deque<CommandText>& verbs, const CommandText& verb) {
  const bool whole = &verb == &program;
  const std::string name = whole ? program.name : program.name + "-" + verb.name;
  std::string page =
      fmt::format(".TH {} 1 \"\" \"{} {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}", groff(name),
                  program.name, INSONIFY_VERSION, groff(name), groff(verb.purpose), usage(program, verb));
  if (whole) {
    page += ".SH VERBS\n";
    for (const CommandText& v : verbs) page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", v.name, groff(v.purpose));
  }
  page += options_page(verb);
  if (!verb.footer.empty()) {
    std::string examples = verb.footer;
    if (examples.starts_with("Examples:\n")) examples.erase(0, examples.find('\n') + 1);
    page += fmt::format(".SH EXAMPLES\n.nf\n{}\n.fi\n", groff(examples));
  }
  page += fmt::format(".SH EXIT STATUS\n{}.\n.SH SEE ALSO\n", exit_codes_text());
  if (!whole) return page + fmt::format(".BR {} (1)\n", program.name);
  for (const CommandText& v : verbs)
    page += fmt::format(".BR {}\\-{} (1){}\n", program.name, groff(v.name), &v == &verbs.back() ? "" : ",");
  return page;
}

std::string completion_script(const std::string& shell, const CommandText& program,
                              const std::deque<CommandText>& verbs) {
  if (shell == "bash") return bash_script(program, verbs);
  return shell == "zsh" ? zsh_script(program, verbs) : fish_script(program, verbs);
}

}  // namespace insonify::tool
