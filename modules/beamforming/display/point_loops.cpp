// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <cmath>
#include <cstdint>

#include "beamforming/display/point_loops_internal.hpp"
#include "core/target_clones.hpp"
#include "core/vector_functions.hpp"

namespace insonify::kernels {
namespace {

constexpr std::uint64_t golden = 0x9e3779b97f4a7c15;

/// Returns well mixed bits of a number (the finaliser of SplitMix64; Steele, Lea and Flood 2014).
INSONIFY_ALWAYS_INLINE std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111eb;
  return bits ^ (bits >> 31);
}
/// Returns the midpoint of one of 2^52 equal intervals between 0 and 1.
INSONIFY_ALWAYS_INLINE double uniform(std::uint64_t bits) {
  return (std::bit_cast<double>((bits >> 12) | 0x3ff0000000000000) - 1) + 0x1p-53;
}

}  // namespace

INSONIFY_CLONES void draw_normals(std::uint64_t seed, const std::uint64_t* id, std::size_t count, double* re,
                                  double* im) {
  const std::uint64_t stream = mixed(seed + golden);
#pragma GCC ivdep
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint64_t at = mixed(stream ^ (id[k] * golden));
    double sine, cosine;
    vec::sine_cosine(uniform(mixed(at + golden)), sine, cosine);
    const double magnitude = std::sqrt(-vec::log(uniform(mixed(at + 2 * golden))));
    re[k] = magnitude * cosine, im[k] = magnitude * sine;  // (E187)
  }
}

constexpr double place_of_point = 0.70710678118654752;  // distance from the middle of a disc, in its radius

INSONIFY_CLONES void draw_discs(std::uint64_t seed, const std::uint64_t* id, const Discs& discs, std::size_t count,
                                const DiscPoints& points) {
  const std::uint64_t stream = mixed(seed + golden);
  const Discs of = discs;
  const DiscPoints to = points;
#pragma GCC ivdep
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint64_t first = mixed(stream ^ (id[k] * golden));
    double x, y;
    vec::sine_cosine(uniform(mixed(first + golden)), y, x);
    x *= place_of_point, y *= place_of_point;
    const double cycles[] = {x * of.cycles[0][k] + y * of.cycles[1][k], x * of.cycles[1][k] - y * of.cycles[0][k]};
    const double in_u[] = {x * of.to_edge[0][k] + y * of.to_edge[1][k], x * of.to_edge[1][k] - y * of.to_edge[0][k]};
#pragma GCC unroll 4
    for (std::size_t point = 0; point < points_of_disc; ++point) {
      const double sign = point % 2 == 0 ? 1 : -1, away = sign * cycles[point / 2];
      const std::uint64_t at = first + (2 * point + 2) * golden;
      double sine, cosine;
      vec::sine_cosine(uniform(mixed(at)) + away, sine, cosine);
      const double magnitude = of.root[k] * std::sqrt(-vec::log(uniform(mixed(at + golden))));
      to.re[point][k] = static_cast<float>(magnitude * (of.re[k] * cosine - of.im[k] * sine));
      to.im[point][k] = static_cast<float>(magnitude * (of.re[k] * sine + of.im[k] * cosine));
      to.place[point][k] = static_cast<float>(of.place[k] + away * of.cells_per_cycle);
      const double node = (of.u[k] + sign * in_u[point / 2] + 1) * of.nodes_per_u;
      const double within = node < 0 ? 0 : node;
      to.node[point][k] = static_cast<std::int32_t>(within > of.last_node ? of.last_node : within);
    }
  }
}

INSONIFY_CLONES void place_points(const float* place, std::size_t count, const PlaceRule& rule, std::int32_t* node,
                                  float* re, float* im, const PointCells& to) {
  const PlaceRule of = rule;
  const PointCells cells = to;
  const float end = static_cast<float>(of.last_cell + 1) + of.edge, per_period = 1 / static_cast<float>(of.period);
#pragma GCC ivdep
  for (std::size_t k = 0; k < count; ++k) {
    const float at = place[k];
    const bool inside = (at > -of.edge) & (at < end);
    const auto whole = static_cast<std::int32_t>(inside ? at : 0.f);  // 0 of a place before the first cell
    const std::int32_t cell = whole < of.last_cell ? whole : of.last_cell;
    const float within = at - static_cast<float>(cell);
    const std::int32_t before = (within < of.edge) & (cell > 0),
                       behind = (within > 1 - of.edge) & (cell < of.last_cell), beside = behind - before;
    const auto share_at = [&](float from_cell) {
      const float step = (from_cell + of.edge) * of.steps_per_cell + 1, least = step > 0 ? step : 0;
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(least < of.last_share ? least : of.last_share));
    };
    const std::uint32_t share = share_at(within), share_beside = share_at(within - static_cast<float>(beside));
    cells.cell[k] = inside ? cell : -1;
    cells.in_cells[k] =
        share | share_beside << InCells::bits | static_cast<std::uint32_t>(beside + 1) << 2 * InCells::bits;
  }
  if (of.turn)
#pragma GCC ivdep
    for (std::size_t k = 0; k < count; ++k) {
      const float turn_re = of.turn[2 * node[k]], turn_im = of.turn[2 * node[k] + 1], x = re[k], y = im[k];
      re[k] = turn_re * x - turn_im * y, im[k] = turn_re * y + turn_im * x;
    }
#pragma GCC ivdep
  for (std::size_t k = 0; k < count; ++k)
    node[k] -= of.period * static_cast<std::int32_t>((static_cast<float>(node[k]) + 0.5f) * per_period);
}

}  // namespace insonify::kernels
