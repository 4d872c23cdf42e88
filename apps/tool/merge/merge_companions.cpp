// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "files/path_status.hpp"
#include "files/pending_file.hpp"
#include "returns/sounding_columns.hpp"
#include "run_scenes/stored_run.hpp"
#include "scene_io/insonification_file.hpp"
#include "scene_io/load_scene.hpp"
#include "scene_io/save_cloud.hpp"
#include "tool/merge/merge.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

/// The file `name` of every run, or nothing if one of them lacks it; then there is a note if others have it.
std::vector<std::string> files_of(const std::vector<std::string>& runs, const std::string& name,
                                  std::vector<std::string>& notes) {
  std::vector<std::string> files, without;
  for (const std::string& run : runs) {
    const std::string file = StoredRun(run).find(name);
    file.empty() ? without.push_back(run) : files.push_back(file);
  }
  if (without.empty()) return files;
  if (!files.empty()) notes.push_back(fmt::format("{} is left out: {} has none", name, without.front()));
  return {};
}

Soundings merged_returns(const std::vector<std::string>& files, const MergedCube& merged) {
  std::vector<Soundings> parts;
  for (const std::string& file : files) parts.push_back(load_soundings(file));
  Soundings all;
  for (std::size_t p = 0; p < merged.origins.size(); ++p) {
    const PingOrigin& from = merged.origins[p];
    const Soundings& part = parts[from.cube];
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (part.ping[i] != static_cast<std::uint32_t>(from.number)) continue;
      append_row(all, part, i);
      all.ping.back() = static_cast<std::uint32_t>(merged.cube.pings[p].number);
    }
  }
  return all;
}

/// Copies the contributors of every ping; a run of several pings has none of its own.
void copy_contributors(const RunDirectory& directory, const std::vector<std::string>& files, const MergedCube& merged) {
  fs::create_directory(directory.file("contributors"));
  for (std::size_t p = 0; p < merged.origins.size(); ++p) {
    const std::string to = directory.file(fmt::format("contributors/{:06}.h5", p));
    const std::string& from = files[merged.origins[p].cube];
    PendingFile pending(to);
    errno = 0;
    std::ifstream in(from, std::ios::binary);
    std::ofstream out(pending.temporary(), std::ios::binary);
    if (!in) fail(ErrorKind::file, from, ": cannot be read");
    out << in.rdbuf();  // copy_file reports a full disk as an error of input or output
    pending.commit(out);
  }
}

}  // namespace

std::vector<std::string> merge_companions(const RunDirectory& directory, const std::vector<std::string>& runs,
                                          const MergedCube& merged, nlohmann::ordered_json& manifest) {
  std::vector<std::string> notes;
  if (const auto files = files_of(runs, "returns.ply", notes); !files.empty()) {
    const Soundings returns = merged_returns(files, merged);
    save_soundings(directory.file("returns.ply"), returns);
    const Eigen::Vector3d origin = save_soundings(directory.file("returns.pcd"), returns);
    manifest["returns"] = returns.size();
    manifest["returns_pcd_origin_m"] = {origin.x(), origin.y(), origin.z()};
  }
  if (const auto files = files_of(runs, "contributors.h5", notes); !files.empty()) {
    copy_contributors(directory, files, merged);
    manifest["contributors"] = merged.origins.size();
  }
  if (const auto files = files_of(runs, "insonification.ply", notes); !files.empty()) {
    const bool joined =
        join_insonification(directory.file("insonification.ply"), directory.file("insonification.pcd"), files);
    manifest["insonification"] = joined;
    if (!joined) notes.emplace_back("insonification is left out: the runs are of different scenes");
  }
  return notes;
}

}  // namespace insonify::tool
