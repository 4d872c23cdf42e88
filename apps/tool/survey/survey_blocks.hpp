// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "tool/survey/survey_setup.hpp"

namespace insonify::tool {

/// Reads and writes the blocks of a survey in its folder.
class SurveyBlocks {
 public:
  /// `observer` receives what cannot be kept, or taken up again.
  SurveyBlocks(const SurveySetup& setup, std::string folder, RunObserver& observer)
      : setup_(setup), folder_(std::move(folder)), observer_(observer) {}

  bool is_done(const SurveyBlock& block) const;
  /// Pings that an interrupted run left; a damaged file counts as none, with a note.
  BlockOutcomes resume(const SurveyBlock& block) const;
  /// Writes a whole block with its mark, or what is done of one that is not whole for `resume`.
  void keep(const SurveyBlock& block, BlockOutcomes& outcomes) const;

 private:
  BlockFiles files_of(const SurveyBlock& block) const;
  const SurveySetup& setup_;
  std::string folder_;
  RunObserver& observer_;
};

/// Writes run.toml of every head and a copy of the mission into the folder of the survey, unless they are there.
void write_survey_settings(const SurveySetup& setup, const std::string& folder);

}  // namespace insonify::tool
