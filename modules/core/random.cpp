// SPDX-License-Identifier: BSD-3-Clause
#include "core/random.hpp"

#include <algorithm>
#include <cmath>

#include <Random123/philox.h>

#include "core/units.hpp"

namespace insonify {

namespace {

r123::Philox4x64::key_type key_of(std::uint64_t seed, RandomStage stage) {
  return {{seed, static_cast<std::uint64_t>(stage)}};
}

// Returns the midpoint of one of 2^52 equal intervals: never 0, never 1.
double uniform(std::uint64_t bits) { return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52; }

}  // namespace

std::array<std::uint64_t, 4> random_bits(std::uint64_t seed, RandomStage stage, RandomCounter counter) {
  const r123::Philox4x64 philox;
  const r123::Philox4x64::key_type key = key_of(seed, stage);
  const r123::Philox4x64::ctr_type at = {{counter.first, counter.second, counter.third, 0}};
  const auto bits = philox(at, key);
  return {bits[0], bits[1], bits[2], bits[3]};
}

std::array<double, 4> random_uniform(std::uint64_t seed, RandomStage stage, RandomCounter counter) {
  const auto bits = random_bits(seed, stage, counter);
  std::array<double, 4> u{};
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = uniform(bits[i]);
  return u;
}

void random_uniform_pairs(std::uint64_t seed, RandomStage stage, const std::uint64_t* first, std::size_t count,
                          double* u, double* v) {
  const r123::Philox4x64 philox;
  const r123::Philox4x64::key_type key = key_of(seed, stage);
  for (std::size_t i = 0; i < count; ++i) {
    const auto bits = philox({{first[i], 0, 0, 0}}, key);
    u[i] = uniform(bits[0]);
    v[i] = uniform(bits[1]);
  }
}

std::complex<double> random_complex_normal(std::uint64_t seed, RandomStage stage, RandomCounter counter) {
  const auto u = random_uniform(seed, stage, counter);
  return std::polar(std::sqrt(-std::log(u[0])), 2 * pi * u[1]);  // (E9)
}

void random_complex_normals(std::uint64_t seed, RandomStage stage, RandomCounter first, std::size_t count, double* re,
                            double* im) {
  const r123::Philox4x64 philox;
  const r123::Philox4x64::key_type key = key_of(seed, stage);
  std::array<double, 128> u, turn;
  for (std::size_t begin = 0; begin < count; begin += u.size()) {
    const std::size_t some = std::min(u.size(), count - begin);
    for (std::size_t i = 0; i < some; ++i) {
      const auto bits = philox({{first.first, first.second, first.third + begin + i, 0}}, key);
      u[i] = uniform(bits[0]), turn[i] = uniform(bits[1]);
    }
    complex_normals(u.data(), turn.data(), some, re + begin, im + begin);
  }
}

}  // namespace insonify
