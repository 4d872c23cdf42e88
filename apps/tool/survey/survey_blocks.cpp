// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <exception>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "core/error.hpp"
#include "files/path_status.hpp"
#include "files/pending_file.hpp"
#include "returns/sounding_columns.hpp"
#include "run/run_settings.hpp"
#include "run_scenes/run_folder.hpp"
#include "scene_io/coverage_file.hpp"
#include "scene_io/save_cloud.hpp"
#include "store/cube.hpp"
#include "tool/survey/survey.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

void append(Soundings& to, const Soundings& from, std::uint32_t number) {
  for (std::size_t i = 0; i < from.size(); ++i)
    if (from.ping[i] == number) append_row(to, from, i);
}

/// Drops the layers if not all pings have the same ones: what a ping needs is decided for each. Returns a note then.
std::vector<PingNote> drop_unlike_layers(std::vector<Ping>& pings) {
  const auto same = [](const Layer& a, const Layer& b) { return a.name == b.name; };
  const auto alike = [&](const Ping& ping) {
    const auto &first = pings.front().layers, &layers = ping.layers;
    return std::equal(layers.begin(), layers.end(), first.begin(), first.end(), same);
  };
  if (std::all_of(pings.begin(), pings.end(), alike)) return {};
  for (Ping& ping : pings) ping.layers.clear();
  return {{"layers left out",
           "the plan gives pings of one block different kinds of echoes, and a cube has the same layers for all of its "
           "pings, so theirs are left out; decide the kinds for all pings by with and without in [ping]",
           pings.size(), pings.front().number}};
}

BlockFiles files_of(const SurveySetup& setup, const std::string& folder, const SurveyBlock& block) {
  return block_files(folder, setup.file.mission.heads[block.head].name, block.number);
}

}  // namespace

bool is_done(const SurveySetup& setup, const std::string& folder, const SurveyBlock& block) {
  return find_mark(files_of(setup, folder, block), setup.run.mission_sha256).has_value();
}

BlockOutcomes SurveyFolder::resume(const SurveyBlock& block) {
  const BlockFiles files = files_of(setup_, folder_, block);
  std::error_code ignored;
  fs::remove(files.mark, ignored);  // one that is not whole
  remove_leftovers(files);
  for (const std::string& unmarked : {files.cube, files.returns, files.coverage}) fs::remove(unmarked, ignored);
  BlockOutcomes outcomes(block.end - block.begin);
  if (path_exists(files.partial_cube) && path_exists(files.partial_returns)) try {
      Cube cube = read_cube(files.partial_cube);
      const Soundings soundings = load_soundings(files.partial_returns);
      for (Ping& ping : cube.pings) {
        PingOutcome& outcome = outcomes.at(ping.number - setup_.survey->pings()[block.begin].number).emplace();
        append(outcome.soundings, soundings, static_cast<std::uint32_t>(ping.number));
        outcome.ping = std::move(ping);
      }
      // Counts of the whole file: with its first ping they go back into the block.
      const auto first = std::find_if(outcomes.begin(), outcomes.end(), [](const auto& o) { return o.has_value(); });
      if (first != outcomes.end()) (*first)->notes = std::move(cube.notes);
    } catch (const std::exception& error) {
      observer_.note(std::string(error.what()) + ": the pings in it are made again");
      outcomes.assign(outcomes.size(), std::nullopt);
    }
  return outcomes;
}

void SurveyFolder::keep(const SurveyBlock& block, BlockOutcomes& outcomes) {
  const BlockFiles files = files_of(setup_, folder_, block);
  std::vector<Ping> pings;
  std::vector<FailedPing> failed;
  std::vector<double> time;
  Soundings soundings;
  std::vector<CoveredSurfel> covered;
  std::vector<PingNote> notes;
  bool whole = true;
  for (std::optional<PingOutcome>& outcome : outcomes) {
    whole &= outcome.has_value();
    if (!outcome) continue;
    gather(notes_[block.head], outcome->notes);
    if (!outcome->failure.empty()) {
      failed.push_back({outcome->ping.number, outcome->failure});
      continue;
    }
    append(soundings, outcome->soundings, static_cast<std::uint32_t>(outcome->ping.number));
    time.resize(soundings.size(), outcome->ping.time);
    gather(notes, outcome->notes);
    add(covered, outcome->covered);
    outcome->covered = {};
    pings.push_back(std::move(outcome->ping));
  }
  if (!whole && setup_.file.coverage) return;  // of some pings alone it cannot go on
  if (!pings.empty()) {
    if (setup_.file.coverage) save_coverage(files.coverage, covered);
    const std::vector<PingNote> unlike = drop_unlike_layers(pings);
    for (const PingNote& note : unlike)
      observer_.note("head " + setup_.file.mission.heads[block.head].name + ": " + sentence(note));
    gather(notes, unlike);
    Cube cube = cube_of(std::move(pings), setup_.heads[block.head]);
    cube.head = setup_.file.mission.heads[block.head].name;
    cube.notes = std::move(notes);
    cube.start_utc = setup_.file.start_utc, cube.anchor = setup_.file.anchor;
    write_cube(whole ? files.cube : files.partial_cube, cube);
    save_survey_returns(whole ? files.returns : files.partial_returns, soundings, time,
                        static_cast<std::uint32_t>(block.head));
  }
  if (whole) finish_block(files, setup_.run.mission_sha256, failed);
}

void SurveyFolder::ping_done(const PingOutcome* made) {
  // Walls echo where no surfel does: with mirrors a ping is silent if its image is empty, too.
  const bool mirrors = !mirrors_of(setup_.heads.front().environment).empty();
  silent_ += made && made->failure.empty() && made->scatterers == 0 && (!mirrors || (made->ping.pressure == 0).all());
  status_.ping_done(made);
}

void write_survey_settings(const SurveySetup& setup, const std::string& folder) {
  const auto write_once = [](const fs::path& path, const std::string& text) {
    if (!path_exists(path)) write_file(path.string(), text);
  };
  write_once(fs::path(folder) / "mission.toml", setup.file.text);
  for (std::size_t h = 0; h < setup.heads.size(); ++h) {
    Run run = setup.heads[h].run;
    const fs::path head = fs::path(folder) / setup.file.mission.heads[h].name;
    if (path_exists(head)) write_once(head / "run.toml", run_toml(setup.heads[h], settings_as_toml(all_settings(run))));
  }
}

SurveyStatus::SurveyStatus(Progress& progress, std::string path, std::string shard, std::size_t pings, std::size_t done)
    : progress_(progress), path_(std::move(path)), shard_(std::move(shard)), pings_(pings), done_before_(done) {}

void SurveyStatus::ping_done(const PingOutcome* made) {
  const std::scoped_lock lock(guard_);
  ++(made ? made_ : done_before_);
  failed_ += made && !made->failure.empty();
  const std::size_t done = done_before_ + made_;
  seconds_ += watch_.lap();
  const double left =
      seconds_ * static_cast<double>(pings_ - done) / static_cast<double>(std::max<std::size_t>(1, made_));
  progress_.show(static_cast<double>(done) / static_cast<double>(pings_),
                 fmt::format("ping {} of {}, {} left", done, pings_, time_text(left)));
  if (seconds_ - written_ >= 1) write("running");
}

void SurveyStatus::write(const std::string& state) {
  const std::scoped_lock lock(guard_);
  seconds_ += watch_.lap();
  written_ = seconds_;
  const std::size_t left = pings_ - done_before_ - made_;
  nlohmann::ordered_json status = {{"schema", 1},           {"state", state},      {"shard", shard_},
                                   {"process", ::getpid()}, {"pings", pings_},     {"done", done_before_ + made_},
                                   {"failed", failed_},     {"seconds", written_}, {"seconds_left", nullptr}};
  if (made_ > 0) status["seconds_left"] = written_ * static_cast<double>(left) / static_cast<double>(made_);
  write_file(path_, status.dump(2) + "\n");
}

}  // namespace insonify::tool
