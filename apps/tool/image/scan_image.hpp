// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "tool/image/image.hpp"

namespace insonify::tool {

/// The sweep of a scanning head that a ping belongs to, a beam for each of its pings, at its scan angle: what an
/// operator sees, bent where the vehicle moved. Throws Error(content) for a run that is not of a scanning head of one
/// beam.
LevelImage sweep_of_head(const ImageRun& run, const ImageOptions& options, std::size_t ping);

/// Draws that sweep where it was in the world, seen from the middle of the sweep: every sample at the position and bearing
/// that its beam had, the strongest of those that meet in a cell. Cells are half a step of the head wide and a bin
/// long; those that no beam saw are silent. Errors as sweep_of_head.
LevelImage sweep_in_world(const ImageRun& run, const ImageOptions& options, std::size_t ping);

}  // namespace insonify::tool
