// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>

// Inner loops over raw pointers, compiled for several instruction sets and dispatched at run time. They do not include
// Eigen, so wide registers are safe.
namespace insonify::kernels {

/// Numbers that are treated side by side.
constexpr std::size_t visibility_lanes = 16;

/// Surfels that may be hidden, in head axes: positions, what their surfaces deviate from a plane, noise, and the
/// rounding of their positions, all in metres. Behind the last there are `visibility_lanes` of zeros.
struct OpenSurfels {
  const float *x, *y, *z, *unevenness, *noise, *rounding;
};

/// A surfel that may hide others: as a plane, and a disc in it.
struct HidingDisc {
  float away[3], plane_distance;  ///< unit normal, away from the head; distance of the plane [m]
  float position[3], reach;       ///< centre and radius of the disc, with room for rounding [m]
  float unevenness, noise;        ///< [m]
};

/// Lists surfels first[k] .. end[k] - 1, for k < rows, that may lie behind the disc: all that are deeper below its
/// plane than the larger unevenness and three times the larger noise and are seen through the disc, others on the verge
/// of that, and some beyond end[k] that fulfil the same. Returns their number; `found` has room for visibility_lanes
/// more than there are surfels in each row.
std::size_t list_behind(const OpenSurfels& open, const HidingDisc& disc, const std::uint32_t* first,
                        const std::uint32_t* end, std::size_t rows, std::uint32_t* found);

/// A linear function of the cells of a raster: at cell (x, y) of a box it is start + x along_x + y along_y.
struct CellPlane {
  float start, along_x, along_y;
};
/// Raises the cells of a box of `rows` rows of `columns` cells to at least the plane. `cells`: the first of the box;
/// there are visibility_lanes numbers beyond the last row, and a row of the raster has `stride` cells. No cell gets
/// below 0.
void raise_cells(float* cells, std::size_t stride, std::size_t columns, std::size_t rows, const CellPlane& plane);

}  // namespace insonify::kernels
