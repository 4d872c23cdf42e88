// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "returns/ping.hpp"

namespace insonify {

/// Returns the running mean of an intensity over `bins` bins, centred (with an even number half a bin farther), fewer
/// at the ends of the gate (E71). Throws Error(argument) unless bins >= 1.
Grid<float> mean_over_bins(const Grid<double>& intensity, int bins);

/// Returns the level that a display shows of every sample, beams x bins [dB re 1 uPa rms]: that of Ping::intensity, or
/// level_db of a ping without looks; at least `floor_db`.
Grid<float> shown_level_db(const Ping& ping, double floor_db = silence_db);

}  // namespace insonify
