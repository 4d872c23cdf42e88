// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

// Inner loops over raw pointers, compiled for several instruction sets and dispatched at run time, with the same bits
// on each. They do not include Eigen, so wide registers are safe.
namespace insonify::kernels {

/// A surfel whose parts are placed, in head axes.
struct PieceFrame {
  double centre[3], t1[3], t2[3], normal[3];  ///< [m]; tangents and normal are unit vectors
  double radius;                              ///< radius of the disc [m]
  double shift, turn_re, turn_im;             ///< shift and turn of the sequence of parts
  double away[2];                             ///< unit vector in t1 and t2: in which the range grows
  double ahead[2], level[2];                  ///< unit vectors towards the centre, from above and in its vertical plane
  double azimuth, elevation;                  ///< direction of the centre [rad]
  bool oriented;                              ///< else the normal has no sign
};

/// Where parts are placed.
struct PiecePositions {
  double *range, *azimuth, *elevation;
  float* cosine;
  float* along;  ///< offset in the direction `away`, in radii
};

/// Places parts 1 .. count of a surfel (E17). turn_re, turn_im: the turn of part k at k, for any surfel. Directions
/// come from tangents of small angles about the centre, accurate to 1e-15 rad; returns false if some part stands too
/// far off for that, and its direction is not valid.
bool place_pieces(const PieceFrame& surfel, const double* turn_re, const double* turn_im, std::size_t count,
                  PiecePositions pieces);

}  // namespace insonify::kernels
