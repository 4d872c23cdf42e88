#include "tool/option_list.hpp"

#include <cstdio>
#include <cstdlib>

#include <CLI/CLI.hpp>

namespace insonify::tool {

Option& Option::required(bool is_required) {
  option_->required(is_required);
  return *this;
}

Option& Option::one_of(const std::vector<std::string>& words) {
  option_->check(CLI::IsMember(words));
  return shown_as("WORD");
}

Option& Option::within(int lowest, int highest) {
  option_->check([=](const std::string& text) {
    const int value = std::atoi(text.c_str());
    return value >= lowest && value <= highest
               ? ""
               : text + " must be within " + std::to_string(lowest) + " and " + std::to_string(highest);
  });
  return *this;
}

Option& Option::positive() {
  option_->check(CLI::PositiveNumber);
  return shown_as("FLOAT");
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

Option& Option::comma_separated() {
  option_->delimiter(',');
  return *this;
}

Option& Option::one_each() {
  option_->allow_extra_args(false);
  return *this;
}

Option& Option::value_optional() {
  option_->expected(0, 1);
  return *this;
}

Option& Option::group(const char* title) {
  option_->group(title);
  return *this;
}

Option& Option::shown_as(const char* value) {
  option_->option_text(value);
  return *this;
}

Option OptionList::add(const std::string& name, std::string& value, const std::string& help) {
  return Option(app_->add_option(name, value, help));
}

Option OptionList::add(const std::string& name, double& value, const std::string& help) {
  return Option(app_->add_option(name, value, help));
}

Option OptionList::add(const std::string& name, int& value, const std::string& help) {
  return Option(app_->add_option(name, value, help));
}

Option OptionList::add(const std::string& name, std::uint64_t& value, const std::string& help) {
  return Option(app_->add_option(name, value, help));
}

Option OptionList::add(const std::string& name, std::vector<std::string>& value, const std::string& help) {
  return Option(app_->add_option(name, value, help));
}

Option OptionList::add(const std::string& name, std::optional<std::string>& value, const std::string& help) {
  return Option(app_->add_option(name, value, help));
}

Option OptionList::add(const std::string& name, bool& value, const std::string& help) {
  return Option(app_->add_flag(name, value, help));
}

Option OptionList::add(const std::string& name, const std::function<void(const std::string&)>& read,
                       const std::string& help) {
  return Option(app_->add_option_function<std::string>(name, read, help));
}

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
