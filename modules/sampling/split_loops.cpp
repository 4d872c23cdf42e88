// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "core/target_clones.hpp"
#include "core/vector_functions.hpp"
#include "sampling/split_loops_internal.hpp"

namespace insonify::kernels {
namespace {

constexpr double step_radius = 0.75487766624669276;  // of the R2 sequence: 1 / g, g^3 = g + 1
constexpr double pi = 3.14159265358979323846;
constexpr double small_tangent = 1.0 / 16;
constexpr double min_range = 1e-6;  // [m]

}  // namespace

INSONIFY_CLONES
bool place_pieces(const PieceFrame& s, const double* turn_re, const double* turn_im, std::size_t count,
                  PiecePositions pieces) {
  const PieceFrame f = s;
  int far = 0;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    // The offset in the tangent plane.
    const double u = f.shift + static_cast<double>(static_cast<int>(i) + 1) * step_radius;
    const double radius = std::sqrt(u - vec::floor(u));
    const double unit_a = radius * (f.turn_re * turn_re[i + 1] - f.turn_im * turn_im[i + 1]);
    const double unit_b = radius * (f.turn_re * turn_im[i + 1] + f.turn_im * turn_re[i + 1]);
    const double a = f.radius * unit_a, b = f.radius * unit_b;
    const double x = f.centre[0] + (a * f.t1[0] + b * f.t2[0]);
    const double y = f.centre[1] + (a * f.t1[1] + b * f.t2[1]);
    const double z = f.centre[2] + (a * f.t1[2] + b * f.t2[2]);

    // Range, and the direction from tangents of the differences to the centre's.
    const double flat = x * x + y * y, norm = std::sqrt(flat + z * z), across = std::sqrt(flat);
    const double range = norm > min_range ? norm : min_range;
    const double along = f.ahead[0] * x + f.ahead[1] * y, left = f.ahead[0] * y - f.ahead[1] * x;
    const double forth = f.level[0] * across + f.level[1] * z, up = f.level[0] * z - f.level[1] * across;
    far |= static_cast<int>(std::abs(left) >= small_tangent * along) |
           static_cast<int>(std::abs(up) >= small_tangent * forth);
    const double azimuth = f.azimuth + vec::atan_of_small(left / along);
    const double wrapped = azimuth > pi ? azimuth - 2 * pi : azimuth < -pi ? azimuth + 2 * pi : azimuth;
    const double inward = -(f.normal[0] * x + f.normal[1] * y + f.normal[2] * z) / range;
    const double facing = f.oriented ? (inward > 0 ? inward : 0) : std::abs(inward);
    const double cosine = facing < 1 ? facing : 1;
    pieces.range[i] = range;
    pieces.azimuth[i] = wrapped;
    pieces.elevation[i] = f.elevation + vec::atan_of_small(up / forth);
    pieces.cosine[i] = static_cast<float>(cosine);
    pieces.along[i] = static_cast<float>(f.away[0] * unit_a + f.away[1] * unit_b);
  }
  return far == 0;
}

}  // namespace insonify::kernels
