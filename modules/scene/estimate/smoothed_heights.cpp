// SPDX-License-Identifier: BSD-3-Clause
#include "scene/estimate/smoothed_heights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "scene/estimate/relief_fit_internal.hpp"
#include "scene/estimate/surfel_cell_internal.hpp"
#include "scene/scene_index.hpp"

// Wide cubics lose the short waves of a surface, narrow ones leave noise on it. Which is the less is seen of points
// that are left out of them (cross-validation): their mean square distance from a cubic is the noise, the same for all,
// and its error. Where that is least, about as much slope is lost of the waves as noise adds, so that the surface is as
// rough as it is.
//
// Steps and objects are no noise. A cubic is fitted again without the neighbours that stand off it (Tukey's weights),
// and is no use where more of them stray than noise explains: then a narrower one is tried, and at last none.
namespace insonify {
namespace {

using namespace cells;

constexpr std::array<std::size_t, 8> widths = {16, 25, 40, 63, 100, 160, 250, 400};  // neighbours of a cubic
constexpr std::size_t of_points = 16;                                                // one is asked
constexpr std::size_t asked_around = 512;                                            // that decide together
constexpr std::size_t blended = 4;                                                   // choices
constexpr double next_narrower = 0.4;                                                // the next cubic that is tried

// In standard deviations of the noise:
constexpr double farthest_move = 2.9;   // move of a point; three if the noise is estimated 3 % too large
constexpr double off_object = 5;        // a point farther off the cubic belongs to something else
constexpr double counted_within = 4.7;  // of the cubic, neighbours count (Tukey: 95 % efficient for a normal law)
constexpr double capped_at = 3;         // what neighbours add to the mean square of what the cubic leaves
// Noise explains a mean square above the variance by so much of it, over the root of the degrees of freedom: four
// standard deviations.
constexpr double misfit_doubt = 6;
constexpr int fits_of_cubic = 3;

using Errors = std::array<float, widths.size()>;  // of each width, over the variance of the noise

/// What its neighbours say of the height of a point.
struct Foretold {
  double rise = 0;      // over the point [m]
  double variance = 0;  // of the rise, over that of the noise
};

/// Fits cubics through the neighbours of points.
class CubicFit {
 public:
  /// Empty if the neighbours do not determine a cubic, or stray from it by more than their noise.
  std::optional<Foretold> operator()(std::span<const Place> places, double noise) {
    if (places.size() <= terms_of<3>) return {};
    set_places(places);
    const double freedom = static_cast<double>(places.size() - terms_of<3>);
    std::optional<Foretold> found;
    for (int n = 0; n < fits_of_cubic; ++n) {
      found = solve();
      if (!found) return {};
      if (n + 1 == fits_of_cubic || (n == 0 && left_.maxCoeff() < counted_within * noise)) break;
      weight_ = (1 - (left_ / (counted_within * std::max(noise, spread()))).square()).max(0).square();
    }
    const double square = left_.min(capped_at * noise).square().sum() / freedom;
    if (!(square < noise * noise * (1 + misfit_doubt / std::sqrt(freedom)))) return {};
    return found;
  }

 private:
  void set_places(std::span<const Place> places) {
    const auto count = static_cast<Eigen::Index>(places.size());
    powers_.resize(terms_of<3>, count);
    rise_.resize(count);
    weight_.setOnes(count);
    double reach = 0;
    for (const Place& p : places) reach = std::max(reach, p.flat.norm());
    for (Eigen::Index n = 0; n < count; ++n) {
      const Place& p = places[static_cast<std::size_t>(n)];
      powers_.col(n) = terms_at<3>(p.flat.x() / reach, p.flat.y() / reach);
      rise_[n] = p.offset.z();
    }
  }

  /// Weighted least squares; sets what is left of the rises.
  std::optional<Foretold> solve() {
    Eigen::Matrix<double, terms_of<3>, terms_of<3>> normal = decltype(normal)::Zero();
    weighted_ = powers_ * weight_.sqrt().matrix().asDiagonal();
    normal.selfadjointView<Eigen::Lower>().rankUpdate(weighted_);
    const Eigen::LDLT<decltype(normal), Eigen::Lower> solver(normal);
    if (!(solver.vectorD().minCoeff() > least_pivot * solver.vectorD().maxCoeff())) return {};
    const Terms<3> cubic = solver.solve(powers_ * (weight_ * rise_).matrix());
    left_ = (rise_.matrix() - powers_.transpose() * cubic).array().abs();
    return Foretold{cubic[0], solver.solve(Terms<3>::Unit(0))[0]};
  }

  /// The standard deviation of what is left, by its median.
  double spread() {
    sorted_.assign(left_.begin(), left_.end());
    const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_.size() / 2);
    std::nth_element(sorted_.begin(), middle, sorted_.end());
    return 1.4826 * *middle;
  }

  Eigen::Matrix<double, terms_of<3>, Eigen::Dynamic> powers_, weighted_;
  Eigen::ArrayXd rise_, weight_, left_;
  std::vector<double> sorted_;
};

class Heights {
 public:
  Heights(std::span<const Vector3f> points, std::span<const float> noise)
      : points_(points), noise_(noise), flat_(plan_of(points)), index_(flat_) {}

  const Vector3f& flat(std::size_t i) const { return flat_[i]; }

  /// The mean square error of cubics at a point, over its variance, of each width: capped, as objects are no error.
  Errors errors_at(std::size_t i, Workspace& work, CubicFit& fit) const {
    look_around(i, widths.back(), work);
    const double noise = noise_[i];
    Errors errors;
    double error = off_object * off_object;
    for (std::size_t w = 0; w < widths.size(); ++w) {
      if (const auto found = fit(nearest(work, widths[w]), noise))
        error = std::min(std::pow(found->rise / noise, 2), off_object * off_object);
      errors[w] = static_cast<float>(error);
    }
    return errors;
  }

  /// How far a point is to be raised onto the cubic of a width, or of a narrower one [m] (E160).
  double rise_at(std::size_t i, std::size_t width, Workspace& work, CubicFit& fit) const {
    look_around(i, width, work);
    const double noise = noise_[i];
    std::optional<Foretold> found = fit(work.places, noise);
    while (!found && width > widths.front()) {
      width = std::max(widths.front(), static_cast<std::size_t>(next_narrower * static_cast<double>(width)));
      found = fit(nearest(work, width), noise);
    }
    if (!found || std::abs(found->rise) > off_object * noise * std::sqrt(1 + found->variance)) return 0;
    return std::clamp(found->rise / (1 + found->variance), -farthest_move * noise, farthest_move * noise);
  }

 private:
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

  static std::span<const Place> nearest(const Workspace& work, std::size_t count) {
    return std::span(work.places).first(std::min(count, work.places.size()));
  }

  std::span<const Vector3f> points_;
  std::span<const float> noise_;
  std::vector<Vector3f> flat_;
  SceneIndex index_;
};

/// How wide cubics should be: asked of some points, each with those around it.
class Widths {
 public:
  Widths(const Heights& heights, const std::vector<std::uint32_t>& asked, int threads)
      : places_(places_of(heights, asked)), index_(places_), log_width_(asked.size()) {
    std::vector<Errors> errors(asked.size());
    parallel_blocks(asked.size(), 128, threads, [&](std::size_t begin, std::size_t end) {
      Workspace work;
      CubicFit fit;
      for (std::size_t a = begin; a < end; ++a) errors[a] = heights.errors_at(asked[a], work, fit);
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
  static std::vector<Vector3f> places_of(const Heights& heights, const std::vector<std::uint32_t>& asked) {
    std::vector<Vector3f> places;
    places.reserve(asked.size());
    for (const std::uint32_t i : asked) places.push_back(heights.flat(i));
    return places;
  }

  std::vector<Vector3f> places_;
  SceneIndex index_;
  std::vector<double> log_width_;
};

}  // namespace

std::vector<float> smoothed_heights(std::span<const Vector3f> points, std::span<const float> noise, int threads) {
  if (noise.size() != points.size())
    fail(ErrorKind::argument, "smoothed_heights: ", noise.size(), " values of noise for ", points.size(),
         " points, must be one each");
  std::vector<float> smooth;
  smooth.reserve(points.size());
  for (const Vector3f& p : points) smooth.push_back(p.z());
  std::vector<std::uint32_t> asked;
  std::uint32_t turn = 0;  // by the golden ratio: spread evenly whatever the length of the rows of a raster
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!(noise[i] > 0)) continue;
    if (turn <= ~0u / of_points) asked.push_back(i);
    turn += 0x9e3779b9u;
  }
  if (asked.empty()) return smooth;
  const Heights heights(points, noise);
  const Widths widths_around(heights, asked, threads);
  parallel_blocks(points.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    Workspace work;
    CubicFit fit;
    for (std::size_t i = begin; i < end; ++i) {
      if (!(noise[i] > 0)) continue;
      const std::size_t width = widths_around.at(heights.flat(i), work.found);
      smooth[i] += static_cast<float>(heights.rise_at(i, width, work, fit));
    }
  });
  return smooth;
}

}  // namespace insonify
