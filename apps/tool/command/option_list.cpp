// SPDX-License-Identifier: BSD-3-Clause
#include "tool/command/option_list.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "core/message.hpp"
#include "run/parse_values.hpp"
#include "run/run_checks.hpp"
#include "store/nearest_word.hpp"
#include "tool/command/program.hpp"

namespace insonify::tool {

namespace {

/// Adds an option whose value goes through a function; its default is what the value is now.
template <typename T>
CLI::Option* add_shown(CLI::App& app, const std::string& name, const Member<T>& value, const std::string& help) {
  if constexpr (std::is_same_v<T, bool>)
    return app.add_flag_function(
        name, [set = value.set](std::int64_t count) { set(count > 0); }, help);
  else
    return app.add_option_function<T>(name, value.set, help)->default_str(fmt::format("{}", value.get().value()));
}

CLI::Option* add_value(CLI::App& app, const std::string& name, const OptionValue& value, const std::string& help) {
  const auto add = [&]<typename Value>(const Value& at) -> CLI::Option* {
    if constexpr (requires { at.value.set; })
      return add_shown(app, name, at.value, help);
    else if constexpr (std::is_same_v<Value, NumberList>)
      return app.add_option_function<std::string>(
          name,
          [name, at](const std::string& text) { at.numbers.set(parse_numbers(name, text, at.count, at.meaning)); },
          help);
    else if constexpr (std::is_same_v<Value, bool*>)
      return app.add_flag(name, *at, help);
    else if constexpr (std::is_same_v<Value, std::optional<std::string>*>)
      return app.add_option(name, *at, help)->expected(0, 1);
    else if constexpr (std::is_pointer_v<Value>)
      return app.add_option(name, *at, help);
    else
      return app.add_option_function<std::string>(name, at, help);
  };
  return std::visit(add, value);
}

/// CLI11 would print the largest number as the end of the range.
std::string positive_check(const std::string& text) {
  double value = 0;
  return to_number(text, value) && value > 0 && std::isfinite(value) ? std::string() : text + " must be above 0";
}

/// CLI11 takes -1 for the largest number without a sign.
std::string sign_check(const std::string& text) {
  return text.starts_with("-") ? text + " must be 0 or more" : std::string();
}

/// The help of an option with its range and default, unless the help itself says what holds by default. An infinite
/// default is no limit.
std::string full_help(CLI::Option& option, const std::string& help, const OptionRules& rules) {
  std::string text = help;
  if (rules.within) text += fmt::format(" ({} to {})", rules.within->first, rules.within->second);
  if (rules.positive) text += " (above 0)";
  const std::string preset = option.capture_default_str()->get_default_str();
  const bool is_none = preset.empty() || preset == "inf" || preset == "[]";
  if (!is_none && help.find("default") == std::string::npos) text += fmt::format("; default {}", preset);
  return text;
}

OptionText text_of(const CLI::Option& option, const OptionRules& rules) {
  OptionText text{{}, "", option.get_description(), option.get_group(), rules.words, rules.required};
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  if (text.names.empty()) text.names.push_back(option.get_single_name());
  if (option.get_items_expected_max() > 0)
    text.value = option.get_option_text().empty() ? option.get_type_name() : option.get_option_text();
  return text;
}

/// Columns of the terminal, or of a file that is read later.
std::size_t help_width() {
  winsize size{};
  if (const char* columns = std::getenv("COLUMNS"); columns && std::atoi(columns) > 0)
    return static_cast<std::size_t>(std::atoi(columns));
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 100;
}

/// --help within the terminal's width.
class WrappedHelp : public CLI::Formatter {
 public:
  WrappedHelp() { column_width(left); }
  std::string make_option_desc(const CLI::Option* option) const override {
    return wrapped(option->get_description(), std::max<std::size_t>(help_width(), 2 * left) - left, 0, 0);
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string text = option->get_option_text();
    if (!text.empty()) return " " + text + (option->get_required() ? " REQUIRED" : "");
    const std::string type = option->get_type_size() == 0 ? "" : " " + option->get_type_name();
    return type + (option->get_required() ? " REQUIRED" : "");
  }
  std::string make_subcommand(const CLI::App* verb) const override {
    std::stringstream out;
    CLI::detail::format_help(
        out, verb->get_name(),
        wrapped(verb->get_description(), std::max<std::size_t>(help_width(), 2 * left) - left, 0, 0), left);
    return out.str();
  }

 private:
  static constexpr std::size_t left = 32;  // columns of the names
};

}  // namespace

void OptionList::add(const std::string& name, const OptionValue& value, const std::string& help,
                     const OptionRules& rules) {
  CLI::Option* option = add_value(*app_, name, value, help);
  option->description(full_help(*option, help, rules))->required(rules.required);
  if (!rules.words.empty()) option->check(CLI::IsMember(rules.words))->option_text("WORD");
  if (rules.within) option->check(CLI::Range(rules.within->first, rules.within->second))->option_text("INT");
  if (rules.positive) option->check(positive_check)->option_text("FLOAT");
  if (std::holds_alternative<std::uint64_t*>(value)) option->check(sign_check)->option_text("UINT");
  if (rules.one_each) option->allow_extra_args(false);
  if (rules.comma_separated) option->delimiter(',');
  if (rules.excludes) option->excludes(app_->get_option(rules.excludes));
  if (rules.group) option->group(rules.group);
  if (rules.shown_as) option->option_text(rules.shown_as);
  text_->options.push_back(text_of(*option, rules));
}

void OptionList::complete_with(const std::string& name, const std::string& extensions) {
  std::istringstream words(extensions);
  for (OptionText& option : text_->options)
    if (option.names.front() == name) option.extensions.assign(std::istream_iterator<std::string>(words), {});
}

void OptionList::release(const std::string& name) { app_->get_option(name)->required(false); }

CommandLine::CommandLine(const std::string& name, const std::string& purpose, const std::string& footer)
    : app_(std::make_unique<CLI::App>(purpose, name)), text_{name, purpose, footer, {}} {
  const auto version = [this] {
    const CLI::Option* all = app_->get_option_no_throw("--verbose");
    return std::string(INSONIFY_VERSION) + (all && all->count() > 0 ? "\nbuilt with " + built_with() : "");
  };
  app_->set_version_flag("--version", version);
  const auto help = std::make_shared<WrappedHelp>();
  help->label("SUBCOMMAND", "VERB");
  app_->formatter(help);
  app_->footer(footer);
}

CommandLine::~CommandLine() = default;

OptionList CommandLine::options() { return {app_.get(), &text_}; }

OptionList CommandLine::add_verb(const std::string& name, const std::string& purpose, const std::string& footer) {
  app_->require_subcommand(1);
  if (verb_texts_.empty())
    app_->add_flag("--verbose")->description("with --version: what is built in")->needs(app_->get_option("--version"));
  CLI::App* verb = app_->add_subcommand(name, purpose);
  verb->group("Verbs")->footer(footer);
  return {verb, &verb_texts_.emplace_back(CommandText{name, purpose, footer, {}})};
}

std::string CommandLine::extras_message() const {
  const std::vector<std::string> extras = app_->remaining(true);
  const CommandText* text = &text_;
  for (const CommandText& of_verb : verb_texts_)
    if (app_->got_subcommand(of_verb.name)) text = &of_verb;
  const std::string help = (text == &text_ ? "" : text_.name + " ") + text->name + " --help";
  const auto option = std::find_if(extras.begin(), extras.end(), [](const auto& e) { return e.starts_with("-"); });
  if (option == extras.end()) return fmt::format("'{}' is one argument too many; see {}", extras.front(), help);
  const std::string name = option->substr(0, option->find('='));
  std::vector<std::string> known;
  for (const OptionText& of : text->options)
    for (const std::string& of_option : of.names)
      if (of_option.starts_with("--") && name.starts_with("--")) known.push_back(of_option);
  return fmt::format("unknown option '{}'{}; see {}", name, did_you_mean(name, known), help);
}

std::optional<int> CommandLine::parse(int argc, char** argv) {
  const std::string program = app_->get_name();
  try {
    app_->parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help and --version
    return app_->exit(success);
  } catch (const CLI::ExtrasError&) {
    print_error(extras_message());
    return exit_usage;
  } catch (const CLI::RequiredError& error) {
    const bool lacks_verb = !verb_texts_.empty() && app_->get_subcommands().empty();
    print_error(fmt::format("{}; see {} --help",
                            lacks_verb ? "no verb is given; begin with one, e.g. insonify info FILE" : error.what(),
                            program));
    return exit_usage;
  } catch (const CLI::ParseError& error) {
    print_error(fmt::format("{}; see {} --help", error.what(), program));
    return exit_usage;
  }
  return std::nullopt;
}

std::string CommandLine::verb() const { return app_->get_subcommands().front()->get_name(); }

}  // namespace insonify::tool
