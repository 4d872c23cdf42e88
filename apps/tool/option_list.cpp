#include "tool/option_list.hpp"

#include <cstdio>
#include <cstdlib>

#include <CLI/CLI.hpp>

namespace insonify::tool {

namespace {

CLI::Option* add_value(CLI::App& app, const std::string& name, const OptionValue& value, const std::string& help) {
  using Function = std::function<void(const std::string&)>;
  if (bool* const* flag = std::get_if<bool*>(&value)) return app.add_flag(name, **flag, help);
  if (const auto* text = std::get_if<std::optional<std::string>*>(&value))
    return app.add_option(name, **text, help)->expected(0, 1);
  if (const auto* function = std::get_if<Function>(&value))
    return app.add_option_function<std::string>(name, *function, help);
  return std::visit(
      [&](const auto& target) -> CLI::Option* {
        if constexpr (!std::is_same_v<std::decay_t<decltype(target)>, Function>)
          return app.add_option(name, *target, help);
        return nullptr;
      },
      value);
}

/// Checks that the text is an integer within limits.
std::function<std::string(const std::string&)> range_check(std::pair<int, int> limits) {
  return [limits](const std::string& text) {
    const int value = std::atoi(text.c_str());
    if (value >= limits.first && value <= limits.second) return std::string();
    return text + " must be within " + std::to_string(limits.first) + " and " + std::to_string(limits.second);
  };
}

}  // namespace

void OptionList::add(const std::string& name, const OptionValue& value, const std::string& help,
                     const OptionRules& rules) {
  CLI::Option* option = add_value(*app_, name, value, help);
  option->required(rules.required);
  if (!rules.words.empty()) option->check(CLI::IsMember(rules.words))->option_text("WORD");
  if (rules.within) option->check(range_check(*rules.within));
  if (rules.positive) option->check(CLI::PositiveNumber)->option_text("FLOAT");
  if (rules.one_each) option->allow_extra_args(false);
  if (rules.comma_separated) option->delimiter(',');
  if (rules.excludes) option->excludes(app_->get_option(rules.excludes));
  if (rules.group) option->group(rules.group);
  if (rules.shown_as) option->option_text(rules.shown_as);
}

void OptionList::release(const std::string& name) { app_->get_option(name)->required(false); }

CommandLine::CommandLine(const std::string& name, const std::string& purpose, const std::string& footer)
    : app_(std::make_unique<CLI::App>(purpose, name)) {
  app_->set_version_flag("--version", INSONIFY_VERSION);
  app_->footer(footer);
}

CommandLine::~CommandLine() = default;

OptionList CommandLine::options() { return OptionList(app_.get()); }

OptionList CommandLine::add_verb(const std::string& name, const std::string& purpose, const std::string& footer) {
  app_->require_subcommand(1);
  CLI::App* verb = app_->add_subcommand(name, purpose);
  verb->footer(footer);
  return OptionList(verb);
}

std::optional<int> CommandLine::parse(int argc, char** argv) {
  const std::string program = app_->get_name();
  try {
    app_->parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help and --version
    return app_->exit(success);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "insonify: %s; see %s --help\n", error.what(), program.c_str());
    return 2;
  }
  return std::nullopt;
}

std::string CommandLine::verb() const { return app_->get_subcommands().front()->get_name(); }

}  // namespace insonify::tool
