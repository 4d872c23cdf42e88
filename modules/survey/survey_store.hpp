#pragma once
#include <optional>
#include <string>
#include <vector>

#include "returns/coverage.hpp"
#include "returns/ping.hpp"
#include "returns/soundings.hpp"
#include "survey/survey_pings.hpp"

namespace insonify {

/// What a ping of a survey gave, or why it failed.
struct PingOutcome {
  Ping ping;  ///< its number is the one among the pings of its head; of a scanning head it knows the scan
  Soundings soundings;
  std::string failure{};                 ///< empty: none
  std::size_t scatterers = 0;            ///< that the ping was made of; 0: it is silent
  std::vector<CoveredSurfel> covered{};  ///< if the survey asks for coverage
};

/// The outcomes of a block's pings, in their order; absent while a ping is not done.
using BlockOutcomes = std::vector<std::optional<PingOutcome>>;

/// What becomes of the pings of a survey. `keep` and `resume` are called by one thread at a time, the others by several.
/// What they throw ends the survey.
class SurveyStore {
 public:
  virtual ~SurveyStore() = default;
  /// Takes each block once: whole, or as far as it is done when the survey stops.
  virtual void keep(const SurveyBlock& block, BlockOutcomes& outcomes) = 0;
  /// Returns what an interrupted survey left of a block; an empty list for nothing.
  virtual BlockOutcomes resume(const SurveyBlock&) { return {}; }
  /// Called after each ping: with nullptr for one that was resumed, not made.
  virtual void ping_done(const PingOutcome*) {}
  /// True: no further ping is begun.
  virtual bool stopped() { return false; }
};

/// Keeps the outcomes of all pings in memory, block after block as they are finished.
class SurveyInMemory : public SurveyStore {
 public:
  /// Takes the outcomes.
  void keep(const SurveyBlock& block, BlockOutcomes& outcomes) override;
  /// The outcomes of the pings of a head, in the order of their numbers.
  std::vector<PingOutcome> of_head(std::size_t head) const;

 private:
  std::vector<std::pair<SurveyBlock, BlockOutcomes>> blocks_;
};

}  // namespace insonify
