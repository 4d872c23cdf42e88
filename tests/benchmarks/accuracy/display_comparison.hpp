// SPDX-License-Identifier: BSD-3-Clause
// Display cells in both ways, drawn and as means of samples, and how far their images are from each other.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "simulate/ping_simulator.hpp"
#include "store/sonar_file.hpp"

namespace insonify {

/// Returns a preset with this gate.
inline SonarHead head_of(const std::string& preset, double min_range, double max_range) {
  SonarSpec spec = find_sonar(preset).spec;
  spec.min_range = min_range, spec.max_range = max_range;
  return make_head(spec, sound_speed(Water{}));
}

/// A scene, a head and a number of cells, pinged in both ways.
struct Rig {
  PreparedScene scene;
  SonarHead head;
  int cells;
  bool noise;
  Environment environment{};
  EffectSettings effects{};

  struct Image {
    Grid<double> intensity;
    double cpu;
    bool drawn;
  };
  Image ping(bool phases, std::uint64_t seed, const Pose& pose) const {
    SimulationOptions o;
    o.seed = seed, o.threads = 1, o.effects = effects, o.effects.noise = noise;
    o.outputs.display_bins = cells, o.synthesis.phases = phases;
    const std::clock_t begin = std::clock();
    const SimulatedPing made = PingSimulator(head, environment, o).ping(scene, {pose});
    const double cpu = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    return {made.ping.pressure.cast<std::complex<double>>().abs2(), cpu, !made.report.options.synthesis.phases};
  }
};

/// A tenth of the ranges.
struct Band {
  Eigen::Index first, count;
};
constexpr std::size_t bands = 10;
inline Band band_of(Eigen::Index cells, std::size_t k) {
  const auto end = [&](std::size_t of) {
    return static_cast<Eigen::Index>(of) * cells / static_cast<Eigen::Index>(bands);
  };
  return {end(k), end(k + 1) - end(k)};
}

/// Means over the images of some seeds, and the images if they are kept.
struct Moments {
  Grid<double> mean, square;
  std::vector<Grid<float>> images{};
  std::vector<double> cpu{}, sums{};                 ///< CPU time and total intensity of each image
  std::array<std::vector<double>, bands> of_band{};  ///< intensity of each band in each image
  bool drawn = false;
  double median_cpu() const {
    std::vector<double> sorted = cpu;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};
enum class Images { dropped, kept };
inline Moments moments_of(const Rig& rig, bool phases, const Pose& pose, int seeds, Images images = Images::dropped) {
  Moments m;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Rig::Image image = rig.ping(phases, static_cast<std::uint64_t>(seed), pose);
    if (seed == 1) m.mean = m.square = Grid<double>::Zero(image.intensity.rows(), image.intensity.cols());
    m.mean += image.intensity / seeds, m.square += image.intensity.square() / seeds;
    for (std::size_t k = 0; k < bands; ++k) {
      const auto [first, count] = band_of(image.intensity.cols(), k);
      m.of_band[k].push_back(image.intensity.middleCols(first, count).sum());
    }
    if (images == Images::kept) m.images.push_back(image.intensity.cast<float>());
    m.cpu.push_back(image.cpu), m.sums.push_back(image.intensity.sum()), m.drawn = image.drawn;
  }
  return m;
}

/// Returns the standard error of the level of one mean relative to another [dB]. Both are over images of the same seeds, whose
/// amplitudes they share: the error is that of the differences, seed by seed.
inline double sampling_error_db(const std::vector<double>& a, const std::vector<double>& b) {
  const double count = static_cast<double>(a.size()), sum_a = std::accumulate(a.begin(), a.end(), 0.0),
               sum_b = std::accumulate(b.begin(), b.end(), 0.0);
  if (!(sum_a > 0 && sum_b > 0)) return 0;
  double square = 0;
  for (std::size_t k = 0; k < a.size(); ++k) square += std::pow(count * (a[k] / sum_a - b[k] / sum_b), 2);
  return 10 / std::numbers::ln10 * std::sqrt(square / (count * (count - 1)));
}

/// The level of one image relative to another [dB]: in the band that is most in error, of those with a thousandth of the
/// energy or more, with its standard deviation by the number of seeds; and rms over such bands, less what sampling makes.
struct BandDifference {
  double worst = 0, worst_error = 0, rms = 0;
};
inline BandDifference band_difference(const Moments& a, const Moments& b) {
  BandDifference d;
  double square = 0, count = 0;
  for (std::size_t k = 0; k < bands; ++k) {
    const auto [first, cells] = band_of(b.mean.cols(), k);
    const double energy = b.mean.middleCols(first, cells).sum();
    if (energy < 1e-3 * b.mean.sum()) continue;
    const double off = db_from_power(a.mean.middleCols(first, cells).sum() / energy),
                 error = sampling_error_db(a.of_band[k], b.of_band[k]);
    if (std::abs(off) > std::abs(d.worst)) d.worst = off, d.worst_error = error;
    square += off * off - error * error, ++count;
  }
  if (count > 0) d.rms = std::sqrt(std::max(0.0, square / count));
  return d;
}

/// Differences of two images, over cells within 40 dB of the strongest.
struct Difference {
  double total = 0, rms = 0, off = 0, contrast[2] = {0, 0};
  double middle[2] = {0, 0};  ///< contrast of the middle half of the beams, which receive no grating lobes
};
inline Difference difference(const Moments& a, const Moments& b, int seeds) {
  Difference d;
  d.total = db_from_power(a.mean.sum() / b.mean.sum());
  double cells = 0, noise = 0, middle = 0;
  const double unbiased = seeds / (seeds - 1.0), least = 1e-4 * b.mean.maxCoeff();
  for (Eigen::Index i = 0; i < b.mean.size(); ++i) {
    const double ma = a.mean.data()[i], mb = b.mean.data()[i];
    if (!(ma > 0) || mb < least) continue;
    const double va = unbiased * (a.square.data()[i] / (ma * ma) - 1),
                 vb = unbiased * (b.square.data()[i] / (mb * mb) - 1);
    const double off = db_from_power(ma / mb), sampled = 18.86 * (va + vb) / seeds;
    d.rms += off * off, noise += sampled, ++cells;
    d.off += std::abs(off) > 1 + 2.5 * std::sqrt(sampled);
    d.contrast[0] += va, d.contrast[1] += vb;
    const Eigen::Index beam = i / b.mean.cols();
    if (beam < b.mean.rows() / 4 || beam >= 3 * b.mean.rows() / 4) continue;
    d.middle[0] += va, d.middle[1] += vb, ++middle;
  }
  d.rms = std::sqrt(std::max(0.0, d.rms - noise) / cells), d.off *= 100 / cells;
  for (const int k : {0, 1})
    d.contrast[k] = std::sqrt(d.contrast[k] / cells), d.middle[k] = std::sqrt(d.middle[k] / middle);
  return d;
}

/// Beams of an image.
enum class Beams { all, middle_half };

/// Returns the correlation of two images, each relative to its mean, `beams` and `cells` apart.
template <typename Number>
double correlation(const Grid<Number>& a, const Grid<Number>& b, const Grid<double>& mean, Eigen::Index beams = 0,
                   Eigen::Index cells = 0, Beams among = Beams::all) {
  double ab = 0, aa = 0, bb = 0;
  const double least = 1e-4 * mean.maxCoeff();
  const Eigen::Index beside = among == Beams::all ? 0 : a.rows() / 4;
  for (Eigen::Index i = beside; i + beams < a.rows() - beside; ++i)
    for (Eigen::Index j = 0; j + cells < a.cols(); ++j) {
      if (mean(i, j) < least || mean(i + beams, j + cells) < least) continue;
      const double x = static_cast<double>(a(i, j)) / mean(i, j) - 1,
                   y = static_cast<double>(b(i + beams, j + cells)) / mean(i + beams, j + cells) - 1;
      ab += x * y, aa += x * x, bb += y * y;
    }
  return ab / std::sqrt(aa * bb);
}

/// Correlation of images before and after a change, over the seeds of each cell.
class Changes {
 public:
  void add(const Grid<double>& before, const Grid<double>& after) {
    if (count_ == 0) a_ = b_ = aa_ = bb_ = ab_ = Grid<double>::Zero(before.rows(), before.cols());
    a_ += before, b_ += after, aa_ += before.square(), bb_ += after.square(), ab_ += before * after, ++count_;
  }
  /// Returns the correlation, each cell relative to its means, over cells within 40 dB of the strongest.
  double correlation(Beams among) const {
    double ab = 0, aa = 0, bb = 0;
    const double least = 1e-4 * a_.maxCoeff();
    const Eigen::Index beside = among == Beams::all ? 0 : a_.rows() / 4;
    for (Eigen::Index i = beside; i < a_.rows() - beside; ++i)
      for (Eigen::Index j = 0; j < a_.cols(); ++j) {
        const double a = a_(i, j), b = b_(i, j);
        if (a < least || b < least) continue;
        ab += count_ * ab_(i, j) / (a * b) - 1, aa += count_ * aa_(i, j) / (a * a) - 1;
        bb += count_ * bb_(i, j) / (b * b) - 1;
      }
    return ab / std::sqrt(aa * bb);
  }

 private:
  double count_ = 0;
  Grid<double> a_, b_, aa_, bb_, ab_;
};

/// Largest distance between the distributions of two samples (Kolmogorov and Smirnov).
inline double largest_distance(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end()), std::sort(b.begin(), b.end());
  double most = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    a[i] <= b[j] ? ++i : ++j;
    most = std::max(most, std::abs(static_cast<double>(i) / static_cast<double>(a.size()) -
                                   static_cast<double>(j) / static_cast<double>(b.size())));
  }
  return most;
}

/// Levels of cells relative to their means, in images `first`, `first` + `step` and so on: those of beams in the middle half
/// within 40 dB of the strongest cell. Beams are so far apart that they are not alike.
inline std::vector<double> relative_levels(const Moments& m, std::size_t first = 0, std::size_t step = 1) {
  constexpr Eigen::Index apart = 8;
  std::vector<double> relative;
  const double least = 1e-4 * m.mean.maxCoeff();
  for (std::size_t k = first; k < m.images.size(); k += step)
    for (Eigen::Index i = m.mean.rows() / 4; i < 3 * m.mean.rows() / 4; i += apart)
      for (Eigen::Index j = 0; j < m.mean.cols(); ++j)
        if (m.mean(i, j) > least) relative.push_back(static_cast<double>(m.images[k](i, j)) / m.mean(i, j));
  return relative;
}

}  // namespace insonify
