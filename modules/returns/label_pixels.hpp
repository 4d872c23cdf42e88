#pragma once
#include "core/pose.hpp"
#include "returns/contributors.hpp"
#include "returns/pixel_labels.hpp"
#include "sampling/beam_fan.hpp"
#include "sampling/range_gate.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Where a ping's pixels are.
struct PixelCells {
  const BeamFan& fan;
  const RangeGate& gate;
  const Pose& world_from_head;
  double range_resolution = 0;  ///< full width of the pulse's intensity at half its peak [m]
};

/// Labels the pixels of a ping by its strongest contributors (E125). A contributor is in the cell of a pixel if its path is
/// direct and its surfel lies, but for its own radius, within a range resolution and a beam width (in direction cosine; of
/// planar arrays a row width, too) of bin and beam. A pixel has the material that has most energy in its cell. One without
/// any is shadow if surface lies in it nevertheless: a surfel within half the elevation width, half way to the
/// next beams, and its own radius in range; else nothing. Shares are of the energy of the contributors that are listed.
/// Throws Error(argument) for contributors of another extent or scene.
PixelLabels label_pixels(const SceneCloud& scene, const Contributors& contributors, const PixelCells& cells);

}  // namespace insonify
