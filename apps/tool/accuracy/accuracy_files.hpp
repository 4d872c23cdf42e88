// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "accuracy/measure_accuracy.hpp"
#include "accuracy/sampling_error.hpp"
#include "store/run_directory.hpp"

namespace insonify::tool {

/// sweep.csv and sampling.csv: a header, then one line per row.
std::string sweep_csv(const std::vector<AccuracyRow>& rows);
std::string sampling_csv(const std::vector<SamplingErrorRow>& rows);

/// Draws the charts of a sweep and returns the names of their files; a chart without any point is left out.
std::vector<std::string> draw_accuracy(const std::vector<AccuracyRow>& rows,
                                       const std::vector<SamplingErrorRow>& sampling, const RunDirectory& directory);

/// Processor, cores, load, compiler, flags and commit: what run times depend on.
nlohmann::ordered_json machine_json();

/// Summary of the sweep: `speed` against direct at 1e-6, `second_core`, `promise` (worst error / tolerance for
/// each tolerance), `crossover` (scatterers from which gridded is faster). What was not measured is left out.
nlohmann::ordered_json accuracy_summary(const std::vector<AccuracyRow>& rows);

}  // namespace insonify::tool
