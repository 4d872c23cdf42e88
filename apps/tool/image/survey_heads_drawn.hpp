// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "tool/image/image.hpp"

namespace insonify::tool {

/// Returns the pictures that options ask for: of a survey's folder one for each head, or for the one of --head, with
/// the name of the head in the name of the picture if there are several; for view waterfall both sides of a side-scan
/// are one picture, called "sides" beside other heads. Of another run, and of views of a whole survey, they are the
/// options themselves. Throws Error(argument) for --head of a run that has no such head.
std::vector<ImageOptions> drawn_heads(const ImageOptions& options);

}  // namespace insonify::tool
