// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "files/sha256.hpp"
#include "store/mission_file.hpp"
#include "store/survey_run.hpp"
#include "tool/dataset/dataset.hpp"
#include "tool/run/run_pings.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

/// Numbers of units in train, val and test: nearest to the shares, but for shares above 0 at least one each, train
/// first.
std::array<std::size_t, 3> counts_of(std::size_t units, const std::vector<double>& shares) {
  const double sum = shares[0] + shares[1] + shares[2];
  std::array<std::size_t, 3> counts{};
  std::size_t given = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (shares[k] > 0 && given < units) counts[k] = 1, ++given;
  for (; given < units; ++given) {
    const auto lack = [&](std::size_t k) {
      return static_cast<double>(units) * shares[k] / sum - static_cast<double>(counts[k]);
    };
    std::size_t most = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (lack(k) > lack(most)) most = k;
    ++counts[most];
  }
  return counts;
}

/// The part of each of `units` units in their order.
std::vector<std::string> parts_of(std::size_t units, const std::vector<double>& shares) {
  const auto counts = counts_of(units, shares);
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < 3; ++k) parts.insert(parts.end(), counts[k], split_names[k]);
  return parts;
}

/// The parts of units by the classes that they show: each class, the rarest first, is divided by the shares as well as
/// it goes (iterative stratification: Sechidis, Tsoumakas, Vlahavas 2011). Parts are as
/// large as those of parts_of.
std::vector<std::string> stratified(const std::vector<std::set<std::string>>& shown,
                                    const std::vector<double>& shares) {
  std::array<std::size_t, 3> room = counts_of(shown.size(), shares);
  std::map<std::string, std::vector<std::size_t>> units_of;
  for (std::size_t u = 0; u < shown.size(); ++u)
    for (const std::string& name : shown[u]) units_of[name].push_back(u);
  std::vector<std::string> parts(shown.size());
  std::map<std::string, std::array<std::size_t, 3>> given;  // units of a class in each part
  const auto assign = [&](std::size_t unit, std::size_t part) {
    parts[unit] = split_names[part], --room[part];
    for (const std::string& name : shown[unit]) ++given[name][part];
  };
  std::vector<std::pair<std::size_t, std::string>> rarest;
  for (const auto& [name, units] : units_of) rarest.emplace_back(units.size(), name);
  std::sort(rarest.begin(), rarest.end());
  for (const auto& [count, name] : rarest) {
    const auto wanted = counts_of(count, shares);
    for (const std::size_t unit : units_of[name]) {
      if (!parts[unit].empty()) continue;
      const auto lack = [&](std::size_t k) {
        return static_cast<double>(wanted[k]) - static_cast<double>(given[name][k]);
      };
      std::optional<std::size_t> best;
      for (std::size_t k = 0; k < 3; ++k)
        if (room[k] > 0 && (!best || lack(k) > lack(*best))) best = k;
      assign(unit, *best);
    }
  }
  std::size_t part = 0;
  for (std::size_t unit = 0; unit < parts.size(); ++unit) {
    if (!parts[unit].empty()) continue;
    while (room[part] == 0) ++part;
    assign(unit, part);
  }
  return parts;
}

/// A ping, and the key of its unit; units are in the order of their keys.
///
/// by_class   the classes that pings show are divided by the shares, too; else units stay in order
template <typename Key>
void split_by(std::vector<DatasetSource>& sources, const std::vector<double>& shares, bool by_class, const Key& key) {
  std::map<std::string, std::set<std::string>> shown;
  for (const DatasetSource& source : sources)
    for (std::size_t p = 0; p < source.track.size(); ++p) {
      std::set<std::string>& of_unit = shown[key(source, source.track[p])];
      if (by_class && p < source.shows.size()) of_unit.insert(source.shows[p].begin(), source.shows[p].end());
    }
  std::vector<std::set<std::string>> of_units;
  for (const auto& [name, classes] : shown) of_units.push_back(classes);
  const std::vector<std::string> parts = stratified(of_units, shares);
  std::map<std::string, std::string> part_of;
  std::size_t unit = 0;
  for (const auto& [name, classes] : shown) part_of[name] = parts[unit++];
  for (DatasetSource& source : sources)
    for (const TrackPoint& ping : source.track) source.split.push_back(part_of.at(key(source, ping)));
}

/// Where in the list of runs a source stands, as a key that sorts.
std::string run_key(const DatasetSource& source) { return fmt::format("{:08} ", source.run_index); }

void split_by_leg(std::vector<DatasetSource>& sources, const std::vector<double>& shares) {
  std::map<std::size_t, std::vector<MissionLeg>> legs;
  for (const DatasetSource& source : sources)
    if (is_survey_run(source.run) && !legs.contains(source.run_index))
      legs[source.run_index] = load_mission((fs::path(source.run) / "mission.toml").string()).mission.legs;
  split_by(sources, shares, false, [&](const DatasetSource& source, const TrackPoint& ping) {
    return run_key(source) + fmt::format("{:08}", leg_at(legs[source.run_index], ping.time));
  });
}

/// Cuts the track of each run at the times by which the shares of its pings, of all heads, were sent.
void split_by_region(std::vector<DatasetSource>& sources, const std::vector<double>& shares) {
  std::map<std::size_t, std::set<double>> times;
  for (const DatasetSource& source : sources)
    for (const TrackPoint& ping : source.track) times[source.run_index].insert(ping.time);
  std::map<std::size_t, std::map<double, std::string>> part_at;
  for (const auto& [run, sent] : times) {
    const std::vector<std::string> parts = parts_of(sent.size(), shares);
    std::size_t k = 0;
    for (const double time : sent) part_at[run][time] = parts[k++];
  }
  for (DatasetSource& source : sources)
    for (const TrackPoint& ping : source.track) source.split.push_back(part_at[source.run_index].at(ping.time));
}

/// Draws of a scene's bodies in a random order, the same one each time.
void split_by_draw(std::vector<DatasetSource>& sources, const std::vector<double>& shares) {
  for (const DatasetSource& source : sources)
    if (source.draw_key.empty() && source.randomise.scene_pings == 0)
      fail(ErrorKind::argument, "--split-by draw: ", source.run,
           " is a survey that does not draw its scene anew; give [randomise] scene in its mission, or split by another "
           "unit");
  split_by(sources, shares, true, [](const DatasetSource& source, const TrackPoint& ping) {
    if (!source.draw_key.empty()) return sha256_of(source.draw_key);
    return sha256_of(run_key(source) + fmt::format("{}", ping.number / source.randomise.scene_pings));
  });
}

using Cell = std::array<std::int64_t, 3>;
Cell split_cell_of(const Eigen::Vector3d& position, double size) {
  Cell cell{};
  for (int axis = 0; axis < 3; ++axis)
    cell[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::floor(position[axis] / size));
  return cell;
}

}  // namespace

const std::vector<SplitUnit>& split_units() {
  static const std::vector<SplitUnit> all = {
      {"scene", "scenes", "no scene is in two parts"},
      {"leg", "legs",
       "a leg of a mission, or a run without a mission, is in one part; neighbouring legs see the same bed"},
      {"region", "stretches of track",
       "each run's track is cut into one stretch for each part; images near a cut see the same bed"},
      {"draw", "draws",
       "scenes are drawn anew ([randomise] scene, or runs of several draws); what one draw shows is in one part"},
      {"ping", "pings", "pings are drawn; an image and the one after it show nearly the same"}};
  return all;
}

void split_pings(std::vector<DatasetSource>& sources, const std::string& unit, const std::vector<double>& shares) {
  if (unit == "leg") return split_by_leg(sources, shares);
  if (unit == "region") return split_by_region(sources, shares);
  const auto scene = [](const DatasetSource& source, const TrackPoint&) { return source.scene_digest; };
  const auto drawn = [](const DatasetSource& source, const TrackPoint& ping) {
    return sha256_of(run_key(source) + source.head + fmt::format(" {} {:a}", ping.number, ping.time));
  };
  if (unit == "draw") return split_by_draw(sources, shares);
  unit == "ping" ? split_by(sources, shares, true, drawn) : split_by(sources, shares, true, scene);
}

void SplitTally::add(const std::string& split, const std::string& scene_digest, const Eigen::Vector3d& position,
                     double max_range) {
  images_[split].push_back({scene_digest, position, max_range});
}

std::map<std::string, std::size_t> SplitTally::images() const {
  std::map<std::string, std::size_t> counts;
  for (const auto& [split, images] : images_) counts[split] = images.size();
  return counts;
}

std::size_t SplitTally::near_train(const std::string& split) const {
  const auto train = images_.find("train"), others = images_.find(split);
  if (train == images_.end() || others == images_.end()) return 0;
  double size = 0;
  for (const Image& image : others->second) size = std::max(size, image.max_range);
  std::map<std::pair<std::string, Cell>, std::vector<Eigen::Vector3d>> cells;
  for (const Image& image : train->second)
    cells[{image.scene, split_cell_of(image.position, size)}].push_back(image.position);
  const auto is_near = [&](const Image& image) {
    const Cell middle = split_cell_of(image.position, size);
    for (std::int64_t k = 0; k < 27; ++k) {
      const Cell cell{middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1};
      const auto at = cells.find({image.scene, cell});
      if (at == cells.end()) continue;
      for (const Eigen::Vector3d& position : at->second)
        if ((position - image.position).norm() <= image.max_range) return true;
    }
    return false;
  };
  return static_cast<std::size_t>(std::count_if(others->second.begin(), others->second.end(), is_near));
}

std::vector<std::string> SplitTally::notes(const std::string& unit, const std::string& split_option,
                                           const std::vector<double>& shares) const {
  std::vector<std::string> notes;
  const SplitUnit& by = *std::find_if(split_units().begin(), split_units().end(),
                                      [&](const SplitUnit& each) { return unit == each.name; });
  std::vector<std::string> empty;
  for (std::size_t k = 0; k < 3; ++k)
    if (shares[k] > 0 && !images_.contains(split_names[k])) empty.push_back(split_names[k]);
  if (!empty.empty())
    notes.push_back(fmt::format(
        "no image is in {}: --split {} needs more {} than the runs have; give more runs, or a smaller unit with "
        "--split-by{}",
        joined(empty, " and "), split_option, by.plural, unit == "scene" ? " leg, region or ping" : " region or ping"));
  for (const auto& [split, images] : images_)
    if (const std::size_t near = split == "train" ? 0 : near_train(split); near > 0)
      notes.push_back(fmt::format(
          "{} of {} images of {} were taken within their range of an image of train: they may show the same places",
          near, images.size(), split));
  return notes;
}

}  // namespace insonify::tool
