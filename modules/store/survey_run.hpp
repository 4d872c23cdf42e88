// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace insonify {

/// A head of a survey run, and how its pings are divided into blocks.
struct SurveyRunHead {
  std::string name;
  std::size_t pings = 0, pings_per_block = 1;
  /// Returns the number of blocks that hold the pings.
  std::size_t blocks() const { return (pings + pings_per_block - 1) / pings_per_block; }
  bool operator==(const SurveyRunHead&) const = default;
};

/// The folder of a survey: survey.toml says which mission it is of; NAME/blocks holds the blocks of head NAME.
struct SurveyRun {
  std::string mission_sha256;  ///< of the mission and all that its result depends on
  std::vector<SurveyRunHead> heads;
};

/// Returns true if the folder holds a survey.toml.
bool is_survey_run(const std::string& folder);

/// Returns true if the file called `name` below the folder of a survey is one that survey or merge writes there.
bool is_of_survey(const std::string& folder, const std::string& name);

/// Makes the folder of a survey, or checks that it is of this mission already. Throws Error(content) if it is of
/// another one, Error(argument) if its blocks have another size, Error(file) if it is another folder that is not empty,
/// or cannot be made.
void open_survey_run(const std::string& folder, const SurveyRun& run);

/// Throws Error(file) if `folder` is not of a survey, Error(content) if its survey.toml is damaged.
SurveyRun load_survey_run(const std::string& folder);

/// Files of a block; `coverage` only of surveys that ask for it. `partial_...` hold the pings of one that was
/// interrupted.
struct BlockFiles {
  std::string folder, cube, returns, coverage, mark, partial_cube, partial_returns;
};
/// Returns the paths of block `block`, from 0, of a head, below the folder of the survey.
BlockFiles block_files(const std::string& run_folder, const std::string& head, std::int64_t block);

/// A ping that could not be simulated, and why.
struct FailedPing {
  std::int64_t number = 0;
  std::string reason;
};

/// What says that a block is done: written last, and whole or not there. A block of failed pings alone has no files.
struct BlockMark {
  std::string mission_sha256;
  std::string cube_sha256, returns_sha256, coverage_sha256;  ///< empty: there is no such file
  std::vector<FailedPing> failed;
};

/// Puts the files of a block on disk for good (fsync), then writes its mark with their digests, and removes what an
/// interrupted run left of the block. Throws Error(file).
void finish_block(const BlockFiles& files, const std::string& mission_sha256, const std::vector<FailedPing>& failed);

/// The mark of a block; nothing if it is not done. Throws Error(content) for a mark that is damaged or of another
/// mission.
std::optional<BlockMark> find_mark(const BlockFiles& files, const std::string& mission_sha256);

/// A block of a head in the folder of a survey.
struct StoredBlock {
  std::size_t number = 0;
  BlockFiles files;
  std::optional<BlockMark> mark;  ///< absent: not done
};
/// The blocks of a head of a survey in the order of its pings; errors as find_mark.
std::vector<StoredBlock> stored_blocks(const std::string& folder, const SurveyRun& run, const SurveyRunHead& head);

/// Removes unfinished files that a killed process left of the block.
void remove_leftovers(const BlockFiles& files);

/// Throws Error(content) if a file of a finished block is missing or was changed since.
void require_unchanged(const BlockFiles& files, const BlockMark& mark);

}  // namespace insonify
