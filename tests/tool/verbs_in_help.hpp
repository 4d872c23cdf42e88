// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <regex>
#include <string>
#include <vector>

/// The verbs that the text of `insonify --help` lists.
inline std::vector<std::string> verbs_in(const std::string& help) {
  std::vector<std::string> names;
  const std::string list = help.substr(help.find("Verbs:"));
  const std::regex line("\n  ([a-z-]+) ");
  for (std::sregex_iterator found(list.begin(), list.end(), line), end; found != end; ++found)
    names.push_back((*found)[1]);
  return names;
}
