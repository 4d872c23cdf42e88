// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tool/command/common_options.hpp"
#include "tool/dataset/label_pictures.hpp"

namespace insonify::tool {

/// Options of `dataset`.
struct DatasetOptions {
  CommonOptions common;
  std::vector<std::string> runs;
  std::string output, window;
  double share = least_label_share;  ///< least share of a pixel's energy that gives its class
  std::string min_level;             ///< [dB] or black, below which surfaces have no class; empty: none
  int least_pixels = 20;             ///< least number of pixels of an object
  double min_contrast = 3;           ///< [dB] of an object to what is around it, for a box
  int columns = 512;                 ///< width of fan pictures [pixels]
  double tvg = 40;                   ///< [dB per decade of range]
  bool raw = false;                  ///< no TVG
  std::vector<std::string> stuff;    ///< classes that are in masks alone
  std::vector<std::string> things;   ///< classes that have boxes although they have none by default: shadow
  bool polygons = false;             ///< outlines beside the masks of COCO
  std::string row;                   ///< row of beams of heads with several: a number, all, or empty: the middle one
  std::string split = "80:10:10", split_by = "scene";
  bool force = false;
};

/// An image of a data set.
struct DatasetImage {
  std::string name, split;           ///< split: train, val or test
  std::optional<std::size_t> row{};  ///< row of beams, if the head has several
};

}  // namespace insonify::tool
