// SPDX-License-Identifier: BSD-3-Clause
#include "store/run_manifest.hpp"

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "files/path_status.hpp"
#include "files/sha256.hpp"
#include "store/run_directory.hpp"

namespace insonify {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* manifest_name = "manifest.json";

/// Returns the manifest of a folder; null if there is none.
json manifest_in(const std::string& folder) {
  const std::string path = (fs::path(folder) / manifest_name).string();
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return {};
  json manifest = json::parse(read_text_file(path), nullptr, false);
  if (!manifest.is_object())
    fail(ErrorKind::content, path, ": is damaged; run the ping again, or copy its folder again");
  return manifest;
}

/// Returns true if a name in a manifest is of a file below its folder.
bool lies_below(const std::string& name) {
  const fs::path path = fs::path(name).lexically_normal();
  return !path.empty() && path.is_relative() && *path.begin() != "..";
}

std::map<std::string, std::string> digests_in(const json& manifest) {
  std::map<std::string, std::string> digests;
  const auto found = manifest.find(digests_key);
  if (found == manifest.end() || !found->is_object()) return digests;
  for (const auto& [name, digest] : found->items())
    if (digest.is_string() && lies_below(name)) digests[name] = digest.get<std::string>();
  return digests;
}

bool is_unchanged(const fs::path& file, const std::string& digest) {
  constexpr std::uintmax_t most_bytes = 16 << 20;  // takes some milliseconds
  return size_of_file(file) > most_bytes || sha256_of_file(file.string()) == digest;
}

}  // namespace

std::map<std::string, std::string> digests_of_run(const std::string& folder) {
  const json manifest = manifest_in(folder);
  return manifest.is_object() ? digests_in(manifest) : std::map<std::string, std::string>{};
}

std::vector<std::string> names_of_no_run(const std::string& folder) {
  const json manifest = manifest_in(folder);
  const bool is_run = manifest.is_object() && manifest.contains("insonify_version");
  const auto digests = is_run ? digests_in(manifest) : std::map<std::string, std::string>{};
  std::vector<std::string> others;
  look_at_paths([&] {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      const std::string name = fs::path(entry.path()).lexically_relative(folder).string();
      const fs::file_status status = entry.symlink_status();
      if (fs::is_directory(status) || (is_run && name == manifest_name && fs::is_regular_file(status))) continue;
      const auto listed = digests.find(name);
      if (!fs::is_regular_file(status) || listed == digests.end() || !is_unchanged(entry.path(), listed->second))
        others.push_back(name);
    }
  });
  std::sort(others.begin(), others.end());
  return others;
}

}  // namespace insonify
