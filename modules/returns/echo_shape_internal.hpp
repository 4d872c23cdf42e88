// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "returns/judge_soundings_internal.hpp"

namespace insonify {

/// An interval of bins about a range: the first, and one past the last.
struct Bins {
  Eigen::Index first, end;
};

/// Returns the bins of a ping within `reach` of a range [m], at least one.
Bins bins_about(const Ping& ping, double range, double reach);

/// Returns true if an echo within `reach` of a range comes from a grating lobe (E133). Such an echo is shifted in phase
/// along the pulse and coherent for longer than the pulse: it comes from beyond the fan, and the beam receives only the
/// frequencies whose grating lobe lies there.
bool is_of_grating_lobe(const Ping& ping, std::size_t beam, double range, double reach, double pulse_deviation);

/// Returns the standard deviation by which relief along the track may move the mean range of an echo [m], for a beam
/// that is wide along the track (E131). It follows from the echo's own width and skewness; 0 for a narrow beam.
double deviation_along(const JudgedPing& judged, std::size_t beam, double range, const BottomEcho& echo);

}  // namespace insonify
