// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "beamforming/display/looks_loops_internal.hpp"
#include "core/target_clones.hpp"
#include "core/vector_functions.hpp"

namespace insonify::kernels {

namespace {

/// Ranges side by side, in registers.
using Lanes = float __attribute__((vector_size(subrange_lanes * sizeof(float))));

INSONIFY_ALWAYS_INLINE void load(const float* from, Lanes& lanes) { __builtin_memcpy(&lanes, from, sizeof(lanes)); }
INSONIFY_ALWAYS_INLINE void store(const Lanes& lanes, float* to) { __builtin_memcpy(to, &lanes, sizeof(lanes)); }

/// Returns the sum over all lanes: of halves, quarters and so on, so that no lane waits for fifteen others.
INSONIFY_ALWAYS_INLINE float sum_of(const Lanes& lanes) {
  static_assert(subrange_lanes == 16);
  const auto half = __builtin_shufflevector(lanes, lanes, 0, 1, 2, 3, 4, 5, 6, 7) +
                    __builtin_shufflevector(lanes, lanes, 8, 9, 10, 11, 12, 13, 14, 15);
  const auto quarter =
      __builtin_shufflevector(half, half, 0, 1, 2, 3) + __builtin_shufflevector(half, half, 4, 5, 6, 7);
  return (quarter[0] + quarter[2]) + (quarter[1] + quarter[3]);
}

/// Sums up the energies of nodes from their differences; returns those of all nodes in `everywhere`.
template <std::size_t rows>
INSONIFY_ALWAYS_INLINE void sum_differences(const CellEnergies& cell, Lanes (&everywhere)[rows]) {
  Lanes sum[rows] = {}, inside[rows] = {};
  for (std::size_t n = 0; n < cell.subranges; ++n) inside[n / subrange_lanes][n % subrange_lanes] = 1;
  float alike = 0;
  for (std::size_t j = 0; j < cell.nodes; ++j) {
    alike += cell.alike[j];
    for (std::size_t r = 0; r < rows; ++r) {
      float* const at = cell.energy + (j * rows + r) * subrange_lanes;
      Lanes difference;
      load(at, difference);
      sum[r] += difference;
      const Lanes here = sum[r] + alike * inside[r];
      everywhere[r] += here;
      store(here, at);
    }
  }
}

constexpr float least_grating = 0.05f;  // energy heard through grating lobes, in all other, from which on it counts
constexpr float least_node = 1e-6f;     // energy of a node, in the cell's, from which on it is heard through them

/// Energy of nodes before or behind that of a beam, as grating lobes hear it.
INSONIFY_ALWAYS_INLINE float heard_of(const float* energy, const float* weight, std::size_t count) {
  Lanes sum = {}, at, weights;
  for (std::size_t i = 0; i < count; i += subrange_lanes)
    load(energy + i, at), load(weight + i, weights), sum += at * weights;
  return sum_of(sum);
}

/// Adds what the beam at node j hears through grating lobes to its energy and to the sum of its products.
INSONIFY_ALWAYS_INLINE void add_gratings(const CellEnergies& cell, std::size_t j, float& energy, float& products) {
  const GratingLobes& of = *cell.gratings;
  const bool port = j + of.first < cell.nodes, starboard = j >= of.first;
  const float* const rising = port ? of.whole + (j + of.first) : nullptr;
  const float* const falling = starboard ? of.whole + (j - of.first) : nullptr;
  const float all = (port ? heard_of(rising, of.all, of.count) : 0) +
                    (starboard ? heard_of(falling - (of.count - 1), of.reversed, of.count) : 0);
  if (!(all > least_grating * energy)) return;
  constexpr std::size_t most_rows = most_bands / subrange_lanes;
  float parts[2 * most_bands] = {};
  Lanes sum[most_rows] = {}, other, product = {};
  const std::size_t rows = of.bands / subrange_lanes;
  for (std::size_t i = 0; i < of.count; ++i) {
    const float node = (port ? rising[i] : 0) + (starboard ? *(falling - static_cast<std::ptrdiff_t>(i)) : 0);
    if (node < least_node) continue;
    for (std::size_t r = 0; r < rows; ++r)
      load(of.heard + i * of.bands + r * subrange_lanes, other), sum[r] += node * other;
  }
  for (std::size_t r = 0; r < rows; ++r) {
    load(of.with_band + r * subrange_lanes, other);
    product += 2 * energy * sum[r] * other;
    store(sum[r], parts + r * subrange_lanes);
  }
  for (std::size_t d = 0; d < of.alike_reach; ++d)
    for (std::size_t r = 0; r < rows; ++r)
      load(parts + r * subrange_lanes + d, other), product += (d > 0 ? 2 : 1) * of.alike[d] * sum[r] * other;
  products += sum_of(product), energy += all;  // (E226)
}

/// Counts looks of cells of so many whole lanes of ranges.
template <std::size_t rows>
INSONIFY_ALWAYS_INLINE void count_looks_of(const CellEnergies& cell, const std::size_t* at, std::size_t count,
                                           double* looks) {
  constexpr std::size_t whole = rows * subrange_lanes;
  Lanes everywhere[rows] = {};
  sum_differences<rows>(cell, everywhere);
  // Side lobes hear all nodes; of ranges beyond the cell nothing.
  for (std::size_t n = 0; n < whole; ++n) {
    float received = everywhere[n / subrange_lanes][n % subrange_lanes];
    everywhere[n / subrange_lanes][n % subrange_lanes] = n < cell.subranges ? cell.noise + cell.beside * received : 0;
  }
  float padded[2 * whole] = {};  // what lies beyond is 0
  const float noise = cell.noise * static_cast<float>(cell.subranges);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t j = at[k], reach = cell.lobe_reach - 1;
    Lanes received[rows], other, sum = {}, product = {};
    for (std::size_t r = 0; r < rows; ++r) received[r] = everywhere[r];
    for (std::size_t i = j > reach ? j - reach : 0; i <= std::min(j + reach, cell.nodes - 1); ++i) {
      const float weight = cell.lobe[i > j ? i - j : j - i];
      for (std::size_t r = 0; r < rows; ++r)
        load(cell.energy + i * whole + r * subrange_lanes, other), received[r] += weight * other;
    }
    for (std::size_t r = 0; r < rows; ++r) store(received[r], padded + r * subrange_lanes), sum += received[r];
    for (std::size_t d = 0; d < cell.reach; ++d) {
      const float weight = (d > 0 ? 2 : 1) * cell.correlation[d];
      for (std::size_t r = 0; r < rows; ++r)
        load(padded + r * subrange_lanes + d, other), product += weight * received[r] * other;
    }
    float sums = sum_of(sum), products = sum_of(product);
    products -= noise * (2 * (sums - noise) * cell.with_ground + noise * cell.alone);  // (E223)
    if (cell.gratings) add_gratings(cell, j, sums, products);
    looks[k] = products > 0 ? std::max(1.0, static_cast<double>(sums / products * sums)) : 1;  // (E182)
  }
}

}  // namespace

INSONIFY_CLONES void count_looks(const CellEnergies& cell, const std::size_t* at, std::size_t count, double* looks) {
  static_assert(most_subranges == 2 * subrange_lanes);
  if (cell.subranges <= subrange_lanes) return count_looks_of<1>(cell, at, count, looks);
  count_looks_of<2>(cell, at, count, looks);
}

INSONIFY_CLONES void add_energies(const RangedEnergy* added, std::size_t count, std::size_t subranges, float* energy) {
  const std::size_t row = row_length(subranges);
  float place[most_subranges];
  for (std::size_t n = 0; n < most_subranges; ++n) place[n] = static_cast<float>(static_cast<int>(n));
  for (std::size_t k = 0; k < count; ++k) {
    const RangedEnergy of = added[k];
    for (std::size_t begin = 0; begin < row; begin += subrange_lanes) {
      float *const more = energy + of.first * row + begin, *const less = energy + of.end * row + begin;
      float part[subrange_lanes];
#pragma GCC unroll 1
      for (std::size_t l = 0; l < subrange_lanes; ++l) {
        const float from = place[begin + l], to = from + 1;
        const float low = of.low > from ? of.low : from, high = of.high < to ? of.high : to;
        part[l] = high > low ? of.density * (high - low) : 0;
      }
#pragma GCC unroll 1
      for (std::size_t l = 0; l < subrange_lanes; ++l) more[l] += part[l];
#pragma GCC unroll 1
      for (std::size_t l = 0; l < subrange_lanes; ++l) less[l] -= part[l];
    }
  }
}

namespace {

/// Cube root of the weighted sum of the fields' intensities, of mean 1: its mean, 1 over its deviation, and its skewness (E229).
struct CubeRoot {
  double mean, per_deviation, skewness;
};
/// square   1 / K: sum of the squares of the weights of exponential variates that add up to it
/// excess   K^2 times the sum of their cubes, less 1: 0 for equal weights
INSONIFY_ALWAYS_INLINE CubeRoot cube_root_of(double square, double excess) {
  const double product = square * excess;
  return {1 + square * (-1.0 / 9 + 0.1504 * product + 0.0046 * square - 0.0356 * excess),
          (3 + 3.081 * product + 0.0889 * square - 0.8505 * excess) / std::sqrt(square),
          square * (0.1449 * square + 2.144 * excess)};
}

}  // namespace

INSONIFY_CLONES void draw_looks(const EvenGround& ground, std::size_t count, double* drawn) {
  const EvenGround of = ground;
  static_assert(field_parts == 3);
#pragma GCC ivdep
  for (std::size_t k = 0; k < count; ++k) {
    const double p0 = of.power[0][k], p1 = of.power[1][k], p2 = of.power[2][k];
    const double r0 = std::sqrt(p0), r1 = std::sqrt(p1), r2 = std::sqrt(p2), roots = r0 + r1 + r2;
    const double made = (of.intensity[0][k] / r0 + of.intensity[1][k] / r1 + of.intensity[2][k] / r2) / roots;
    // Fields of powers p0 and p1 share s01 with s01^2 < p0 p1, but for rounding.
    const double s01 = of.shared[0][k], s12 = of.shared[1][k];
    const double q01 = s01 * s01 < p0 * p1 ? s01 * s01 / (r0 * r1) : r0 * r1,
                 q12 = s12 * s12 < p1 * p2 ? s12 * s12 / (r1 * r2) : r1 * r2;
    const double squares = p0 + p1 + p2 + 2 * (q01 + q12),
                 cubes = p0 * r0 + p1 * r1 + p2 * r2 + 3 * (q01 * (r0 + r1) + q12 * (r1 + r2));
    const CubeRoot of_made = cube_root_of(squares / (roots * roots), cubes / squares * (roots / squares) - 1);
    // The root of a gamma variate of the looks asked for, with the skewness of what is made.
    const double even = 1 / (3 * std::sqrt(of.looks[k])), deviation = even - even * even * of_made.skewness;
    const double variate = made > 1e-300 ? made : 1e-300, third = vec::exp(vec::log(variate) * (1.0 / 3));
    const double root = 1 - deviation * deviation * (1 + deviation * of_made.skewness / 3) +
                        deviation * of_made.per_deviation * (third - of_made.mean);
    drawn[k] = of.strong[k] + of.mean[k] * (root > 0 ? root * root * root : 0);  // (E183, E229)
  }
}

}  // namespace insonify::kernels
