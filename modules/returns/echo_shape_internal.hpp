// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "returns/judge_soundings_internal.hpp"

namespace insonify {

/// Bins about a range, first and behind the last.
struct Bins {
  Eigen::Index first, end;
};

/// The bins of a ping within `reach` of a range [m], at least one.
Bins bins_about(const Ping& ping, double range, double reach);

/// Whether an echo within `reach` of a range is turned against its pulse and coherent for longer than that: as sound
/// from beyond the fan is, of which a beam hears in a grating lobe only the frequencies whose lobe lies there. (E133)
bool is_of_grating_lobe(const Ping& ping, std::size_t beam, double range, double reach, double pulse_deviation);

/// How far the relief along the way may move the mean range of an echo of a beam that is wide along it, as a standard
/// deviation from the echo's own width and skewness [m]; 0 of a narrow beam. (E131)
double deviation_along(const JudgedPing& judged, std::size_t beam, double range, const BottomEcho& echo);

}  // namespace insonify
