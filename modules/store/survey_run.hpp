// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace insonify {

/// A head of a survey run, and the division of its pings into blocks.
struct SurveyRunHead {
  std::string name;
  std::size_t pings = 0, pings_per_block = 1;
  /// Returns the number of blocks that hold the pings.
  std::size_t blocks() const { return (pings + pings_per_block - 1) / pings_per_block; }
  bool operator==(const SurveyRunHead&) const = default;
};

/// The contents of survey.toml in the folder of a survey. NAME/blocks beside it holds the blocks of head NAME.
struct SurveyRun {
  std::string mission_sha256;  ///< SHA-256 of the mission and all files that its result depends on
  std::vector<SurveyRunHead> heads;
};

/// Returns true if the folder holds a survey.toml.
bool is_survey_run(const std::string& folder);

/// Returns true if the file called `name` below the folder of a survey is one that survey or merge writes there.
bool is_of_survey(const std::string& folder, const std::string& name);

/// Makes the folder of a survey. If the folder exists, checks that it belongs to this mission. Throws Error(content) if
/// it belongs to another mission, Error(argument) if its blocks have another size, Error(file) if it is any other
/// folder that is not empty, or cannot be made.
void open_survey_run(const std::string& folder, const SurveyRun& run);

/// Returns the contents of survey.toml. Throws Error(file) if `folder` is not that of a survey, Error(content) if its
/// survey.toml is damaged.
SurveyRun load_survey_run(const std::string& folder);

/// The files of a block. `coverage` exists only in surveys that ask for it. `partial_...` hold the finished pings of a
/// block that was interrupted.
struct BlockFiles {
  std::string folder, cube, returns, coverage, mark, partial_cube, partial_returns;
};
/// Returns the paths of block `block`, from 0, of a head in the folder of a survey.
BlockFiles block_files(const std::string& run_folder, const std::string& head, std::int64_t block);

/// A ping that could not be simulated, and the reason.
struct FailedPing {
  std::int64_t number = 0;
  std::string reason;
};

/// The mark of a finished block. It is written last, and whole or not at all. A block with only failed pings has no
/// files.
struct BlockMark {
  std::string mission_sha256;
  std::string cube_sha256, returns_sha256, coverage_sha256;  ///< empty: the file does not exist
  std::vector<FailedPing> failed;
};

/// Finishes a block: flushes its files to the disk (fsync), writes the mark with their digests, then removes the
/// remains of an interrupted run. Throws Error(file).
void finish_block(const BlockFiles& files, const std::string& mission_sha256, const std::vector<FailedPing>& failed);

/// Returns the mark of a block; nothing if the block is not done, or if its mark is incomplete after a loss of power.
/// Throws Error(content) for a mark that is damaged otherwise or of another mission.
std::optional<BlockMark> find_mark(const BlockFiles& files, const std::string& mission_sha256);

/// A finished block of a head in the folder of a survey.
struct StoredBlock {
  std::size_t number = 0;
  BlockFiles files;
  BlockMark mark;
};
/// Returns the finished blocks of a head in the order of its pings. Throws as find_mark. The cost follows from the
/// number of files.
std::vector<StoredBlock> stored_blocks(const std::string& folder, const SurveyRun& run, const SurveyRunHead& head);
/// Returns stored_blocks. Throws Error(content), too, if a block is not done.
std::vector<StoredBlock> all_blocks(const std::string& folder, const SurveyRun& run, const SurveyRunHead& head);

/// Removes unfinished files that a killed process left of the block.
void remove_leftovers(const BlockFiles& files);

/// Throws Error(content) if a file of a finished block is missing or was changed since.
void require_unchanged(const BlockFiles& files, const BlockMark& mark);

}  // namespace insonify
