// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include <nlohmann/json.hpp>

#include "returns/quantise.hpp"
#include "tool/dataset/dataset_options.hpp"
#include "tool/dataset/dataset_runs.hpp"

namespace insonify::tool {

/// An image and the ping that it shows.
struct ImageOf {
  const DatasetSource& source;
  const Cube& cube;
  const Ping& ping;
  const DatasetImage& image;
};

/// Returns a line of meta.jsonl on an image as far as its objects: run, pose, sonar, water, seed, mapping, parts.
///
/// polar_pixels   of each class, in the polar image
nlohmann::ordered_json image_meta(const ImageOf& of, const DatasetOptions& options, GreyWindow window,
                                  const std::vector<std::size_t>& polar_pixels);

}  // namespace insonify::tool
