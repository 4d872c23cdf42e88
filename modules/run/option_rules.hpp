// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/text.hpp"
#include "store/key_table.hpp"

namespace insonify {

/// A value that the command line and files have as a T, and the library in another form.
template <typename T>
struct Shown {
  Member<T> value;
  std::optional<KeyValue> key = {};  ///< value in files; absent: that of a T
};
/// Returns a value of the library as its word in a table of names.
template <typename Table, typename Value>
Shown<std::string> shown_as_word(Value& value, const Table& table) {
  const auto get = [&value, &table] { return std::optional(name_of(table, value)); };
  return {{get, [&value, &table](const std::string& word) { value = *find_named(table, word); }}, {}};
}

/// Numbers that the command line has as text with commas, and files as such a text or as a list.
struct NumberList {
  Member<std::vector<double>> numbers;  ///< nothing, or no number: not given
  std::size_t count;
  const char* meaning;  ///< such as "x,y,z in metres"
};

/// Where the value of an option goes. A bool is a flag: true if it is given, or what --name=false says. An
/// optional<string> is an option that may stand without a value. A function is called with the value.
using OptionValue = std::variant<std::string*, double*, int*, std::uint64_t*, bool*, std::vector<std::string>*,
                                 std::optional<std::string>*, std::function<void(const std::string&)>,
                                 Shown<std::string>, Shown<int>, Shown<bool>, NumberList>;

/// Rules of an option beyond its name, value and help.
struct OptionRules {
  bool required = false;
  std::vector<std::string> words = {};             ///< allowed values; empty: any
  std::optional<std::pair<int, int>> within = {};  ///< lowest and highest value of an integer
  bool positive = false;                           ///< a number must be > 0
  bool one_each = false;                           ///< a list gets one entry each time that the option is given
  bool comma_separated = false;                    ///< "a,b" is two entries of a list
  const char* excludes = nullptr;                  ///< an option, added before, that must not stand beside this one
  const char* group = nullptr;                     ///< title under which --help lists it; "": nowhere
  const char* shown_as = nullptr;                  ///< the value in --help; null: its type
};

}  // namespace insonify
