// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "returns/ping.hpp"

namespace insonify {

/// Returns the running mean of an intensity over `bins` bins (E71). The window is centred; an even number of bins
/// extends it half a bin farther. At the ends of the gate fewer bins are averaged. Throws Error(argument) unless bins
/// >= 1.
Grid<float> mean_over_bins(const Grid<double>& intensity, int bins);

/// Returns the gate of `count` display cells, evenly over `gate`.
RangeGate display_gate(const RangeGate& gate, int count);

/// Returns the mean intensity of display cells, beams x cells: the mean over the area between the ranges of each cell
/// (E180). `intensity` has the bins of `samples`; otherwise Error(argument) is thrown.
Grid<double> mean_over_cells(const Grid<double>& intensity, const RangeGate& samples, const RangeGate& cells);

/// Returns the level that a display shows for every sample, beams x bins [dB re 1 uPa rms]: the level of
/// Ping::intensity, or level_db if the ping has no looks. The level is at least `floor_db`.
Grid<float> shown_level_db(const Ping& ping, double floor_db = silence_db);

}  // namespace insonify
