// SPDX-License-Identifier: BSD-3-Clause
#include "scene/polygon_cut.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

// Ears are cut as long as there are any (G. H. Meisters, "Polygons have ears", 1975).
namespace insonify {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double least_area = 1e-7;  // fraction of a polygon's area

/// Returns twice the area of a triangle in the plane, positive if it is counter-clockwise.
double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Plane of a polygon in space, and the distance of the corners from it.
struct PolygonPlane {
  Vector3d normal = Vector3d::Zero();  ///< length: twice the area; loops of opposite sense cancel
  double widest = 0;                   ///< twice the largest area of a triangle with the first corner
  double off = 0;                      ///< greatest distance from the plane through the middle, in diagonals of the box
  Vector3d low, high;                  ///< box of the corners
};

PolygonPlane plane_of(std::span<const Vector3d> corners) {
  PolygonPlane plane;
  plane.low = plane.high = corners[0];
  Vector3d middle = Vector3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3d cross = (corners[i] - corners[0]).cross(corners[(i + 1) % corners.size()] - corners[0]);
    plane.normal += cross, plane.widest = std::max(plane.widest, cross.norm());
    middle += corners[i] / static_cast<double>(corners.size());
    plane.low = plane.low.cwiseMin(corners[i]), plane.high = plane.high.cwiseMax(corners[i]);
  }
  for (const Vector3d& p : corners) plane.off = std::max(plane.off, std::abs((p - middle).dot(plane.normal)));
  plane.off /= plane.normal.norm() * (plane.high - plane.low).norm();
  return plane;
}

/// The corners of a polygon in its plane, counter-clockwise.
class FlatPolygon {
 public:
  /// Drops the axis along which the plane is steepest.
  FlatPolygon(std::span<const Vector3d> corners, const PolygonPlane& plane, std::size_t& tests_left)
      : tests_left_(tests_left) {
    Eigen::Index axis = 0;
    area2_ = plane.normal.cwiseAbs().maxCoeff(&axis);
    const Eigen::Index u = (axis + (plane.normal[axis] < 0 ? 2 : 1)) % 3, v = 3 - axis - u;
    low_ = {plane.low[u], plane.low[v]}, size_ = Vector2d(plane.high[u], plane.high[v]) - low_;
    for (const Vector3d& p : corners) at_.emplace_back(p[u], p[v]);
  }

  /// Returns true if the fan of triangles from the first corner covers the polygon once.
  bool is_fan() const {
    double folded = 0;
    for (std::size_t i = 1; i + 1 < at_.size(); ++i) {
      folded -= std::min(0.0, turn(at_[0], at_[i], at_[i + 1]));
      if (turn(at_[0], at_[1], at_[i + 1]) < -least_area * area2_) return false;
    }
    return folded <= least_area * area2_;
  }

  /// Returns true if two edges cross, beyond rounding. Edges are compared with those that begin within them along the
  /// axis on which edges are shorter.
  bool crosses() {
    const int n = static_cast<int>(at_.size());
    Vector2d travel = Vector2d::Zero();
    for (int i = 0; i < n; ++i) travel += (at_[(i + 1) % n] - at_[i]).cwiseAbs().cwiseQuotient(size_);
    const int axis = travel.x() <= travel.y() ? 0 : 1;
    const auto low = [&](int i) { return std::min(at_[i][axis], at_[(i + 1) % n][axis]); };
    order_.resize(at_.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [&](int i, int j) { return low(i) < low(j); });
    for (auto edge = order_.begin(); edge != order_.end(); ++edge) {
      const double high = std::max(at_[*edge][axis], at_[(*edge + 1) % n][axis]);
      for (auto other = edge + 1; other != order_.end() && low(*other) <= high; ++other)
        if (tests_left_ == 0 || --tests_left_ == 0 || edges_cross(*edge, *other)) return true;
    }
    return false;
  }

  /// Sets `ears` to triangles that cover the polygon, small ones first. Returns false if there are none.
  bool cut(std::vector<std::array<int, 3>>& ears) {
    fill_grid();
    const int n = static_cast<int>(at_.size());
    next_.resize(at_.size()), last_.resize(at_.size()), left_.assign(at_.size(), true);
    for (int i = 0; i < n; ++i) next_[i] = (i + 1) % n, last_[i] = (i + n - 1) % n;
    ears.clear();
    const double whole = size_.norm();
    double reach = whole / side_;  // largest extent of ears that are cut
    int i = 0;
    for (int left = n, passed = 0; left > 3;) {
      if (is_ear(i, reach, reach > whole)) {
        ears.push_back({last_[i], i, next_[i]});
        next_[last_[i]] = next_[i], last_[next_[i]] = last_[i];
        left_[i] = false, reach = std::min(reach, whole);
        --left, passed = 0;
        i = next_[next_[i]];
      } else if (i = next_[i]; ++passed > left) {
        if (reach > whole || tests_left_ == 0) return false;
        reach = reach < whole ? std::min(2 * reach, whole) : 2 * whole, passed = 0;
      }
    }
    ears.push_back({last_[i], i, next_[i]});
    return turn(at_[last_[i]], at_[i], at_[next_[i]]) >= -least_area * area2_;
  }

 private:
  bool edges_cross(int i, int j) const {
    const std::size_t n = at_.size();
    const Vector2d &a = at_[i], &b = at_[(i + 1) % n], &c = at_[j], &d = at_[(j + 1) % n];
    const auto apart = [&](double one, double other) {
      return std::min(one, other) < -least_area * area2_ && std::max(one, other) > least_area * area2_;
    };
    return apart(turn(a, b, c), turn(a, b, d)) && apart(turn(c, d, a), turn(c, d, b));
  }

  /// Returns the cell of a point in a grid of as many cells as there are corners.
  Eigen::Vector2i cell_of(const Vector2d& p) const {
    return ((p - low_).cwiseQuotient(size_) * side_).cast<int>().cwiseMin(side_ - 1);
  }

  /// Sorts the corners by their cells.
  void fill_grid() {
    side_ = static_cast<int>(std::sqrt(static_cast<double>(at_.size())));
    const auto cell = [&](int i) { return cell_of(at_[i]).dot(Eigen::Vector2i(1, side_)); };
    order_.resize(at_.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [&](int i, int j) { return cell(i) < cell(j); });
    begin_.assign(static_cast<std::size_t>(side_ * side_) + 1, 0);
    for (const int i : order_) ++begin_[cell(i) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  }

  /// Returns true if corner i and its neighbours, at most `reach` apart, make a triangle that holds no other corner. If
  /// `touching`, other corners may lie on its edges. A triangle without area is an ear.
  bool is_ear(int i, double reach, bool touching) {
    const Vector2d &a = at_[last_[i]], &b = at_[i], &c = at_[next_[i]];
    if ((c - a).norm() > reach) return false;
    const double area2 = turn(a, b, c);
    if (std::abs(area2) <= 1e-14 * area2_) return true;
    if (area2 < 0 || tests_left_ == 0) return false;
    const auto is_inside = [&](int other) {
      const Vector2d& p = at_[other];
      if (!left_[other] || p == a || p == b || p == c) return false;
      const double inside = std::min({turn(a, b, p), turn(b, c, p), turn(c, a, p)});
      return touching ? inside > least_area * area2 : inside >= 0;
    };
    const int last_row = cell_of(a.cwiseMax(b).cwiseMax(c)).y();
    for (int row = cell_of(a.cwiseMin(b).cwiseMin(c)).y(); row <= last_row; ++row) {
      const auto [from, to] = cells_in_row(row, {a, b, c});
      const auto first = order_.begin() + begin_[from], end = order_.begin() + begin_[to + 1];
      tests_left_ -= std::min(tests_left_, static_cast<std::size_t>(end - first) + 1);
      if (std::any_of(first, end, is_inside)) return false;
    }
    return true;
  }

  /// Returns the first and the last cell of a row that a triangle touches.
  std::array<int, 2> cells_in_row(int row, const std::array<Vector2d, 3>& corners) const {
    constexpr double margin = 1e-6;  // fraction of a cell
    const double height = size_.y() / side_, low = low_.y() + (row - margin) * height,
                 high = low + (1 + 2 * margin) * height;
    Vector2d from(size_ + low_), to(low_);
    for (const int k : {0, 1, 2}) {
      const Vector2d &p = corners[k], &q = corners[(k + 1) % 3];
      if (std::max(p.y(), q.y()) < low || std::min(p.y(), q.y()) > high) continue;
      for (const double y : {low, high}) {
        const double share = p.y() == q.y() ? y == high : std::clamp((y - p.y()) / (q.y() - p.y()), 0.0, 1.0);
        const Vector2d at = p + share * (q - p);
        from = from.cwiseMin(at), to = to.cwiseMax(at);
      }
    }
    const Vector2d reach = margin / side_ * size_;
    return {row * side_ + cell_of((from - reach).cwiseMax(low_)).x(), row * side_ + cell_of(to + reach).x()};
  }

  std::size_t& tests_left_;
  std::vector<Vector2d> at_;
  Vector2d low_, size_;  // corner and size of the box of all corners
  double area2_ = 0;     // twice the area
  int side_ = 0;         // width of the grid [cells]
  std::vector<int> order_, begin_, next_, last_;
  std::vector<char> left_;
};

}  // namespace

PolygonCut cut_polygon(std::span<const Vector3d> corners, std::size_t& tests_left) {
  const PolygonPlane plane = plane_of(corners);
  PolygonCut result;
  if (!plane.normal.allFinite() || plane.widest == 0) return result;
  result.crosses = plane.normal.norm() <= least_area * plane.widest;
  if (result.crosses) return result;
  result.off_plane = plane.off;
  FlatPolygon flat(corners, plane, tests_left);
  if (flat.is_fan()) return result;
  result.crosses = flat.crosses() || !flat.cut(result.ears);
  if (result.crosses) result.ears.clear();
  return result;
}

}  // namespace insonify
