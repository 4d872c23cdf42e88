// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mutex>
#include <string>

#include "core/stop_watch.hpp"
#include "survey/survey_store.hpp"
#include "tool/command/progress.hpp"

namespace insonify::tool {

/// How far a survey is: a bar with the remaining time on a terminal, and a JSON file for other programs, at most one a
/// second. May be called by several threads.
class SurveyStatus {
 public:
  /// `path`: of the file; `pings`: to be made or kept by this shard, of which `done` are there already.
  SurveyStatus(Progress& progress, std::string path, std::string shard, std::size_t pings, std::size_t done);

  /// `made`: null for a ping that was there already.
  void ping_done(const PingOutcome* made);
  /// Writes the file: running, done, interrupted or failed.
  void write(const std::string& state);

  std::size_t made() const { return made_; }
  std::size_t failed() const { return failed_; }
  double seconds() const { return seconds_; }  ///< until the last write

 private:
  void write_locked(const std::string& state);
  Progress& progress_;
  std::string path_, shard_;
  std::size_t pings_, done_before_, made_ = 0, failed_ = 0;
  double seconds_ = 0, written_ = 0;
  StopWatch watch_;
  std::mutex guard_;
};

}  // namespace insonify::tool
