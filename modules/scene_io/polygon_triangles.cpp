// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "core/text.hpp"
#include "scene_io/raw_cloud_internal.hpp"

// Polygons become triangles by cutting ears (G. H. Meisters, "Polygons have ears", 1975). The polygon cutters of VTK and
// PCL take time that grows as the square or the cube of the number of corners, and do not say that edges cross.
namespace insonify {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double most_off_plane = 0.01;      // of the size of a polygon
constexpr double rounding = 1e-7;            // of the area of a polygon
constexpr std::size_t most_tests = 1 << 28;  // of corners and edges, for all polygons of a file

/// Twice the area of a triangle in the plane, positive if it is counter-clockwise.
double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// One polygon after another: its corners in a plane, counter-clockwise, and the triangles between them.
class PolygonCutter {
 public:
  std::vector<Vector3d> corner;
  std::vector<std::array<int, 3>> triangle;
  std::size_t tests = 0;  ///< that were made

  /// Drops the axis along which the plane is steepest. Returns the greatest distance of a corner from its plane, as a
  /// part of the polygon's size; NaN if a corner is not finite or all are on one line.
  double flatten() {
    Vector3d normal = Vector3d::Zero(), middle = Vector3d::Zero(), low = corner[0], high = corner[0];
    for (std::size_t i = 0; i < corner.size(); ++i) {
      const Vector3d& next = corner[(i + 1) % corner.size()];
      normal += (corner[i] - corner[0]).cross(next - corner[0]);
      middle += corner[i] / static_cast<double>(corner.size());
      low = low.cwiseMin(corner[i]), high = high.cwiseMax(corner[i]);
    }
    Eigen::Index axis = 0;
    area2_ = normal.cwiseAbs().maxCoeff(&axis);
    const Eigen::Index u = (axis + (normal[axis] < 0 ? 2 : 1)) % 3, v = 3 - axis - u;
    double off = 0;
    low_ = {low[u], low[v]}, size_ = {high[u] - low[u], high[v] - low[v]};
    at_.clear();
    for (const Vector3d& p : corner) {
      at_.emplace_back(p[u], p[v]);
      off = std::max(off, std::abs((p - middle).dot(normal)));
    }
    return middle.allFinite() && area2_ > 0 ? off / (normal.norm() * (high - low).norm()) : std::nan("");
  }

  /// Whether the fan of triangles from the first corner covers the polygon once.
  bool is_fan() const {
    double folded = 0;
    for (std::size_t i = 1; i + 1 < at_.size(); ++i) {
      folded -= std::min(0.0, turn(at_[0], at_[i], at_[i + 1]));
      if (turn(at_[0], at_[1], at_[i + 1]) < -rounding * area2_) return false;
    }
    return folded <= rounding * area2_;
  }

  /// Whether two edges cross, beyond rounding. Edges are compared with those that begin within them along the axis on
  /// which edges are shorter.
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
        if (++tests > most_tests || edges_cross(*edge, *other)) return true;
    }
    return false;
  }

  /// Sets `triangle` to ears that cover the polygon, small ones first. Returns false if there are none.
  bool cut() {
    fill_grid();
    const int n = static_cast<int>(at_.size());
    next_.resize(at_.size()), last_.resize(at_.size()), left_.assign(at_.size(), true);
    for (int i = 0; i < n; ++i) next_[i] = (i + 1) % n, last_[i] = (i + n - 1) % n;
    triangle.clear();
    const double whole = size_.norm();
    double reach = whole / side_;  // of ears that are cut
    int i = 0;
    for (int left = n, passed = 0; left > 3;) {
      if (is_ear(i, reach, reach > whole)) {
        triangle.push_back({last_[i], i, next_[i]});
        next_[last_[i]] = next_[i], last_[next_[i]] = last_[i];
        left_[i] = false, reach = std::min(reach, whole);
        --left, passed = 0;
        i = next_[next_[i]];
      } else if (i = next_[i]; ++passed > left) {
        if (reach > whole || tests > most_tests) return false;
        reach = reach < whole ? std::min(2 * reach, whole) : 2 * whole, passed = 0;
      }
    }
    triangle.push_back({last_[i], i, next_[i]});
    return turn(at_[last_[i]], at_[i], at_[next_[i]]) >= -rounding * area2_;
  }

 private:
  bool edges_cross(int i, int j) const {
    const std::size_t n = at_.size();
    const Vector2d &a = at_[i], &b = at_[(i + 1) % n], &c = at_[j], &d = at_[(j + 1) % n];
    const auto apart = [&](double one, double other) {
      return std::min(one, other) < -rounding * area2_ && std::max(one, other) > rounding * area2_;
    };
    return apart(turn(a, b, c), turn(a, b, d)) && apart(turn(c, d, a), turn(c, d, b));
  }

  /// The cell of a point in a grid of as many cells as there are corners.
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

  /// Whether corner i and its neighbours, at most `reach` apart, make a triangle that holds no other corner; with
  /// `touching` other corners may lie on its edges. A triangle without area is an ear.
  bool is_ear(int i, double reach, bool touching) {
    const Vector2d &a = at_[last_[i]], &b = at_[i], &c = at_[next_[i]];
    if ((c - a).norm() > reach) return false;
    const double area2 = turn(a, b, c);
    if (std::abs(area2) <= 1e-14 * area2_) return true;
    if (area2 < 0 || tests > most_tests) return false;
    const auto is_inside = [&](int other) {
      const Vector2d& p = at_[other];
      if (!left_[other] || p == a || p == b || p == c) return false;
      const double inside = std::min({turn(a, b, p), turn(b, c, p), turn(c, a, p)});
      return touching ? inside > rounding * area2 : inside >= 0;
    };
    const int last_row = cell_of(a.cwiseMax(b).cwiseMax(c)).y();
    for (int row = cell_of(a.cwiseMin(b).cwiseMin(c)).y(); row <= last_row; ++row) {
      const auto [from, to] = cells_in_row(row, {a, b, c});
      const auto first = order_.begin() + begin_[from], end = order_.begin() + begin_[to + 1];
      tests += static_cast<std::size_t>(end - first) + 1;
      if (std::any_of(first, end, is_inside)) return false;
    }
    return true;
  }

  /// The first and the last cell of a row that a triangle touches.
  std::array<int, 2> cells_in_row(int row, const std::array<Vector2d, 3>& corners) const {
    constexpr double margin = 1e-6;  // of a cell
    const double height = size_.y() / side_, low = low_.y() + (row - margin) * height,
                 high = low + (1 + 2 * margin) * height;
    Vector2d from(size_ + low_), to(low_);
    for (const int k : {0, 1, 2}) {
      const Vector2d &p = corners[k], &q = corners[(k + 1) % 3];
      if (std::max(p.y(), q.y()) < low || std::min(p.y(), q.y()) > high) continue;
      for (const double y : {low, high}) {
        const double part = p.y() == q.y() ? y == high : std::clamp((y - p.y()) / (q.y() - p.y()), 0.0, 1.0);
        const Vector2d at = p + part * (q - p);
        from = from.cwiseMin(at), to = to.cwiseMax(at);
      }
    }
    const Vector2d reach = margin / side_ * size_;
    return {row * side_ + cell_of((from - reach).cwiseMax(low_)).x(), row * side_ + cell_of(to + reach).x()};
  }

  std::vector<Vector2d> at_;
  Vector2d low_, size_;  // of the box round the corners
  double area2_ = 0;     // twice the area
  int side_ = 0;         // of the grid [cells]
  std::vector<int> order_, begin_, next_, last_;
  std::vector<char> left_;
};

/// Polygons with one defect.
struct DefectivePolygons {
  std::size_t count = 0;
  Vector3d first = Vector3d::Zero();

  void add(const RawCloud& raw, const Vector3d& corner) {
    if (++count == 1) first = raw.origin + corner;
  }
  void note(RawCloud& raw, const std::string& what) const {
    if (count == 0) return;
    raw.notes.push_back(std::to_string(count) + (count == 1 ? " polygon " : " polygons ") + what +
                        printed(", the first at (%.2f, %.2f, %.2f) m", first.x(), first.y(), first.z()) +
                        ": triangulate the mesh in the program that made it");
  }
};

}  // namespace

void add_polygon(RawCloud& raw, const std::vector<std::int64_t>& corners, std::size_t vertices) {
  ++raw.triangles_in_file;
  const bool good = corners.size() >= 3 && std::all_of(corners.begin(), corners.end(), [&](std::int64_t c) {
                      return c >= 0 && static_cast<std::size_t>(c) < vertices;
                    });
  if (!good) {
    ++raw.bad_triangles;
    return;
  }
  raw.triangles_in_file += corners.size() - 3;
  if (corners.size() > 3) raw.polygon.push_back({raw.triangle.size(), corners.size() - 2});
  for (std::size_t i = 2; i < corners.size(); ++i)
    raw.triangle.push_back({static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[i - 1]),
                            static_cast<std::uint32_t>(corners[i])});
}

void add_strip(RawCloud& raw, const std::vector<std::int64_t>& corners, std::size_t vertices) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] == -1) begin = i + 1;
    if (i < begin + 2) continue;
    const std::int64_t a = corners[i - 2], b = corners[i - 1], c = corners[i];
    if (a == b || b == c || c == a) continue;
    (i - begin) % 2 == 0 ? add_polygon(raw, {a, b, c}, vertices) : add_polygon(raw, {a, c, b}, vertices);
  }
}

void cut_polygons(RawCloud& raw) {
  PolygonCutter cutter;
  DefectivePolygons bent, crossed;
  for (const auto& [first, triangles] : raw.polygon) {
    const auto fan = raw.triangle.begin() + static_cast<std::ptrdiff_t>(first);
    std::vector<std::uint32_t> ids = {fan[0][0], fan[0][1]};
    for (std::size_t i = 0; i < triangles; ++i) ids.push_back(fan[static_cast<std::ptrdiff_t>(i)][2]);
    cutter.corner.clear();
    for (const std::uint32_t id : ids) cutter.corner.push_back(raw.point[id].cast<double>());
    const double off = cutter.flatten();
    if (off > most_off_plane) bent.add(raw, cutter.corner[0]);
    if (std::isnan(off) || cutter.is_fan()) continue;
    const bool cut = !cutter.crosses() && cutter.cut();
    if (cutter.tests > most_tests)
      fail(ErrorKind::content, raw.path, ": a polygon of ", ids.size(),
           " corners takes too long to cut into triangles; triangulate the mesh in the program that made it");
    if (!cut)
      crossed.add(raw, cutter.corner[0]);
    else
      std::transform(cutter.triangle.begin(), cutter.triangle.end(), fan, [&](const std::array<int, 3>& t) {
        return std::array<std::uint32_t, 3>{ids[t[0]], ids[t[1]], ids[t[2]]};
      });
  }
  bent.note(raw, "with corners off the plane by more than 1 % of the size");
  crossed.note(raw, "whose edges cross, read as triangles from the first corner");
}

}  // namespace insonify
