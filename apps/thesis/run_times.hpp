#pragma once
#include <cstddef>
#include <vector>

namespace insonify::thesis {

/// Prints Table 4 of the thesis beside our run times as a markdown table: medians of `runs` runs.
void print_run_times(const std::vector<std::size_t>& beam_counts, int runs);

}  // namespace insonify::thesis
