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

// Wide cubics lose the short waves of a surface; narrow ones leave noise on it. The width is chosen by
// cross-validation: the mean square distance of points from cubics fitted without them is the noise, equal for all
// widths, plus the error of the cubic. Where the sum is least, waves lose about as much slope as noise adds, and the
// surface is as rough as the true one.
//
// Steps and objects are not noise. A cubic is fitted again without the neighbours that stand off it (Tukey's weights).
// It is rejected where more of them stray than noise explains; then narrower ones are tried.
namespace insonify {
namespace {

using namespace cells;

constexpr std::array<std::size_t, 8> widths = {16, 25, 40, 63, 100, 160, 250, 400};  // neighbours of a cubic
constexpr std::size_t of_points = 16;                                                // points per tried point
constexpr std::size_t tried_around = 512;                                            // tried points that share a choice
constexpr std::size_t blended = 4;                                                   // choices averaged at a point
constexpr double next_narrower = 0.4;                                                // next width over a rejected one

// Limits in standard deviations of the noise:
constexpr double farthest_move = 2.9;   // move of a point; three if the noise is estimated 3 % too large
constexpr double off_object = 5;        // distance from the cubic beyond which a point belongs to an object
constexpr double counted_within = 4.7;  // largest residual that counts (Tukey: 95 % efficient for a normal law)
constexpr double capped_at = 3;         // largest residual of a neighbour that the mean square counts
// Noise explains a mean square residual up to 1 + misfit_doubt / sqrt(degrees of freedom) variances, which is four
// standard deviations.
constexpr double misfit_doubt = 6;
constexpr int fits_of_cubic = 3;

using Errors = std::array<float, widths.size()>;  // by width, over the variance of the noise

/// Height of a point as its neighbours predict it.
struct Prediction {
  double rise = 0;      // rise over the point [m]
  double variance = 0;  // variance of the rise, over that of the noise
};

/// Fits cubics through the neighbours of points.
class CubicFit {
 public:
  /// Returns nothing if the neighbours do not determine a cubic, or stray from it by more than their noise.
  std::optional<Prediction> operator()(std::span<const FlatNeighbour> neighbours, double noise) {
    if (neighbours.size() <= terms_of<3>) return {};
    set_neighbours(neighbours);
    const double freedom = static_cast<double>(neighbours.size() - terms_of<3>);
    std::optional<Prediction> found;
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
  void set_neighbours(std::span<const FlatNeighbour> neighbours) {
    const auto count = static_cast<Eigen::Index>(neighbours.size());
    power_.resize(count, terms_of<3>);
    rise_.resize(count);
    weight_.setOnes(count);
    double square = 0;
    for (const FlatNeighbour& p : neighbours) square = std::max(square, p.flat.squaredNorm());
    const double per_reach = 1 / std::sqrt(square);
    power_.col(0).setOnes();
    for (Eigen::Index n = 0; n < count; ++n) {
      const FlatNeighbour& p = neighbours[static_cast<std::size_t>(n)];
      power_.block<1, 2>(n, 1) = p.flat.transpose() * per_reach;
      rise_[n] = p.offset.z();
    }
    // Build the terms of terms_at: x times each term of one degree less, then y times the last of these.
    for (int degree = 2, t = 3; degree <= 3; t += ++degree) {
      for (int k = 0; k < degree; ++k) power_.col(t + k) = power_.col(1) * power_.col(t - degree + k);
      power_.col(t + degree) = power_.col(2) * power_.col(t - 1);
    }
  }

  /// Solves the weighted least squares and sets the residuals. The products of two terms are powers, many of them
  /// equal; their sums are computed once.
  std::optional<Prediction> solve() {
    weighted_ = power_.colwise() * weight_;
    std::array<std::array<double, 7>, 7> moment{};  // sums of x^i y^j
    for (std::size_t t = 0; t < terms_of<3>; ++t) {
      const auto [i, j] = exponents[t];
      moment[i][j] = weighted_.col(static_cast<Eigen::Index>(t)).sum();
    }
    // Powers beyond the third are a term of degree 3 (from number 6 on) times one of degree `rest`.
    for (std::size_t rest = 1; rest <= 3; ++rest)
      for (std::size_t j = 0; j <= rest + 3; ++j) {
        const std::size_t in_first = std::min<std::size_t>(j, 3);  // power of y
        const auto first = static_cast<Eigen::Index>(6 + in_first);
        const auto second = static_cast<Eigen::Index>(rest * (rest + 1) / 2 + j - in_first);
        moment[rest + 3 - j][j] = weighted_.col(first).matrix().dot(power_.col(second).matrix());
      }
    Eigen::Matrix<double, terms_of<3>, terms_of<3>> normal;
    for (std::size_t a = 0; a < terms_of<3>; ++a)
      for (std::size_t b = 0; b <= a; ++b)
        normal(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) =
            moment[exponents[a][0] + exponents[b][0]][exponents[a][1] + exponents[b][1]];
    const Eigen::LDLT<decltype(normal), Eigen::Lower> solver(normal);
    if (!(solver.vectorD().minCoeff() > least_pivot * solver.vectorD().maxCoeff())) return {};
    const Terms<3> cubic = solver.solve(Terms<3>(weighted_.matrix().transpose() * rise_.matrix()));
    left_ = (rise_.matrix() - power_.matrix() * cubic).array().abs();
    return Prediction{cubic[0], solver.solve(Terms<3>::Unit(0))[0]};
  }

  /// Returns the standard deviation of the residuals, estimated by their median.
  double spread() {
    sorted_.assign(left_.begin(), left_.end());
    const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_.size() / 2);
    std::nth_element(sorted_.begin(), middle, sorted_.end());
    return 1.4826 * *middle;
  }

  static constexpr std::array<std::array<std::size_t, 2>, terms_of<3>> exponents = {
      {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}}};  // powers of x, y of each term
  Eigen::Array<double, Eigen::Dynamic, terms_of<3>> power_, weighted_;                    // one row for each neighbour
  Eigen::ArrayXd rise_, weight_, left_;
  std::vector<double> sorted_;
};

/// A search for neighbours that begins with the last radius: far from a border it rarely finds too few.
class Neighbourhood {
 public:
  Neighbourhood(std::span<const Vector3f> points, std::span<const Vector3f> flat, const SceneIndex& index)
      : points_(points), flat_(flat), index_(index) {}

  /// Returns the `count` neighbours nearest to a point, or all others. Equal distances sort by index. Unordered unless
  /// `sorted`.
  std::span<const FlatNeighbour> look_around(std::size_t i, std::size_t count, bool sorted = false) {
    const std::size_t wanted = std::min(count + 1, flat_.size());
    auto radius = static_cast<float>(1.02 * std::sqrt(area_per_point_ * static_cast<double>(wanted)));
    index_.find_within(flat_[i], radius, found_);
    for (int n = 0; n < widenings && radius > 0 && found_.size() < wanted; ++n)
      index_.find_within(flat_[i], radius *= 1.15F, found_);
    if (found_.size() < wanted) index_.find_nearest(flat_[i], wanted, found_);
    const auto before = [](const Neighbour& a, const Neighbour& b) {
      return a.squared_distance < b.squared_distance || (a.squared_distance == b.squared_distance && a.index < b.index);
    };
    const auto last = found_.begin() + static_cast<std::ptrdiff_t>(wanted) - 1;
    std::nth_element(found_.begin(), last, found_.end(), before);
    if (sorted) std::sort(found_.begin(), last, before);
    area_per_point_ = last->squared_distance / static_cast<double>(wanted);
    positions_.clear();
    for (auto n = found_.begin(); n <= last; ++n)
      if (n->index != i) {
        const Vector3d offset = (points_[n->index] - points_[i]).cast<double>();
        positions_.push_back({offset.head<2>(), offset});
      }
    return positions_;
  }

 private:
  static constexpr int widenings = 8;
  std::span<const Vector3f> points_, flat_;
  const SceneIndex& index_;
  double area_per_point_ = 0;  // area per point over pi
  std::vector<Neighbour> found_;
  std::vector<FlatNeighbour> positions_;
};

class Heights {
 public:
  Heights(std::span<const Vector3f> points, std::span<const float> noise)
      : points_(points), noise_(noise), flat_(plan_of(points)), index_(flat_) {}

  const Vector3f& flat(std::size_t i) const { return flat_[i]; }
  Neighbourhood neighbourhood() const { return {points_, flat_, index_}; }

  /// Returns the mean square error of each width at a point, over the noise variance. It is capped: objects are not
  /// errors.
  Errors errors_at(std::size_t i, Neighbourhood& near, CubicFit& fit) const {
    const std::span<const FlatNeighbour> neighbours = near.look_around(i, widths.back(), true);
    const double noise = noise_[i];
    Errors errors;
    double error = off_object * off_object;
    for (std::size_t w = 0; w < widths.size(); ++w) {
      if (const auto found = fit(neighbours.first(std::min(widths[w], neighbours.size())), noise))
        error = std::min(std::pow(found->rise / noise, 2), off_object * off_object);
      errors[w] = static_cast<float>(error);
    }
    return errors;
  }

  /// Returns the move of a point onto the cubic of a width, or onto a narrower one [m] (E160).
  double rise_at(std::size_t i, std::size_t width, Neighbourhood& near, CubicFit& fit) const {
    const double noise = noise_[i];
    std::optional<Prediction> found = fit(near.look_around(i, width), noise);
    while (!found && width > widths.front()) {
      width = std::max(widths.front(), static_cast<std::size_t>(next_narrower * static_cast<double>(width)));
      found = fit(near.look_around(i, width), noise);
    }
    if (!found || std::abs(found->rise) > off_object * noise * std::sqrt(1 + found->variance)) return 0;
    return std::clamp(found->rise / (1 + found->variance), -farthest_move * noise, farthest_move * noise);
  }

 private:
  std::span<const Vector3f> points_;
  std::span<const float> noise_;
  std::vector<Vector3f> flat_;
  SceneIndex index_;
};

/// Best widths of cubics, chosen at some of the points, each with those around it.
class Widths {
 public:
  Widths(const Heights& heights, const std::vector<std::uint32_t>& tried, int threads)
      : positions_(positions_of(heights, tried)), index_(positions_), log_width_(tried.size()) {
    std::vector<Errors> errors(tried.size());
    parallel_blocks(tried.size(), 128, threads, [&](std::size_t begin, std::size_t end) {
      Neighbourhood near = heights.neighbourhood();
      CubicFit fit;
      for (std::size_t a = begin; a < end; ++a) errors[a] = heights.errors_at(tried[a], near, fit);
    });
    parallel_blocks(tried.size(), 128, threads, [&](std::size_t begin, std::size_t end) {
      std::vector<Neighbour> found;
      for (std::size_t a = begin; a < end; ++a) {
        index_.find_nearest(positions_[a], tried_around, found);
        std::array<double, widths.size()> sum{};
        for (const Neighbour& n : found)
          for (std::size_t w = 0; w < widths.size(); ++w) sum[w] += errors[n.index][w];
        const auto best = std::min_element(sum.begin(), sum.end()) - sum.begin();
        log_width_[a] = std::log(static_cast<double>(widths[static_cast<std::size_t>(best)]));
      }
    });
  }

  std::size_t at(const Vector3f& position, std::vector<Neighbour>& found) const {
    index_.find_nearest(position, blended, found);
    double sum = 0;
    for (const Neighbour& n : found) sum += log_width_[n.index];
    return static_cast<std::size_t>(std::exp(sum / static_cast<double>(found.size())));
  }

 private:
  static std::vector<Vector3f> positions_of(const Heights& heights, const std::vector<std::uint32_t>& tried) {
    std::vector<Vector3f> neighbours;
    neighbours.reserve(tried.size());
    for (const std::uint32_t i : tried) neighbours.push_back(heights.flat(i));
    return neighbours;
  }

  std::vector<Vector3f> positions_;
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
  std::vector<std::uint32_t> tried;
  std::uint32_t turn = 0;  // steps by the golden ratio, which spread evenly whatever the row length of a raster
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!(noise[i] > 0)) continue;
    if (turn <= ~0u / of_points) tried.push_back(i);
    turn += 0x9e3779b9u;
  }
  if (tried.empty()) return smooth;
  const Heights heights(points, noise);
  const Widths widths_around(heights, tried, threads);
  parallel_blocks(points.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    Neighbourhood near = heights.neighbourhood();
    CubicFit fit;
    std::vector<Neighbour> tried_near;
    for (std::size_t i = begin; i < end; ++i) {
      if (!(noise[i] > 0)) continue;
      const std::size_t width = widths_around.at(heights.flat(i), tried_near);
      smooth[i] += static_cast<float>(heights.rise_at(i, width, near, fit));
    }
  });
  return smooth;
}

}  // namespace insonify
