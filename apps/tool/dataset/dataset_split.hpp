// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tool/dataset/dataset_runs.hpp"

/// Which images train, which validate, which test.
namespace insonify::tool {

/// The names of the parts of a data set, in this order.
inline const std::vector<std::string> split_names{"train", "val", "test"};

/// A kind of unit that stays together in one part of a data set.
struct SplitUnit {
  const char* name;    ///< word of --split-by
  const char* plural;  ///< in messages
  const char* means;   ///< in --help and in the card
};
/// All of them, the default first.
const std::vector<SplitUnit>& split_units();

/// Gives every ping of the sources to train, val or test: `unit` names what stays together, `shares` are those of units
/// (of regions: of the pings of each run). Each share above 0 gets a unit as long as there are units: train first, then
/// val. Scenes go by their digests, legs in the order of runs and missions, a region is one stretch of a run's track
/// for each part, the same for all its heads, and pings are drawn, the same ones each time. Scenes, draws and pings are
/// given so that each class that DatasetSource::shows lists is in the parts by their shares, as well as it goes. A
/// run that is no survey is of the draw in its run.toml. Throws as load_mission.
void split_pings(std::vector<DatasetSource>& sources, const std::string& unit, const std::vector<double>& shares);

/// Counts images by part, and those that may show what training shows.
class SplitTally {
 public:
  /// Notes an image of a part of the data set: where the head was and how far it heard.
  void add(const std::string& split, const std::string& scene_digest, const Eigen::Vector3d& position,
           double max_range);

  /// Images of each part that has one.
  std::map<std::string, std::size_t> images() const;
  /// Counts images of a part that were taken of the same scene within their farthest range of an image of train.
  std::size_t near_train(const std::string& split) const;
  /// Sentences about parts without an image, and about those that share places with train.
  std::vector<std::string> notes(const std::string& unit, const std::string& split_option,
                                 const std::vector<double>& shares) const;

 private:
  struct Image {
    std::string scene;
    Eigen::Vector3d position;
    double max_range;
  };
  std::map<std::string, std::vector<Image>> images_;  ///< images of each part
};

}  // namespace insonify::tool
