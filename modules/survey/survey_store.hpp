// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "returns/coverage.hpp"
#include "returns/ping.hpp"
#include "returns/ping_note.hpp"
#include "returns/soundings.hpp"
#include "survey/survey_pings.hpp"

namespace insonify {

/// The result of a ping of a survey, or the reason of its failure.
struct PingOutcome {
  Ping ping;  ///< with its number among the pings of its head, and the scan angle of a scanning head
  Soundings soundings;
  std::string failure{};                 ///< reason of the failure; empty: none
  std::size_t scatterers = 0;            ///< number of scatterers of the ping; 0: it is silent
  std::vector<CoveredSurfel> covered{};  ///< filled if the survey asks for coverage
  std::vector<PingNote> notes{};         ///< limits of its accuracy; a resumed ping may have those of other pings, too
};

/// The outcomes of the pings of a block, in their order; empty while a ping is not done.
using BlockOutcomes = std::vector<std::optional<PingOutcome>>;

/// Receives the pings of a survey. One thread at a time calls `keep` and `resume`; several threads call the other
/// functions. An exception ends the survey.
class SurveyStore {
 public:
  virtual ~SurveyStore() = default;
  /// Receives each block once: whole, or the finished pings of a block when the survey stops.
  virtual void keep(const SurveyBlock& block, BlockOutcomes& outcomes) = 0;
  /// Returns the outcomes of a block that an interrupted survey left; an empty list if there are none.
  virtual BlockOutcomes resume(const SurveyBlock&) { return {}; }
  /// Is called after each ping; with nullptr for a ping that was resumed and not simulated.
  virtual void ping_done(const PingOutcome*) {}
  /// Returns true to stop the survey: no further ping is begun.
  virtual bool stopped() { return false; }
};

/// Keeps the outcomes of all pings in memory, block after block as they are finished.
class SurveyInMemory : public SurveyStore {
 public:
  /// Takes the outcomes.
  void keep(const SurveyBlock& block, BlockOutcomes& outcomes) override;
  /// Returns the outcomes of the pings of a head, in the order of their numbers.
  std::vector<PingOutcome> of_head(std::size_t head) const;

 private:
  std::vector<std::pair<SurveyBlock, BlockOutcomes>> blocks_;
};

}  // namespace insonify
