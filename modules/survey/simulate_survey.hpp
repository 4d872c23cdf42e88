#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "returns/coverage.hpp"
#include "simulate/simulate_ping.hpp"
#include "survey/survey_pings.hpp"

namespace insonify {

/// What a ping of a survey gave, or why it failed.
struct SurveyReturn {
  Ping ping;
  Soundings soundings;
  std::string failure;                   ///< empty: none
  std::vector<CoveredSurfel> covered{};  ///< if the survey asks for coverage
};

/// The returns of a block's pings, in their order; absent while a ping is not done.
using BlockReturns = std::vector<std::optional<SurveyReturn>>;

/// Options of one ping of a survey: number, time and motion are the ping's, and it runs on one thread.
SimulationOptions options_of(const SimulationOptions& of_head, const SurveyPing& ping, const PingPlace& place);

/// What is kept of a ping: its number is the one among the pings of its head, and of a scanning head it knows the scan.
/// With navigation errors, its pose and its returns are where the vehicle believes them to be.
SurveyReturn return_of(SimulatedPing&& simulated, const Mission& mission, const SurveyPing& ping);

/// How the pings of a survey are made and what becomes of them. `simulate` and `done` are called by several threads at
/// once.
struct SurveyWork {
  std::function<SurveyReturn(const SurveyPing& ping)> simulate;
  /// After each ping: null for one that was resumed, not made.
  std::function<void(const SurveyReturn* made)> done;
  /// What an interrupted survey left of a block; an empty list for nothing.
  std::function<BlockReturns(const SurveyBlock& block)> resume;
  /// Gets each block once: whole, or as far as it is done when the survey stops.
  std::function<void(const SurveyBlock& block, BlockReturns& returns)> keep;
  std::function<bool()> stop;  ///< true: no further ping is begun
};

/// Makes the pings of some blocks, `threads` (0: all cores) of them at once. Pings are begun in the order of the
/// blocks; no more returns are held than those of the blocks begun and not finished. A ping that throws Error or runs
/// out of memory has failed, which is its return; what the other functions throw ends the survey. True if no ping is
/// left.
bool simulate_survey(const std::vector<SurveyPing>& pings, const std::vector<SurveyBlock>& blocks, int threads,
                     const SurveyWork& work);

}  // namespace insonify
