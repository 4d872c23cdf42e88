// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "compare/image_comparison.hpp"
#include "compare/rank_correlation.hpp"
#include "store/run_directory.hpp"
#include "tool/compare/compared_files.hpp"

namespace insonify::tool {

/// Draws both images, their difference, levels, correlations and map of grey, and writes index.html that shows them
/// with `table`, text of the results.
void write_compare_page(const RunDirectory& directory, const CompareOptions& options, const ComparedFile& a,
                        const ComparedFile& b, const ImageComparison& comparison, const std::string& table);

/// Draws predicted against measured levels of points, and writes index.html that shows them with `table`.
void write_points_page(const RunDirectory& directory, const CompareOptions& options, const ComparedPoints& points,
                       const PointComparison& comparison, const std::string& table);

}  // namespace insonify::tool
