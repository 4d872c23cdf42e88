// SPDX-License-Identifier: BSD-3-Clause
// Inner loops of display cells against sums in double precision and laws of random numbers.
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "beamforming/display/between_samples_internal.hpp"
#include "beamforming/display/looks_loops_internal.hpp"
#include "beamforming/display/point_loops_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

/// Returns the looks of a beam at node `at` by the formula (E182, E223).
double looks_by_formula(const std::vector<std::vector<double>>& energy, const kernels::CellEnergies& cell,
                        std::size_t at) {
  std::vector<double> beam_azimuth(cell.subranges, 0);
  for (std::size_t j = 0; j < energy.size(); ++j) {
    const std::size_t away = j > at ? j - at : at - j;
    for (std::size_t n = 0; n < cell.subranges; ++n)
      beam_azimuth[n] += energy[j][n] * ((away < cell.lobe_reach ? cell.lobe[away] : 0) + cell.beside);
  }
  // The correlations of noise with ground and with noise are weaker than that of ground.
  const double noise = cell.noise;
  double products = 0, sum = 0;
  for (std::size_t k = 0; k < cell.subranges; ++k) {
    sum += beam_azimuth[k] + noise;
    for (std::size_t n = 0; n < cell.subranges; ++n) {
      const std::size_t away = k > n ? k - n : n - k;
      const double ground = away < cell.reach ? cell.correlation[away] : 0;
      products += beam_azimuth[k] * beam_azimuth[n] * ground +
                  2 * beam_azimuth[k] * noise * (ground - static_cast<double>(cell.with_ground)) +
                  noise * noise * (ground - static_cast<double>(cell.alone));
    }
  }
  return sum * sum / products;
}

std::vector<std::complex<double>> display_normals(std::uint64_t seed, std::size_t count) {
  std::vector<std::uint64_t> id(count);
  std::iota(id.begin(), id.end(), std::uint64_t{5} << 32);
  std::vector<double> re(count), im(count);
  kernels::draw_normals(seed, id.data(), count, re.data(), im.data());
  std::vector<std::complex<double>> numbers(count);
  for (std::size_t k = 0; k < count; ++k) numbers[k] = {re[k], im[k]};
  return numbers;
}

/// Root of the mean square error of a random function of all frequencies up to the highest, between the samples of a
/// period, in that of the function.
template <std::size_t width>
double error_between_samples(double oversampling) {
  constexpr std::size_t length = 200;
  const SampleKernel<width> kernel(oversampling);
  const int highest = static_cast<int>(kernel.highest() * static_cast<double>(length));
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  const auto turn = [](int q, double position) {
    return std::polar(1.0, 2 * pi * q * position / static_cast<double>(length));
  };
  std::vector<std::complex<double>> spectrum, samples(length + guards_before + guards_behind);
  for (int q = -highest; q <= highest; ++q) spectrum.emplace_back(normal(engine), normal(engine));
  const auto at = [&](int q) { return spectrum[static_cast<std::size_t>(q + highest)]; };
  for (std::size_t j = 0; j < length; ++j)
    for (int q = -highest; q <= highest; ++q)
      samples[guards_before + j] +=
          at(q) * turn(q, static_cast<double>(j)) / (kernel.transform(q / static_cast<double>(length)) * length);
  repeat_ends(samples);
  double error = 0, square = 0;
  for (double position = 0; position < length; position += 0.37) {
    std::complex<double> exact = 0;
    for (int q = -highest; q <= highest; ++q) exact += at(q) * turn(q, position) / static_cast<double>(length);
    error += std::norm(kernel.at(position).of(samples.data()) - exact), square += std::norm(exact);
  }
  return std::sqrt(error / square);
}

TEST(DisplayLoops, fields_and_powers_between_samples_are_as_exact_as_said) {
  EXPECT_LT(error_between_samples<4>(4), 1e-3);
  EXPECT_LT(error_between_samples<8>(2), 1e-6);
  EXPECT_LT(error_between_samples<8>(1.25), 1e-4);
  EXPECT_GT(error_between_samples<4>(2), error_between_samples<4>(4));
}

TEST(DisplayLoops, looks_are_those_of_the_formula) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> uniform(0, 1);
  const std::vector<float> lobe = {1, 0.6f, 0.1f}, correlation = {0.7f, 0.3f, 0.05f};
  for (const std::size_t subranges : {4, 16, 17, 32}) {
    constexpr std::size_t nodes = 40;
    const std::size_t row = kernels::row_length(subranges);
    std::vector<std::vector<double>> energy(nodes, std::vector<double>(subranges, 0));
    std::vector<float> differences((nodes + 1) * row, 0), alike(nodes + 1, 0);
    for (int k = 0; k < 30; ++k) {
      const auto pick = [&](std::size_t n) {
        return static_cast<std::size_t>(uniform(engine) * static_cast<float>(n));
      };
      const std::size_t first = pick(nodes), last = first + pick(nodes - first), n = pick(subranges);
      const float more = uniform(engine);
      for (std::size_t j = first; j <= last; ++j) energy[j][n] += static_cast<double>(more);
      differences[first * row + n] += more, differences[(last + 1) * row + n] -= more;
      // Others begin and end within a range.
      const float low = static_cast<float>(n) + 0.25f,
                  high = std::min(static_cast<float>(subranges), low + 0.125f + 5 * more);
      const kernels::RangedEnergy ranged{low, high, 0.2f, static_cast<std::uint32_t>(first),
                                         static_cast<std::uint32_t>(last + 1)};
      kernels::add_energies(&ranged, 1, subranges, differences.data());
      for (std::size_t j = first; j <= last; ++j)
        for (std::size_t range = 0; range < subranges; ++range) {
          const auto at = static_cast<float>(range);
          energy[j][range] += 0.2 * static_cast<double>(std::max(0.f, std::min(high, at + 1) - std::max(low, at)));
        }
      // Some are in all ranges alike.
      if (k % 3 != 0) continue;
      for (std::size_t j = first; j <= last; ++j)
        for (double& of_range : energy[j]) of_range += 0.1 * static_cast<double>(more);
      alike[first] += 0.1f * more, alike[last + 1] -= 0.1f * more;
    }
    const kernels::CellEnergies cell{
        differences.data(), alike.data(),      nodes, subranges, lobe.data(), lobe.size(), 1e-3f, 0.3f, 0.01f, 0.02f,
        correlation.data(), correlation.size()};
    const std::vector<std::size_t> at = {0, 1, 7, 20, 38, 39};
    std::vector<double> looks(at.size());
    kernels::count_looks(cell, at.data(), at.size(), looks.data());
    for (std::size_t k = 0; k < at.size(); ++k) {
      const double exact = std::max(1.0, looks_by_formula(energy, cell, at[k]));
      EXPECT_NEAR(looks[k], exact, 1e-4 * exact) << subranges << " parts, node " << at[k];
    }
  }
}

TEST(DisplayLoops, looks_through_grating_lobes_are_those_of_the_formula) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> uniform(0, 1);
  const auto numbers = [&](std::size_t count) {
    std::vector<float> made(count);
    for (float& number : made) number = uniform(engine);
    return made;
  };
  constexpr std::size_t nodes = 60, subranges = 4, first = 12, count = 16, bands = 32;
  const std::vector<float> one = {1}, correlation = {0.7f, 0.3f}, heard = numbers(count * bands),
                           with_band = numbers(bands), part_alike = {0.9f, 0.5f, 0.1f};
  std::vector<float> all(count, 0), differences((nodes + 1) * kernels::row_length(subranges), 0), alike(nodes + 1, 0),
      whole(nodes + 2 * count, 0);
  for (std::size_t i = 0; i < count * bands; ++i) all[i / bands] += heard[i];
  const std::vector<float> reversed(all.rbegin(), all.rend());
  // Each node has the same energy in all ranges.
  for (std::size_t j = 0; j < nodes; ++j) {
    const float density = uniform(engine);
    whole[count + j] = density * subranges, alike[j] += density, alike[j + 1] -= density;
  }
  const kernels::GratingLobes gratings{first,
                                       count,
                                       bands,
                                       heard.data(),
                                       all.data(),
                                       reversed.data(),
                                       with_band.data(),
                                       part_alike.data(),
                                       part_alike.size(),
                                       whole.data() + count};
  const kernels::CellEnergies cell{
      differences.data(), alike.data(),       nodes,    subranges, one.data(), one.size(), 0, 0.1f, 0, 0,
      correlation.data(), correlation.size(), &gratings};
  const std::vector<std::size_t> at = {0, 5, 30, 59};
  std::vector<double> looks(at.size());
  kernels::count_looks(cell, at.data(), at.size(), looks.data());
  for (std::size_t k = 0; k < at.size(); ++k) {
    std::vector<double> part(bands, 0);
    for (std::size_t j = 0; j < nodes; ++j) {
      const std::size_t away = j > at[k] ? j - at[k] : at[k] - j;
      if (away < first || away >= first + count) continue;
      for (std::size_t q = 0; q < bands; ++q)
        part[q] += static_cast<double>(whole[count + j]) * static_cast<double>(heard[(away - first) * bands + q]);
    }
    const double range = static_cast<double>(whole[count + at[k]]) / subranges + 0.1, main = range * subranges;
    double energy = main, products = range * range * (4 * 0.7 + 6 * 0.3);
    for (std::size_t q = 0; q < bands; ++q) {
      energy += part[q], products += 2 * main * part[q] * static_cast<double>(with_band[q]);
      for (std::size_t p = 0; p < bands; ++p) {
        const std::size_t away = p > q ? p - q : q - p;
        if (away < part_alike.size()) products += part[q] * part[p] * static_cast<double>(part_alike[away]);
      }
    }
    const double exact = std::max(1.0, energy * energy / products);
    EXPECT_NEAR(looks[k], exact, 1e-4 * exact) << "node " << at[k];
  }
}

TEST(DisplayLoops, normal_numbers_have_moments_of_their_law_and_are_independent) {
  constexpr std::size_t count = 1 << 19;
  const auto one = display_normals(1, count), other = display_normals(2, count);
  double power = 0, square = 0;
  std::complex<double> mean = 0, pseudo = 0, next = 0, between_seeds = 0;
  for (std::size_t k = 0; k < count; ++k) {
    power += std::norm(one[k]), square += std::norm(one[k]) * std::norm(one[k]);
    mean += one[k], pseudo += one[k] * one[k];
    next += one[k] * std::conj(one[(k + 1) % count]), between_seeds += one[k] * std::conj(other[k]);
  }
  constexpr double n = count;
  const double deviation = 1 / std::sqrt(n);  // of a mean of numbers of variance 1
  EXPECT_NEAR(power / n, 1, 5 * deviation);
  EXPECT_NEAR(square / n, 2, 5 * std::sqrt(20.0) * deviation);
  EXPECT_LT(std::abs(mean) / n, 5 * deviation);
  EXPECT_LT(std::abs(pseudo) / n, 5 * std::sqrt(2.0) * deviation);
  EXPECT_LT(std::abs(next) / n, 5 * deviation);
  EXPECT_LT(std::abs(between_seeds) / n, 5 * deviation);
}

/// Mean and contrast of numbers.
struct Statistics {
  double mean, contrast;
};
Statistics statistics_of(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (const double value : values) sum += value, squares += value * value;
  const double count = static_cast<double>(values.size()), mean = sum / count;
  return {mean, std::sqrt(squares / count - mean * mean) / mean};
}

/// Fields of powers p, of which neighbours share s as the amplitudes of one echo: by Cholesky's factors.
struct ThreeFields {
  std::string name;
  std::array<double, 3> power;
  std::array<double, 2> shared;
};

// Laws have the mean right to 0.2 % and the contrast to 1.2 % (E229). Five standard errors of so many numbers are 0.6 % of the
// mean of 2.5 looks and 0.8 % of the contrast.
TEST(DisplayLoops, drawn_intensities_have_their_mean_and_looks) {
  constexpr std::size_t count = 1 << 18;
  const double even = pi / 8, nothing = std::numeric_limits<double>::min();
  const ThreeFields cases[] = {{"independent", {2, 2, 2}, {0, 0}},
                               {"two", {2, 2, nothing}, {0, 0}},
                               {"even ground", {1, 1, 1}, {even, even}},
                               {"uneven", {0.15, 0.7, 0.15}, {0.1, 0.1}},
                               {"an echo between two", {0.5, 0.5, 1e-6}, {0.45, 0}},
                               {"one in the middle", {0.1, 0.8, 0.1}, {0.2, 0.2}}};
  const auto a = display_normals(3, count), b = display_normals(4, count), c = display_normals(5, count);
  for (const ThreeFields& of : cases) {
    const auto& [p, s] = std::tie(of.power, of.shared);
    const double first = std::sqrt(p[0]), to_second = s[0] / first, second = std::sqrt(p[1] - to_second * to_second),
                 to_third = s[1] / second, third = std::sqrt(std::max(0.0, p[2] - to_third * to_third));
    std::array<std::vector<double>, 3> intensity, power;
    std::array<std::vector<double>, 2> shared;
    for (std::size_t k = 0; k < count; ++k) {
      intensity[0].push_back(std::norm(first * a[k]));
      intensity[1].push_back(std::norm(to_second * a[k] + second * b[k]));
      intensity[2].push_back(std::norm(to_third * b[k] + third * c[k]));
    }
    for (std::size_t q = 0; q < 3; ++q) power[q].assign(count, p[q]);
    for (std::size_t q = 0; q < 2; ++q) shared[q].assign(count, s[q]);
    const std::vector<double> mean(count, 3), strong(count, 0.5);
    for (const double looks : {2.5, 6.0, 19.0}) {
      const std::vector<double> wanted(count, looks);
      const kernels::EvenGround ground{{intensity[0].data(), intensity[1].data(), intensity[2].data()},
                                       {power[0].data(), power[1].data(), power[2].data()},
                                       {shared[0].data(), shared[1].data()},
                                       wanted.data(),
                                       mean.data(),
                                       strong.data()};
      std::vector<double> drawn(count);
      kernels::draw_looks(ground, count, drawn.data());
      for (double& value : drawn) value -= 0.5;
      const Statistics made = statistics_of(drawn);
      const double deviation = 5 / std::sqrt(looks * static_cast<double>(count));
      EXPECT_NEAR(made.mean / 3, 1, 0.002 + deviation) << looks << " looks of " << of.name;
      EXPECT_NEAR(made.contrast * std::sqrt(looks), 1, 0.012 + 0.008) << looks << " looks of " << of.name;
    }
  }
}

// The points of a disc, 1.6 rad of phase and 0.3 of u from its middle to its edge, have its place, its extents and the loss of
// coherence of a disc that turns: twice J1(x) / x for a change of phase by x at its edge.
TEST(DisplayLoops, points_have_energy_extent_and_coherence_of_a_disc) {
  constexpr std::size_t count = 1 << 16, number = kernels::points_of_disc;
  std::vector<std::uint64_t> id(count);
  std::iota(id.begin(), id.end(), 0);
  const std::vector<double> place(count, 7), u(count, 0.1), one(count, 1), zero(count, 0), root(count, 0.5);
  struct Points {
    std::array<std::vector<float>, number> re, im, place;
    std::array<std::vector<std::int32_t>, number> node;
  };
  const auto points_of = [&](double first, double second) {
    const std::vector<double> along(count, first), across(count, second), in_u(count, 0.3);
    Points of;
    kernels::DiscPoints to;
    for (std::size_t k = 0; k < number; ++k) {
      of.re[k].resize(count), of.im[k].resize(count), of.place[k].resize(count), of.node[k].resize(count);
      to.re[k] = of.re[k].data(), to.im[k] = of.im[k].data(), to.place[k] = of.place[k].data();
      to.node[k] = of.node[k].data();
    }
    kernels::draw_discs(5, id.data(),
                        {place.data(),
                         u.data(),
                         one.data(),
                         zero.data(),
                         root.data(),
                         {along.data(), across.data()},
                         {in_u.data(), zero.data()},
                         2,
                         1000,
                         1999},
                        count, to);
    return of;
  };
  const Points before = points_of(0.25, 0);
  double energy = 0, middle = 0, square = 0, square_u = 0;
  for (std::size_t k = 0; k < number; ++k)
    for (std::size_t i = 0; i < count; ++i) {
      const double away = static_cast<double>(before.place[k][i]) - 7, away_u = (before.node[k][i] + 0.5) / 1000 - 1.1;
      energy += before.re[k][i] * before.re[k][i] + before.im[k][i] * before.im[k][i];
      middle += away, square += away * away, square_u += away_u * away_u;
    }
  EXPECT_NEAR(energy / count, 1, 0.01);
  EXPECT_NEAR(middle / (number * count), 0, 1e-6);
  EXPECT_NEAR(square / (number * count), std::pow(2 * 0.25, 2) / 4, 1e-3);
  EXPECT_NEAR(square_u / (number * count), 0.3 * 0.3 / 4, 1e-3);
  for (const double turned : {0.1, 0.2, 0.3}) {
    const Points after = points_of(0.25, turned);
    std::complex<double> sum = 0;
    for (std::size_t k = 0; k < number; ++k)
      for (std::size_t i = 0; i < count; ++i)
        sum += std::complex<double>(before.re[k][i], before.im[k][i]) *
               std::complex<double>(after.re[k][i], -after.im[k][i]);
    const double x = 2 * pi * turned;
    EXPECT_NEAR(std::abs(sum) / count, 2 * std::cyl_bessel_j(1, x) / x, 0.03) << turned;
  }
}

}  // namespace
}  // namespace insonify
