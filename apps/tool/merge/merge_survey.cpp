// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/message.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "files/pending_file.hpp"
#include "files/sha256.hpp"
#include "files/utc.hpp"
#include "run_scenes/run_folder.hpp"
#include "run_scenes/stored_run.hpp"
#include "scene_io/coverage_file.hpp"
#include "scene_io/save_cloud.hpp"
#include "store/concatenate_cube_files.hpp"
#include "store/cube.hpp"
#include "store/survey_run.hpp"
#include "tool/command/progress.hpp"
#include "tool/merge/merge.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

/// A finished block and its head.
struct Finished : StoredBlock {
  const SurveyRunHead* head;
};

std::string pings_of(const SurveyRunHead& head, std::size_t block) {
  const std::size_t first = block * head.pings_per_block, last = std::min(first + head.pings_per_block, head.pings) - 1;
  return fmt::format("{}/blocks/{:06} (pings {} to {})", head.name, block, first, last);
}

/// All blocks in the order of heads and pings. Throws Error(content) naming those that are not done.
std::vector<Finished> finished_blocks(const std::string& folder, const SurveyRun& run) {
  std::vector<Finished> finished;
  std::vector<std::string> missing;
  std::size_t all = 0;
  for (const SurveyRunHead& head : run.heads) {
    std::size_t next = 0;
    const auto miss_until = [&](std::size_t end) {
      for (; next < end && missing.size() < most_listed; ++next) missing.push_back(pings_of(head, next));
      next = end + 1;
    };
    for (StoredBlock& block : stored_blocks(folder, run, head)) {
      miss_until(block.number);
      finished.push_back({std::move(block), &head});
    }
    miss_until(head.blocks());
    all += head.blocks();
  }
  const std::size_t undone = all - finished.size();
  if (undone > 0)
    fail(ErrorKind::content, folder, ": ", undone, " of ", all, " blocks are not done: ", joined(missing),
         undone > missing.size() ? fmt::format(" and {} more", undone - missing.size()) : "",
         "; run the survey (or its missing shards) again");
  return finished;
}

std::string joined_cube(const std::string& folder, const std::string& head) {
  return (fs::path(folder) / head / "cube.h5").string();
}

/// The results of joining the blocks of all heads.
struct JoinedHeads {
  ordered_json heads = ordered_json::array(), failed = ordered_json::array();  ///< for the manifest
  ordered_json notes = ordered_json::array();                                  ///< notes on the pings, for the manifest
  std::vector<std::string> clouds, coverages;                                  ///< paths of the files of the blocks
  std::vector<HeadCubes> cubes;                                                ///< cubes of the blocks, by head
};

JoinedHeads join_heads(const std::string& folder, const SurveyRun& run, const std::vector<Finished>& finished,
                       bool copy, Progress& progress) {
  JoinedHeads all;
  for (const SurveyRunHead& head : run.heads) {
    progress.step("joining " + head.name);
    std::vector<std::string>& of_head = all.cubes.emplace_back(HeadCubes{head.name, {}}).cubes;
    for (const Finished& block : finished) {
      if (block.head != &head) continue;
      for (const FailedPing& ping : block.mark.failed)
        all.failed.push_back({{"head", head.name}, {"ping", ping.number}, {"reason", ping.reason}});
      if (block.mark.cube_sha256.empty()) continue;
      of_head.push_back(block.files.cube);
      all.clouds.push_back(block.files.returns);
      if (!block.mark.coverage_sha256.empty()) all.coverages.push_back(block.files.coverage);
    }
    const std::string cube = joined_cube(folder, head.name);
    if (!of_head.empty()) {
      concatenate_cube_files(cube, of_head, copy);
      for (const PingNote& note : read_cube(cube, 0, 0).notes) {
        progress.note(head.name + ": " + sentence(note));
        all.notes.push_back(note_json(note, head.name));
      }
    }
    all.heads.push_back({{"name", head.name},
                         {"pings", head.pings},
                         {"cube", of_head.empty() ? ordered_json() : ordered_json(head.name + "/cube.h5")},
                         {"cube_sha256", of_head.empty() ? ordered_json() : ordered_json(sha256_of_file(cube))}});
  }
  return all;
}

/// Where the world is: as asked, else as mission or scene say; absent if none says it. Without a mosaic, a system that
/// GDAL cannot serve gives none.
std::optional<Georeference> georeference_of_survey(const std::string& folder, const MissionFile& frame,
                                                   const MosaicOptions& mosaic, const std::vector<Finished>& finished) {
  std::vector<Eigen::Vector3d> positions;
  for (const Finished& block : finished)
    if (positions.empty() && !block.mark.cube_sha256.empty())
      positions.push_back(read_track(block.files.cube).front().world_from_head.translation());
  try {
    return georeference_of(mosaic.world, {folder, frame.system, frame.anchor}, positions);
  } catch (const Error&) {
    if (mosaic.cell > 0) throw;
    return {};
  }
}

/// Mission and scene say where the world of a survey is.
MissionFile frame_of(const std::string& folder) {
  MissionFile frame = load_mission_tables((fs::path(folder) / "mission.toml").string());
  if (const std::string system = StoredRun(folder).system(); !system.empty()) frame.system = system;
  return frame;
}

/// The plane of mosaic.tif; absent if none is made.
std::optional<RasterPlane> plane_of(const MosaicOptions& mosaic, const std::optional<Georeference>& georeference) {
  if (mosaic.cell == 0 || (mosaic.crs.empty() && !georeference)) return {};
  return RasterPlane(mosaic.crs, georeference);
}

/// Longitude and latitude to 1e-9 degrees, which is a tenth of a millimetre, and height to a millimetre.
ordered_json coordinates_of(const Georeference& world, const Pose& world_from_head) {
  const GeoPosition position = geo_from_world(world, world_from_head.translation());
  return {std::round(1e9 * degrees(position.longitude)) / 1e9, std::round(1e9 * degrees(position.latitude)) / 1e9,
          std::round(1e3 * position.height) / 1e3};
}

}  // namespace

void merge_survey(const std::string& folder, bool copy, const MosaicOptions& mosaic, const CommonOptions& common) {
  const SurveyRun run = load_survey_run(folder);
  const std::vector<Finished> finished = finished_blocks(folder, run);
  const MissionFile frame = frame_of(folder);
  const std::optional<Georeference> georeference = georeference_of_survey(folder, frame, mosaic, finished);
  const std::optional<RasterPlane> plane = plane_of(mosaic, georeference);
  Progress progress(common, 2 + static_cast<int>(run.heads.size()) + (mosaic.cell > 0));
  progress.step("checking " + folder);
  parallel_for(finished.size(), common.threads,
               [&](std::size_t b) { require_unchanged(finished[b].files, finished[b].mark); });

  const JoinedHeads joined_heads = join_heads(folder, run, finished, copy, progress);
  const auto& [heads, failed, notes, clouds, coverages, cubes] = joined_heads;
  progress.step("joining returns");
  const std::string returns = (fs::path(folder) / "returns.ply").string();
  ordered_json manifest = {{"schema", 1},
                           {"insonify_version", INSONIFY_VERSION},
                           {"mission_sha256", run.mission_sha256},
                           {"blocks", finished.size()},
                           {"heads", heads}};
  manifest.update(frame_json(frame));
  if (georeference)
    write_file((fs::path(folder) / "track.geojson").string(),
               track_geojson(*georeference, frame.start_utc, folder, cubes).dump(1) + "\n");
  if (!clouds.empty()) {
    join_clouds(returns, clouds);
    if (mosaic.cell > 0) {
      progress.step("laying the images on the bed");
      save_mosaic(folder, cubes, returns, mosaic, plane, common.threads);
    }
    manifest["returns_sha256"] = sha256_of_file(returns);
  }
  if (!coverages.empty()) {
    const std::string coverage = (fs::path(folder) / "coverage.ply").string();
    join_coverage(coverage, coverages);
    manifest["coverage_sha256"] = sha256_of_file(coverage);
  }
  manifest["notes"] = notes;
  manifest["failed"] = failed;
  write_file((fs::path(folder) / "manifest.json").string(), manifest.dump(2) + "\n");
  print_summary(common, manifest,
                fmt::format("{}: {} blocks of {} joined", folder, finished.size(),
                            shortened_list(run.heads, ", ", &SurveyRunHead::name)));
  if (!failed.empty())
    throw SomeFailed{fmt::format("{}: {} pings failed and are missing in the cubes; manifest.json lists them", folder,
                                 failed.size())};
}

ordered_json frame_json(const MissionFile& frame) {
  ordered_json json = {{"start_utc", nullptr}, {"anchor", nullptr}};
  if (!frame.start_utc.empty()) json["start_utc"] = frame.start_utc;
  if (frame.anchor)
    json["anchor"] = {{"latitude_deg", frame.anchor->latitude_deg},
                      {"longitude_deg", frame.anchor->longitude_deg},
                      {"heading_deg", frame.anchor->heading_deg}};
  if (!frame.system.empty()) json["system"] = frame.system;
  return json;
}

ordered_json track_geojson(const Georeference& georeference, const std::string& start_utc, const std::string& folder,
                           const std::vector<HeadCubes>& heads) {
  ordered_json features = ordered_json::array();
  for (const HeadCubes& head : heads) {
    if (head.cubes.empty()) continue;
    ordered_json line = ordered_json::array(), times = ordered_json::array(), numbers = ordered_json::array();
    for (const TrackPoint& point : read_track(joined_cube(folder, head.name))) {
      line.push_back(coordinates_of(georeference, point.world_from_head));
      numbers.push_back(point.number);
      if (start_utc.empty())
        times.push_back(point.time);
      else
        times.push_back(utc_after(start_utc, point.time));
    }
    const bool single = line.size() == 1;
    features.push_back(
        {{"type", "Feature"},
         {"properties", {{"head", head.name}, {"ping", numbers}, {"time", times}}},
         {"geometry", {{"type", single ? "Point" : "LineString"}, {"coordinates", single ? line[0] : line}}}});
  }
  return {{"type", "FeatureCollection"}, {"features", features}};
}

}  // namespace insonify::tool
