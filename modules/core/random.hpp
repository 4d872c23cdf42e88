// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>

namespace insonify {

/// Stage of the simulation that draws a random number; the streams of different stages are independent. The numeric
/// values are part of the file format: changing one changes every simulated ping.
enum class RandomStage : std::uint64_t {
  surface_amplitude = 1,  ///< counted by scatterer id
  surfel_split = 2,       ///< counted by surfel id
  noise = 3,              ///< counted by (ping, beam, bin)
  scene_points = 4,       ///< counted by (part of the scene, point)
  mesh_points = 5,        ///< counted by sample, or by (triangle, part, 1)
  ray_jitter = 6,         ///< counted by (beam, ray)
  micro_relief = 7,       ///< counted by (octave, triad of waves, quantity)
  volume = 8,             ///< reverberation, counted by (ping, range cell, direction cell)
  sea_surface = 9,        ///< reverberation, counted by (ping, range cell, direction cell)
  flat_bottom = 10,       ///< reverberation, counted by (head position, range cell, direction cell)
  navigation = 11,        ///< errors of a trajectory, counted by (node, component)
  comparison = 12,        ///< draws of a perfect simulator, counted by (pixel, draw, look), or by (point, 0, 1)
  randomise = 13,         ///< changes of head and water between pings of a survey, counted by (head, ping, group)
  surface_ray = 14,       ///< rays from surface to surface, counted by (surfel id, ray), or by (surfel id, 0, 1)
  double_echo = 15,       ///< amplitudes of their echoes, counted by (surfel id, ray)
  scene_draw = 16         ///< positions of randomly placed bodies, counted by (scatter, draw, body and try)
};

/// Position of a random number in the stream of its stage.
struct RandomCounter {
  std::uint64_t first = 0;
  std::uint64_t second = 0;
  std::uint64_t third = 0;
};

/// Returns 256 random bits: Philox4x64-10 with key (seed, stage) and the given counter (Salmon et al. 2011).
std::array<std::uint64_t, 4> random_bits(std::uint64_t seed, RandomStage stage, RandomCounter counter);

/// Returns four independent numbers, uniform in the open interval (0, 1), with 52 random bits each.
std::array<double, 4> random_uniform(std::uint64_t seed, RandomStage stage, RandomCounter counter);

/// Sets u[i] and v[i] to the first two of random_uniform for counter {first[i], 0, 0}, i < count.
void random_uniform_pairs(std::uint64_t seed, RandomStage stage, const std::uint64_t* first, std::size_t count,
                          double* u, double* v);

/// Returns a circular complex normal number with E|z|^2 = 1: Rayleigh amplitude, uniform phase (E9; Box-Muller).
std::complex<double> random_complex_normal(std::uint64_t seed, RandomStage stage, RandomCounter counter);

/// Sets re[i] and im[i] to such a number from u[i] and turn[i], which are uniform in (0, 1), i < count: to 1e-15 what
/// polar(sqrt(-log(u)), 2 pi turn) gives, and the same bits on every machine.
void complex_normals(const double* u, const double* turn, std::size_t count, double* re, double* im);
/// Sets re[i] and im[i] to random_complex_normal for counter {first.first, first.second, first.third + i}, i < count,
/// to 1e-15.
void random_complex_normals(std::uint64_t seed, RandomStage stage, RandomCounter first, std::size_t count, double* re,
                            double* im);

}  // namespace insonify
