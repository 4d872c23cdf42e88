// SPDX-License-Identifier: BSD-3-Clause
#include "store/key_table.hpp"
#include "store/sourced_values_internal.hpp"

namespace insonify {
namespace {

constexpr Named<int> statuses[] = {{"sourced", 0}, {"recalled", 1}, {"derived", 2},
                                   {"assumed", 3}, {"unknown", 4},  {"user", 5}};

/// Returns the value of an entry: plain, or from a table {value, status, source} whose other texts go into `number`.
TomlValue value_of(const std::string& path, const TomlValue& entry, SourcedNumber& number) {
  if (entry.kind != TomlValue::Kind::table) return entry;
  TomlValue value;
  int status = 0;
  const auto take = [&value](const TomlValue& from, const std::string&) {
    value = from;
    return true;
  };
  const auto known = word(status, statuses);
  const auto check = [&](const TomlValue& from, const std::string& file) {
    number.status = from.text;
    return known.set(from, file);
  };
  read_keys(path, entry,
            {{number.key.c_str(), "value", "", {"", take, {}}, "", true},
             {number.key.c_str(), "status", "", {known.rule, check, {}}, "", true},
             {number.key.c_str(), "source", "", text(number.source), ""}},
            number.key);
  return value;
}

std::string listed(TomlValue value) {
  for (TomlValue& item : value.items)
    if (item.is_number()) item.kind = TomlValue::Kind::number;
  if (value.is_number()) value.kind = TomlValue::Kind::number;
  return value.kind == TomlValue::Kind::text ? value.text : as_toml(value);
}

}  // namespace

std::vector<SourcedNumber> take_sources(const std::string& path, TomlValue& table) {
  std::vector<SourcedNumber> numbers;
  for (std::size_t i = 0; i < table.keys.size(); ++i) {
    SourcedNumber& number = numbers.emplace_back(SourcedNumber{table.keys[i], "", "user", ""});
    table.items[i] = value_of(path, table.items[i], number);
    number.value = listed(table.items[i]);
  }
  return numbers;
}

}  // namespace insonify
