// SPDX-License-Identifier: BSD-3-Clause
// Refraction: scatterers are moved to their apparent positions, where a straight ray at the head's sound speed would put
// them (rays in layers of constant gradient, Jensen et al., Computational Ocean Acoustics, ch. 3; E43). Steps:
//   1. refraction_bound   an upper bound of the change, from the box of ranges and directions and Snell's law alone;
//                         where it is 0 nothing else is done
//   2. position_of           depth and horizontal distance of every scatterer: the problem has two dimensions
//   3. RefractionTable    eigenrays on a grid of patches over these two, stored less their first order
//   4. table.apparent     range, elevation, spreading and arrival of every scatterer, interpolated, or solved where a
//                         patch is not smooth
// Cost: some thousand eigenrays for the table, whatever the number of scatterers, and an interpolation for each; for
// few scatterers one eigenray each. Blocks of scatterers run in parallel and are independent.
#include "acoustics/refract_paths.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "acoustics/refraction_table_internal.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t echoes_at_once = 4096, most_tried = 1024;

void require_valid_call(const char* who, const SoundSpeedProfile& profile, double head_depth, const Pose& pose) {
  require_valid(profile, who);
  if (!std::isfinite(head_depth)) fail(ErrorKind::argument, who, ": head_depth = ", head_depth, " m, must be finite");
  if (!pose.matrix().allFinite()) fail(ErrorKind::argument, who, ": world_from_head must be finite");
}

double checked_range(const char* who, const Scatterers& s, std::size_t i) {
  const double r = s.range[i];
  if (!(r > 0) || !std::isfinite(r))
    fail(ErrorKind::argument, who, ": range[", i, "] = ", r, " m, must be finite and > 0");
  return r;
}

struct Interval {
  double low = INFINITY, high = -INFINITY;
  void add(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

// Values of a cos(x) + b sin(x) for x within an interval.
Interval wave_within(double a, double b, const Interval& x) {
  Interval y;
  const auto at = [&](double angle) { y.add(a * std::cos(angle) + b * std::sin(angle)); };
  at(x.low);
  at(x.high);
  const double crest = std::atan2(b, a);
  for (double extremum = crest - 4 * pi; extremum < 5 * pi; extremum += pi)
    if (extremum > x.low && extremum < x.high) at(extremum);
  return y;
}

/// The box of ranges and directions that holds all scatterers, and how far below the head they may be.
struct Extent {
  Interval range, azimuth, elevation;

  explicit Extent(const Scatterers& s) {
    for (std::size_t i = 0; i < s.size(); ++i) {
      range.add(checked_range("refraction_bound", s, i));
      azimuth.add(s.azimuth[i]);
      elevation.add(s.elevation[i]);
    }
  }
  // Height per range is cos(elevation) (a cos(azimuth) + b sin(azimuth)) + c sin(elevation).
  Interval depths(double head_depth, const Pose& pose) const {
    const Eigen::RowVector3d up = pose.linear().row(2);
    const Interval across = wave_within(up.x(), up.y(), azimuth);
    Interval sine, depth;
    for (const double a : {across.low, across.high}) {
      const Interval share = wave_within(a, up.z(), elevation);
      sine.add(share.low);
      sine.add(share.high);
    }
    depth.add(head_depth);
    for (const double s : {sine.low, sine.high}) depth.add(head_depth - range.high * s);
    return depth;
  }
};

/// Slowest and fastest sound, and the greatest gradient, within a span of depths.
struct SpeedSpan {
  double slowest, fastest, gradient = 0;

  SpeedSpan(const SoundSpeedProfile& p, const Interval& depth) {
    Interval speed;
    speed.add(sound_speed_at(p, depth.low));
    speed.add(sound_speed_at(p, depth.high));
    for (std::size_t i = 0; i < p.depth.size(); ++i) {
      if (p.depth[i] > depth.low && p.depth[i] < depth.high) speed.add(p.sound_speed[i]);
      if (i > 0 && p.depth[i] > depth.low && p.depth[i - 1] < depth.high)
        gradient =
            std::max(gradient, std::abs(p.sound_speed[i] - p.sound_speed[i - 1]) / (p.depth[i] - p.depth[i - 1]));
    }
    slowest = speed.low;
    fastest = speed.high;
  }
  // Returns the height that a ray which turns within these layers climbs at most over half of `way` (Snell's law).
  double climb(double way) const { return 0.5 * way * std::sqrt((fastest / slowest - 1) * (fastest / slowest + 1)); }
};

struct Position {
  double depth = 0, horizontal = 0;
};

Position position_of(const Pose& pose, double head_depth, double range, const Eigen::Vector3d& direction) {
  const double up = pose.linear().row(2).dot(direction);
  return {head_depth - range * up, range * std::sqrt(std::max((1 - up) * (1 + up), 0.0))};
}

DepthBox box_of(const std::vector<Position>& positions) {
  Interval depth, horizontal;
  for (const Position& position : positions) {
    depth.add(position.depth);
    horizontal.add(position.horizontal);
  }
  return {depth.low, depth.high, horizontal.low, horizontal.high, positions.size()};
}

// A vertical plane through the head in which a ray runs, and the straight way to its end; world axes.
struct RayPlane {
  Eigen::Vector3d straight;
  Eigen::Vector3d ahead = Eigen::Vector3d::Zero();  // level; zero if the straight way is vertical

  RayPlane(const Pose& pose, const Eigen::Vector3d& direction) : straight(pose.linear() * direction) {
    const double across = std::hypot(straight.x(), straight.y());
    if (across > 0) ahead = {straight.x() / across, straight.y() / across, 0};
  }
  bool is_vertical() const { return ahead.isZero(0); }
  Eigen::Vector3d at(double horizontal, double up) const { return horizontal * ahead + up * Eigen::Vector3d::UnitZ(); }
};

// Returns the factor from the cosine of incidence of the straight ray to that of the bent one; 0 on the back.
double incidence_factor(const SceneCloud& scene, std::uint32_t surfel, const RayPlane& plane, double arrival) {
  constexpr double least_cosine = 1e-3;
  const Eigen::Vector3d normal = scene.normal[surfel].cast<double>();
  double straight = -normal.dot(plane.straight),
         refracted = -normal.dot(plane.at(std::cos(arrival), std::sin(arrival)));
  if (!scene.oriented(surfel)) straight = std::abs(straight), refracted = std::abs(refracted);
  return straight < least_cosine ? 1 : std::clamp(refracted / straight, 0.0, 1 / straight);
}

}  // namespace

RefractionBound refraction_bound(const SoundSpeedProfile& profile, double head_depth, const Pose& world_from_head,
                                 const Scatterers& scatterers) {
  require_valid_call("refraction_bound", profile, head_depth, world_from_head);
  if (scatterers.size() == 0) return {};
  const Extent extent(scatterers);
  const Interval scene = extent.depths(head_depth, world_from_head);
  const double far = extent.range.high;

  // Depths that rays can reach: from those the whole profile would allow to what is left of them.
  SpeedSpan span(profile, {-INFINITY, INFINITY});
  for (int pass = 0; pass < 4; ++pass) {
    const double climb = span.climb(far);
    span = SpeedSpan(profile, {scene.low - climb, scene.high + climb});
  }
  if (span.fastest == span.slowest) return {};

  // A ray is at least as long as the chord, its sound at most the fastest; one that turns has the invariant p with
  // 1/p at most the fastest, and takes horizontal / (p c^2). (E43)
  const double c = sound_speed_at(profile, head_depth);
  const double early = 1 - c / span.fastest, late = c * span.fastest / (span.slowest * span.slowest) - 1;
  // Somewhere a ray runs along its chord; on its way from there it turns by |gradient| dx / c at most.
  const double snell = 2 * std::acos(span.slowest / span.fastest);
  return {far * std::max(early, late), std::min(far * span.gradient / span.slowest, snell)};
}

RefractedPaths refract_paths(const SoundSpeedProfile& profile, double head_depth, const Pose& world_from_head,
                             Scatterers& s, const RefractionOptions& options) {
  constexpr const char* who = "refract_paths";
  require_valid_call(who, profile, head_depth, world_from_head);
  for (std::size_t i = 0; i < s.size(); ++i) checked_range(who, s, i);
  const RefractionBound bound = refraction_bound(profile, head_depth, world_from_head, s);
  if (bound.range == 0 && bound.elevation == 0) return {};

  // Where the scatterers are, and the rays that get there.
  std::vector<Position> positions(s.size());
  parallel_blocks(s.size(), echoes_at_once, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      positions[i] = position_of(world_from_head, head_depth, s.range[i], unit_vector({s.azimuth[i], s.elevation[i]}));
  });
  const RefractionTable table(profile, head_depth, box_of(positions), options.threads);

  const double lost = 4 * options.absorption;  // of intensity, per metre both ways
  std::atomic<std::size_t> silenced{0}, focused{0};
  const auto refract = [&](std::size_t i) {
    const auto seen = table.apparent(positions[i].depth, positions[i].horizontal);
    if (!seen) {
      s.projected_area[i] = 0;
      ++silenced;
      return;
    }
    const RayPlane plane(world_from_head, unit_vector({s.azimuth[i], s.elevation[i]}));
    if (seen->gain > 0.999 * std::log(most_focusing)) ++focused;
    double factor = std::exp(2 * seen->gain - lost * (s.range[i] - seen->range));  // (E167)
    if (options.scene) {
      const double turned = incidence_factor(*options.scene, s.surfel[i], plane, seen->arrival);
      s.cos_incidence[i] = static_cast<float>(std::min(1.0, s.cos_incidence[i] * turned));
      factor *= turned;
    }
    s.projected_area[i] = static_cast<float>(s.projected_area[i] * factor);
    s.range[i] = seen->range;
    if (plane.is_vertical()) return;
    const Direction direction =
        direction_of(world_from_head.linear().transpose() * plane.at(seen->horizontal, seen->up));
    s.azimuth[i] = direction.azimuth, s.elevation[i] = direction.elevation;
  };
  parallel_blocks(s.size(), echoes_at_once, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) refract(i);
  });
  return {silenced, focused};
}

RefractionBound refraction_in_view(const SoundSpeedProfile& profile, double head_depth, const Pose& world_from_head,
                                   const Scatterers& scatterers, const Sector& sector, const RangeGate& gate,
                                   int threads) {
  // Some of those in view.
  const SectorBounds bounds(sector);
  Scatterers straight;
  const std::size_t step = scatterers.size() / most_tried + 1;
  for (std::size_t i = 0; i < scatterers.size(); i += step) {
    const double range = scatterers.range[i];
    const Direction from{scatterers.azimuth[i], scatterers.elevation[i]};
    if (range < gate.min_range || range > gate.max_range || !bounds.holds(range * unit_vector(from))) continue;
    straight.range.push_back(range), straight.azimuth.push_back(from.azimuth);
    straight.elevation.push_back(from.elevation), straight.projected_area.push_back(1);
  }
  // How far they seem to move.
  Scatterers refracted = straight;
  refract_paths(profile, head_depth, world_from_head, refracted, {.threads = threads});
  RefractionBound most;
  for (std::size_t i = 0; i < refracted.size(); ++i) {
    const Eigen::Vector3d from = unit_vector({straight.azimuth[i], straight.elevation[i]});
    const double turned = (unit_vector({refracted.azimuth[i], refracted.elevation[i]}) - from).norm();
    most.range = std::max(most.range, std::abs(refracted.range[i] - straight.range[i]));
    most.elevation = std::max(most.elevation, 2 * std::asin(std::min(1.0, 0.5 * turned)));
    const double spread = refracted.projected_area[i] * std::pow(straight.range[i] / refracted.range[i], 4);
    if (spread > 0) most.level_db = std::max(most.level_db, std::abs(db_from_power(spread)));
  }
  return most;
}

}  // namespace insonify
