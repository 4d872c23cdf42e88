// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "returns/quantise.hpp"
#include "tool/dataset/dataset_form.hpp"
#include "tool/dataset/dataset_options.hpp"
#include "tool/dataset/dataset_split.hpp"

namespace insonify::tool {

/// The facts that the card of a data set states.
struct DatasetCard {
  const DatasetOptions& options;
  const std::vector<std::string>& classes;  ///< names of the masks' values
  GreyWindow window;
  const DatasetForm &polar, &fan;
  const SplitTally& tally;
  std::size_t images;
  const std::string& sonars;  ///< a line of the card for each
};

/// Returns whether objects of a class have boxes.
bool is_thing(const DatasetOptions& options, const std::vector<std::string>& classes, std::size_t category);

/// Returns the README.md of a data set.
std::string dataset_card(const DatasetCard& of);

}  // namespace insonify::tool
