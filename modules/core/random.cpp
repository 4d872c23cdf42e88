#include "core/random.hpp"

#include <cmath>

#include <Random123/philox.h>

#include "core/units.hpp"

namespace insonify {

std::array<std::uint64_t, 4> random_bits(std::uint64_t seed, RandomStage stage, RandomCounter counter) {
  const r123::Philox4x64 philox;
  const r123::Philox4x64::key_type key = {{seed, static_cast<std::uint64_t>(stage)}};
  const r123::Philox4x64::ctr_type at = {{counter.first, counter.second, counter.third, 0}};
  const auto bits = philox(at, key);
  return {bits[0], bits[1], bits[2], bits[3]};
}

std::array<double, 4> random_uniform(std::uint64_t seed, RandomStage stage, RandomCounter counter) {
  const auto bits = random_bits(seed, stage, counter);
  std::array<double, 4> u{};
  // The midpoint of one of 2^52 equal intervals: never 0, never 1.
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = (static_cast<double>(bits[i] >> 12) + 0.5) * 0x1p-52;
  return u;
}

std::complex<double> random_complex_normal(std::uint64_t seed, RandomStage stage, RandomCounter counter) {
  const auto u = random_uniform(seed, stage, counter);
  return std::polar(std::sqrt(-std::log(u[0])), 2 * pi * u[1]);  // (E9)
}

}  // namespace insonify
