// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>

#include <Eigen/Core>

#include "core/grid.hpp"
#include "returns/quantise.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// Levels of one image, of a run or of a recording.
struct ComparedImage {
  Grid<float> level_db;               ///< beams x bins; NaN: not measured
  std::optional<BeamFan> fan{};       ///< directions of the beams; nothing: unknown
  std::optional<RangeGate> gate{};    ///< range axis; nothing: unknown. Needs a fan except for side-scan waterfalls
  std::optional<GreyWindow> scale{};  ///< scale of a recording in grey values: levels at its ends are clipped
  bool expected_level = false;        ///< true: without speckle
};

/// Returns the level of `image` at every pixel of another fan and gate: the mean intensity of its samples whose centre
/// lies in the bin, or the nearest sample if there is none, of the nearest beam; NaN where the pixel is beyond its
/// outermost beam or bin by more than half a step. Beams are matched by azimuth, of planar arrays by elevation too.
/// Throws Error(argument) if `image` has no geometry, Error(content) if nothing overlaps.
Grid<float> resampled(const ComparedImage& image, const BeamFan& fan, const RangeGate& gate);

/// Resamples in range alone, row by row, for waterfalls of pings x bins. Throws Error(argument) if the image has no
/// ranges, Error(content) if nothing overlaps.
Grid<float> resampled_in_range(const ComparedImage& image, const RangeGate& gate);

/// Returns the beam whose direction is nearest to that of `p` (head axes): for a line array by the azimuth of its cone,
/// for a fan with several elevations by azimuth and elevation. Nothing if the nearest is more than a beam width (row
/// width) away.
std::optional<std::size_t> nearest_beam(const BeamFan& fan, const Eigen::Vector3d& p);

}  // namespace insonify
