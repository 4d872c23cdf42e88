// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>

#include "survey/survey_store.hpp"

namespace insonify {

/// Makes the pings of some blocks by `simulate`, `threads` (0: all cores) of them at once: the engine of
/// simulate_survey. Several threads call `simulate` at once. Returns true if no ping is left.
bool make_blocks(const std::vector<SurveyPing>& pings, const std::vector<SurveyBlock>& blocks, int threads,
                 const std::function<PingOutcome(const SurveyPing&)>& simulate, SurveyStore& store);

}  // namespace insonify
