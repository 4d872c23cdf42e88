// SPDX-License-Identifier: BSD-3-Clause
#include "faults/files_below.hpp"

#include <fstream>
#include <sstream>

namespace fs = std::filesystem;

namespace insonify {

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

Files files_in(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files[entry.path().lexically_relative(folder).string()] = entry.is_directory() ? "/" : bytes_of(entry.path());
  return files;
}

bool same(const Files& a, const Files& b, FaultCase::Kind kind) {
  const auto is_timed = [&](const fs::path& name) {
    const bool mark = kind == FaultCase::Kind::resumes && name.extension() == ".json";
    return mark || kind == FaultCase::Kind::timed || name.filename() == "manifest.json" || name.extension() == ".jsonl";
  };
  if (a.size() != b.size()) return false;
  for (auto x = a.begin(), y = b.begin(); x != a.end(); ++x, ++y) {
    if (x->first != y->first) return false;
    if (x->second == y->second) continue;
    if (!is_timed(x->first) || x->second.empty() || y->second.empty() || x->second.back() != y->second.back())
      return false;
  }
  return true;
}

std::string difference(const Files& found, const Files& expected) {
  std::string text;
  for (const auto& [name, bytes] : found)
    if (!expected.contains(name)) text += " +" + name;
  for (const auto& [name, bytes] : expected)
    if (!found.contains(name))
      text += " -" + name;
    else if (found.at(name) != bytes)
      text += " ~" + name;
  return text;
}

}  // namespace insonify
