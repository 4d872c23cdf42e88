#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace insonify::tool {

/// An option that has been added: rules beyond its name, value and help. Each returns the option itself.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option& required(bool is_required = true);
  Option& one_of(const std::vector<std::string>& words);
  Option& within(int lowest, int highest);
  Option& positive();
  Option& excludes(const Option& other);
  Option& comma_separated();         ///< of a list: "a,b" is two entries
  Option& one_each();                ///< of a list: one entry each time that the option is given
  Option& value_optional();          ///< the option may stand without a value
  Option& group(const char* title);  ///< where --help lists it; "": nowhere
  Option& shown_as(const char* value);

 private:
  CLI::Option* option_;
};

/// The options of a program or of one of its verbs. Values are written by CommandLine::parse, in the order in which the
/// options were added; an option that is not given leaves its value as it is. Names with a dash are options
/// ("-o,--output"), others are positional.
class OptionList {
 public:
  explicit OptionList(CLI::App* app) : app_(app) {}
  Option add(const std::string& name, std::string& value, const std::string& help);
  Option add(const std::string& name, double& value, const std::string& help);
  Option add(const std::string& name, int& value, const std::string& help);
  Option add(const std::string& name, std::uint64_t& value, const std::string& help);
  Option add(const std::string& name, std::vector<std::string>& value, const std::string& help);
  Option add(const std::string& name, std::optional<std::string>& value, const std::string& help);
  /// A flag: true if it is given, or what --name=false says.
  Option add(const std::string& name, bool& value, const std::string& help);
  /// An option whose value is handed to `read`.
  Option add(const std::string& name, const std::function<void(const std::string&)>& read, const std::string& help);

 private:
  CLI::App* app_;
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

  /// Parses. Returns an exit code if there is nothing left to do: 0 after --help and --version, which go to stdout, 2
  /// after an error of usage, which goes to stderr. Throws what the readers of options throw.
  std::optional<int> parse(int argc, char** argv);
  /// The verb that was named.
  std::string verb() const;

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace insonify::tool
