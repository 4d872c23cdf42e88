// SPDX-License-Identifier: BSD-3-Clause
#include "scene/estimate/smoothed_heights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "scene/estimate/relief_fit_internal.hpp"
#include "scene/estimate/surfel_cell_internal.hpp"
#include "scene/scene_index.hpp"

// Wide cubics lose the short waves of a surface, narrow ones leave noise on it. Which is the less is seen of points
// that are left out of them (cross-validation): their mean square distance from a cubic is the noise, the same for all,
// and its error. Where that is least, about as much slope is lost of the waves as noise adds, so that the surface is as
// rough as it is.
namespace insonify {
namespace {

using namespace cells;

constexpr std::array<std::size_t, 8> widths = {16, 25, 40, 63, 100, 160, 250, 400};  // neighbours of a cubic
constexpr std::size_t of_points = 16;                                                // one is asked
constexpr std::size_t asked_around = 256;                                            // that decide together
constexpr std::size_t blended = 4;                                                   // choices

using Errors = std::array<float, widths.size()>;  // [m^2], of each width

class Cubics {
 public:
  explicit Cubics(std::span<const Vector3f> points) : points_(points), flat_(plan_of(points)), index_(flat_) {}

  const Vector3f& flat(std::size_t i) const { return flat_[i]; }

  /// The neighbours of a point, nearest first.
  void look_around(std::size_t i, std::size_t count, Workspace& work) const {
    index_.find_nearest(flat_[i], count + 1, work.found);
    work.places.clear();
    for (const Neighbour& n : work.found)
      if (n.index != i) {
        const Vector3d offset = (points_[n.index] - points_[i]).cast<double>();
        work.places.push_back({offset.head<2>(), offset});
      }
  }

  /// Squares of the distances of a point from cubics through so many others.
  Errors errors_at(std::size_t i, Workspace& work) const {
    look_around(i, widths.back(), work);
    Errors errors;
    errors.fill(std::numeric_limits<float>::infinity());
    for (std::size_t w = 0; w < widths.size(); ++w) {
      const std::size_t count = std::min(widths[w], work.places.size());
      const ReliefFit fit = fit_relief<3>(std::span(work.places).first(count), Vector3d::UnitZ());
      if (fit.found) errors[w] = static_cast<float>(std::pow(fit.rise / (1 - fit.leverage), 2));
    }
    return errors;
  }

 private:
  std::span<const Vector3f> points_;
  std::vector<Vector3f> flat_;
  SceneIndex index_;
};

/// How wide cubics should be: asked of some points, each with those around it.
class Widths {
 public:
  Widths(const Cubics& cubics, const std::vector<std::uint32_t>& asked, int threads)
      : places_(places_of(cubics, asked)), index_(places_), log_width_(asked.size()) {
    std::vector<Errors> errors(asked.size());
    parallel_blocks(asked.size(), 128, threads, [&](std::size_t begin, std::size_t end) {
      Workspace work;
      for (std::size_t a = begin; a < end; ++a) errors[a] = cubics.errors_at(asked[a], work);
    });
    parallel_blocks(asked.size(), 128, threads, [&](std::size_t begin, std::size_t end) {
      std::vector<Neighbour> found;
      for (std::size_t a = begin; a < end; ++a) {
        index_.find_nearest(places_[a], asked_around, found);
        std::array<double, widths.size()> sum{};
        for (const Neighbour& n : found)
          for (std::size_t w = 0; w < widths.size(); ++w) sum[w] += errors[n.index][w];
        const auto best = std::min_element(sum.begin(), sum.end()) - sum.begin();
        log_width_[a] = std::log(static_cast<double>(widths[static_cast<std::size_t>(best)]));
      }
    });
  }

  std::size_t at(const Vector3f& place, std::vector<Neighbour>& found) const {
    index_.find_nearest(place, blended, found);
    double sum = 0;
    for (const Neighbour& n : found) sum += log_width_[n.index];
    return static_cast<std::size_t>(std::exp(sum / static_cast<double>(found.size())));
  }

 private:
  static std::vector<Vector3f> places_of(const Cubics& cubics, const std::vector<std::uint32_t>& asked) {
    std::vector<Vector3f> places;
    places.reserve(asked.size());
    for (const std::uint32_t i : asked) places.push_back(cubics.flat(i));
    return places;
  }

  std::vector<Vector3f> places_;
  SceneIndex index_;
  std::vector<double> log_width_;
};

}  // namespace

std::vector<float> smoothed_heights(std::span<const Vector3f> points, std::span<const std::uint8_t> noisy,
                                    int threads) {
  std::vector<float> heights;
  heights.reserve(points.size());
  for (const Vector3f& p : points) heights.push_back(p.z());
  std::vector<std::uint32_t> asked;
  std::uint32_t turn = 0;  // by the golden ratio: spread evenly whatever the length of the rows of a raster
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!noisy[i]) continue;
    if (turn <= ~0u / of_points) asked.push_back(i);
    turn += 0x9e3779b9u;
  }
  if (asked.empty()) return heights;
  const Cubics cubics(points);
  const Widths widths_around(cubics, asked, threads);
  parallel_blocks(points.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    Workspace work;
    for (std::size_t i = begin; i < end; ++i) {
      if (!noisy[i]) continue;
      cubics.look_around(i, widths_around.at(cubics.flat(i), work.found), work);
      const ReliefFit fit = fit_relief<3>(work.places, Vector3d::UnitZ());
      if (fit.found) heights[i] += static_cast<float>(fit.rise);
    }
  });
  return heights;
}

}  // namespace insonify
