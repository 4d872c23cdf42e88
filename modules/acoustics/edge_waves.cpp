// SPDX-License-Identifier: BSD-3-Clause
// Kirchhoff's integral over a plate is, in polar coordinates about the foot of the perpendicular from the head, the
// image of the head and an integral along the outline (E164); that over a cylinder is an integral along a line (E166).
// Both are integrals over straight lines of a slow function times exp(2 i k r). Only places count where r stands still
// and where the line ends: around each, the integral is taken numerically under a smooth window (E165).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "acoustics/edge_waves_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;
using complex = std::complex<double>;

constexpr double window_phase = 6 * 2 * pi;            // [rad]: of sound on the way to the end of a window and back
constexpr double window_steepness = 2.8;               // of the error function in it, which ends at 4e-5
constexpr double panel_phase = 4, panel_length = 1;    // of one panel of the quadrature
constexpr double small_spread = 0.5, wide_spread = 3;  // [rad]: of a body heard as one point, and at its edges
constexpr double most_late = 2;                        // [rad]
constexpr double nudge = 1e-6;                         // of the size of a plate: 1e-3 rad of phase at most

// Positive nodes and weights of Gauss-Legendre quadrature on [-1, 1].
constexpr std::array<double, 4> gauss_node = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                              0.9602898564975363},
                                gauss_weight = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                                0.1012285362903763};

/// A straight line at a distance from the head; places on it are distances from the foot of the perpendicular.
struct PhasedLine {
  double distance, wavenumber;
  double scale;  // within which the integrand changes near the foot
  double range(double s) const { return std::hypot(distance, s); }
  /// Phase at s over that at c.
  double phase(double s, double c) const { return 2 * wavenumber * (s - c) * (s + c) / (range(s) + range(c)); }
  /// The position from c >= 0 on at which the phase has grown by so much; back towards the foot if that is negative.
  double position_after(double c, double phase) const {
    const double longer = phase / (2 * wavenumber), r = range(c);
    return std::sqrt(std::max(0.0, c * c + longer * (2 * r + longer)));
  }
};

/// A part of an integral, and the same with each piece times its phase.
struct Share {
  complex sum, moment;
  Share& operator+=(const Share& other) {
    sum += other.sum, moment += other.moment;
    return *this;
  }
};

/// Parts of an integral that belong to the nearer and to the farther end of a piece.
struct EndSums {
  Share near, far;
};

/// Integral of slow(s) exp(i phase) over [begin, end] under a window that fades over `length` [rad] from `centre` on;
/// phases re `centre`.
template <typename Slow>
Share windowed(const PhasedLine& line, double begin, double end, double centre, double length, Slow&& slow) {
  Share all;
  double s = begin, t = std::asinh(s / line.scale);
  const double last = std::asinh(end / line.scale);
  while (t < last) {
    // s = scale sinh(t): even a peak of this width at the foot is smooth in t.
    const double by_phase = std::asinh(line.position_after(s, panel_phase) / line.scale);
    double next = std::min(t + panel_length, by_phase);
    if (!(next < last && next > t)) next = last;  // where doubles end, so do panels
    const double half = 0.5 * (next - t), middle = 0.5 * (next + t);
    for (std::size_t k = 0; k < gauss_node.size(); ++k)
      for (const double side : {-1.0, 1.0}) {
        const double at = middle + side * half * gauss_node[k], position = line.scale * std::sinh(at);
        const double phase = line.phase(position, centre), x = 2 * std::abs(phase) / length - 1;
        const double fading = length > 0 ? 0.5 * std::erfc(window_steepness * x) : 0.5;
        const double size = half * gauss_weight[k] * line.scale * std::cosh(at) * fading * slow(position);
        const complex piece = std::polar(size, phase);
        all += {piece, phase * piece};
      }
    t = next, s = line.scale * std::sinh(t);
  }
  return all;  // (E165)
}

/// Integral over a piece of the line, 0 <= near <= far, shared out to its ends. The two windows add up to 1 on a piece
/// that is shorter than one.
template <typename Slow>
EndSums end_sums(const PhasedLine& line, double near, double far, Slow&& slow) {
  const double phase = line.phase(far, near), length = std::min(phase, window_phase);
  if (!(far > near)) return {};
  const double end = phase > window_phase ? line.position_after(near, length) : far;
  const double begin = phase > window_phase ? line.position_after(far, -length) : near;
  return {windowed(line, near, end, near, length, slow), windowed(line, begin, far, far, length, slow)};
}

/// Integral over [begin, end], shared out to both ends and to the foot, which counts if it lies between them.
struct LineSums {
  Share begin, foot, end;
};
template <typename Slow>
LineSums line_sums(const PhasedLine& line, double begin, double end, Slow&& slow) {
  if (begin >= 0) {
    const EndSums sums = end_sums(line, begin, end, slow);
    return {sums.near, {}, sums.far};
  }
  if (end <= 0) {
    const EndSums sums = end_sums(line, -end, -begin, slow);
    return {sums.far, {}, sums.near};
  }
  EndSums before = end_sums(line, 0, -begin, slow);
  const EndSums behind = end_sums(line, 0, end, slow);
  return {before.far, before.near += behind.near, behind.far};
}

/// Arrivals of a body, from its places and their shares of the integral.
class ArrivalList {
 public:
  /// power: of the wavenumber, in the sizes of shares.
  ArrivalList(double distance, double wavenumber, double power)
      : distance_(distance), wavenumber_(wavenumber), power_(power) {}

  /// Adds what `position` sends back, `size` times its share. It is received as much later as its pieces are on average, so
  /// that its phase is right at the frequencies about the carrier too.
  void add(const Vector3d& position, const Share& share, complex size = 1) {
    if (share.sum == 0.0) return;
    const double range = position.norm(), late = std::clamp((share.moment / share.sum).real(), -most_late, most_late);
    const double moved = 1 + late / (2 * wavenumber_ * range);
    const complex factor = 2 * moved * range * size * std::polar(1.0, -late);
    // A phase grows with the wavenumber, but for the part of it that is in the position. (E179)
    const complex rise = complex(0, 1) * (share.moment - late * share.sum) + power_ * share.sum;
    list_.push_back(
        {position, moved * position, factor * share.sum, factor * rise, std::asin(std::min(1.0, distance_ / range))});
  }
  /// Returns the arrivals. Those of a body of which all parts have nearly one phase come from its middle: they are large
  /// against their sum, and patterns of beams must weigh the body as a whole.
  std::vector<BodyArrival> about(const Vector3d& middle, double farthest) && {
    double nearest = farthest;
    for (const BodyArrival& a : list_) nearest = std::min(nearest, a.position.norm());
    const double spread = 2 * wavenumber_ * (farthest - nearest);
    const double x = std::clamp((spread - small_spread) / (wide_spread - small_spread), 0.0, 1.0);
    if (x == 1) return std::move(list_);
    const double apart = x * x * (3 - 2 * x);
    for (BodyArrival& a : list_) {
      const double before = a.apparent.norm();
      a.apparent = middle + apart * (a.apparent - middle);
      const double range = a.apparent.norm(), phase = 2 * wavenumber_ * (before - range);
      const complex moved = std::polar(range / before, phase);
      a.rise = moved * (a.rise + complex(0, phase) * a.factor);
      a.factor *= moved;
    }
    return std::move(list_);
  }

 private:
  double distance_, wavenumber_, power_;
  std::vector<BodyArrival> list_;
};

}  // namespace

std::vector<BodyArrival> plate_arrivals(std::span<const Vector3d> corners, const Vector3d& normal, double wavenumber) {
  const std::size_t n = corners.size();
  Vector3d middle = Vector3d::Zero();
  double size = 0, farthest = 0;
  for (const Vector3d& corner : corners) {
    middle += corner / static_cast<double>(n);
    farthest = std::max(farthest, corner.norm());
  }
  for (const Vector3d& corner : corners) size = std::max(size, (corner - middle).norm());
  const double d = -normal.dot(middle);
  const auto inward = [&](std::size_t k) -> Vector3d {
    return normal.cross(corners[(k + 1) % n] - corners[k]).normalized();
  };

  // On the line of an edge the foot of the perpendicular would be neither inside nor outside.
  Vector3d foot = -d * normal;
  for (std::size_t k = 0; k < n; ++k)
    if (std::abs(inward(k).dot(foot - corners[k])) < 0.1 * nudge * size) {
      foot += nudge * size * (middle - foot).normalized();
      break;
    }

  ArrivalList list(d, wavenumber, 0);
  std::vector<Share> at_corner(n);
  bool inside = true;
  for (std::size_t k = 0; k < n; ++k) {
    const Vector3d edge = corners[(k + 1) % n] - corners[k];
    const double length = edge.norm(), h = inward(k).dot(foot - corners[k]);
    if (!(length > 0) || h == 0) continue;
    inside = inside && h > 0;
    const Vector3d along = edge / length;
    const double distance = std::hypot(d, h), begin = along.dot(corners[k] - foot);
    const LineSums sums = line_sums({distance, wavenumber, std::abs(h)}, begin, begin + length, [&](double s) {
      return -d / (4 * pi) * h / ((h * h + s * s) * (distance * distance + s * s));  // (E164)
    });
    at_corner[k] += sums.begin, at_corner[(k + 1) % n] += sums.end;
    list.add(corners[k] - begin * along, sums.foot);
  }
  for (std::size_t k = 0; k < n; ++k) list.add(corners[k], at_corner[k]);
  if (inside) list.add(foot, {0.5 / d, 0});
  return std::move(list).about(middle, farthest);
}

std::vector<BodyArrival> cylinder_arrivals(const Vector3d& middle, const Vector3d& axis, double length, double radius,
                                           double wavenumber) {
  const double beside = axis.dot(middle);
  const Vector3d centre = middle - beside * axis;
  const double d = centre.norm() - radius, half = 0.5 * length;
  if (!(d > 0)) return {};
  const Vector3d foot = d / centre.norm() * centre;
  const complex across = std::polar(std::sqrt(pi * radius / (wavenumber * (d + radius))), pi / 4),
                size = complex(0, -wavenumber / (2 * pi)) * d * across;
  const LineSums sums = line_sums({d, wavenumber, d}, beside - half, beside + half, [&](double s) {
    const double r = std::hypot(d, s);
    return 1 / (r * r * std::sqrt(r));  // (E166)
  });
  ArrivalList list(d, wavenumber, 0.5);
  const Vector3d line = foot + beside * axis;
  list.add(foot, sums.foot, size);
  list.add(line - half * axis, sums.begin, size);
  list.add(line + half * axis, sums.end, size);
  return std::move(list).about(line, std::hypot(d, std::abs(beside) + half));
}

}  // namespace insonify
