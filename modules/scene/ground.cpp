// SPDX-License-Identifier: BSD-3-Clause
#include "scene/ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <Eigen/Dense>

#include "core/error.hpp"
#include "scene/ground_sheet_internal.hpp"

namespace insonify {

using Eigen::Vector2d, Eigen::Vector3d, Eigen::Vector3f;

namespace {

constexpr double touching = 1e-5;      // depth below the ground that counts as on it [m]
constexpr double least_support = 0.5;  // fraction of the footprint that must have ground
constexpr double free_spacings = 3;    // height above the ground beyond which nothing touches, in spacings
constexpr int cells_across = 100;      // cells across a footprint; the lowest surfel of each is tested

void require_surfels(const PlacedPart& part, const char* who) {
  if (!part.cloud || part.cloud->size() == 0) fail(ErrorKind::argument, who, ": part '", part.name, "' has no surfels");
  if (!part.world_from_part.matrix().allFinite())
    fail(ErrorKind::argument, who, ": the pose of part '", part.name, "' must be finite");
}

/// Returns the square of a level's grid that holds a position.
std::array<double, 3> square_of(const Vector2d& position, int level) {
  const double side = std::ldexp(1.0, level);
  return {static_cast<double>(level), std::floor(position.x() / side), std::floor(position.y() / side)};
}

}  // namespace

void Ground::add(const PlacedPart& part) {
  require_surfels(part, "Ground");
  if (part.captured) {
    const Bounds box = bounds(*part.cloud);
    captured_box_ = {captured_box_.min.cwiseMin(box.min), captured_box_.max.cwiseMax(box.max)};
  }
  // Surfels that coincide with those of another part add no ground.
  auto added = std::make_shared<const Sheet>(part);
  std::vector<std::size_t>& alike = by_hash_[added->hash()];
  if (std::ranges::any_of(alike, [&](std::size_t other) { return sheets_[other]->coincides(*added); })) return;
  alike.push_back(sheets_.size());
  sheets_.push_back(std::move(added));
  const Sheet& sheet = *sheets_.back();
  spacing_ = std::max(spacing_, sheet.mean_spacing);
  const int level = std::ilogb(std::max((sheet.high - sheet.low).maxCoeff(), 1e-6)) + 1;
  levels_.insert(level);
  const auto lower = [&](std::size_t a, std::size_t b) { return sheets_[a]->highest > sheets_[b]->highest; };
  const std::size_t number = sheets_.size() - 1;
  for (const auto& square : {square_of(sheet.low, level), square_of({sheet.low.x(), sheet.high.y()}, level),
                             square_of({sheet.high.x(), sheet.low.y()}, level), square_of(sheet.high, level)})
    if (auto& listed = squares_[square]; std::ranges::find(listed, number) == listed.end())
      listed.insert(std::ranges::upper_bound(listed, number, lower), number);
}

std::optional<GroundPoint> Ground::at(const Vector2d& position) const {
  // If several sheets are equally high, the first one counts.
  std::optional<GroundPoint> top;
  std::size_t topmost = 0;
  for (const int level : levels_) {
    const auto listed = squares_.find(square_of(position, level));
    if (listed == squares_.end()) continue;
    for (const std::size_t sheet : listed->second) {
      if (top && sheets_[sheet]->highest < top->height) break;
      const auto here = sheets_[sheet]->at(position);
      if (!here || (top && (here->height < top->height || (here->height == top->height && topmost < sheet)))) continue;
      top = here, topmost = sheet;
    }
  }
  return top;
}

namespace {

/// Height of a surfel above the ground [m].
struct Meeting {
  std::uint32_t surfel;
  double height;
};

/// Returns the lowest surfel of each cell of a part's footprint. Cells are two spacings of the ground wide.
std::vector<Vector3d> underside(const PlacedPart& part, double spacing) {
  Bounds box;
  for_each_surfel(part, [&](std::size_t, const Vector3d& p) { box = {box.min.cwiseMin(p), box.max.cwiseMax(p)}; });
  const double cell = std::max({(box.max - box.min).head<2>().maxCoeff() / cells_across, 2 * spacing, 1e-6});
  std::map<std::pair<int, int>, Vector3d> lowest;
  for_each_surfel(part, [&](std::size_t, const Vector3d& p) {
    const std::pair key(static_cast<int>((p.x() - box.min.x()) / cell), static_cast<int>((p.y() - box.min.y()) / cell));
    const auto [at, is_new] = lowest.try_emplace(key, p);
    if (!is_new && p.z() < at->second.z()) at->second = p;
  });
  std::vector<Vector3d> positions;
  for (const auto& [key, p] : lowest) positions.push_back(p);
  return positions;
}

[[noreturn]] void refuse_hole(const PlacedPart& part, const Vector3d& at, const char* what) {
  fail(ErrorKind::content, "part '", part.name, "' at x = ", at.x(), ", y = ", at.y(), " m: ", what,
       " (a hole of the scan, or beyond its end); move it, or give its height: position_m = [x, y, z]");
}

/// Returns the ground below each of `positions`. Throws Error(content) without ground below the part or half its
/// footprint.
std::vector<std::optional<GroundPoint>> ground_under(const PlacedPart& part, const Ground& ground,
                                                     const std::vector<Vector3d>& positions) {
  const Vector3d own = part.world_from_part.translation();
  if (!ground.at(own.head<2>())) refuse_hole(part, own, "no ground beneath it");
  std::vector<std::optional<GroundPoint>> under;
  std::size_t there = 0;
  for (const Vector3d& p : positions) there += under.emplace_back(ground.at(p.head<2>())).has_value();
  if (static_cast<double>(there) < least_support * static_cast<double>(positions.size()))
    refuse_hole(part, own, "no ground beneath more than half of it");
  return under;
}

/// Returns the upward normal of the plane z = a x + b y + c that is fitted to the ground under a footprint.
Vector3d normal_under(const Ground& ground, const Vector3d& own, const std::vector<Vector3d>& positions,
                      const std::vector<std::optional<GroundPoint>>& under) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Vector3d products = Vector3d::Zero();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!under[i]) continue;
    const Vector3d row(positions[i].x() - own.x(), positions[i].y() - own.y(), 1);
    squares += row * row.transpose();
    products += row * (under[i]->height - own.z());
  }
  const Eigen::ColPivHouseholderQR<Eigen::Matrix3d> solver(squares);
  if (solver.rank() < 3) return ground.at(own.head<2>())->normal;
  const Vector3d plane = solver.solve(products);
  return Vector3d(-plane.x(), -plane.y(), 1).normalized();
}

}  // namespace

std::optional<PlacedPart> place_on_ground(PlacedPart part, const Ground& ground, PartRest rest, double bury) {
  require_surfels(part, "place_on_ground");
  if (!std::isfinite(bury)) fail(ErrorKind::argument, "place_on_ground: bury = ", bury, " m, must be finite");
  if (rest == PartRest::none) return part;
  if (rest == PartRest::bed) {
    const std::vector<Vector3d> positions = underside(part, ground.spacing());
    const Vector3d own = part.world_from_part.translation();
    const Vector3d up = normal_under(ground, own, positions, ground_under(part, ground, positions));
    part.world_from_part.linear() =
        Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), up) * part.world_from_part.linear();
  }
  // Look up heights only where the part may touch or be buried, judged by the ground below its lowest surfels.
  const std::vector<Vector3d> positions = underside(part, ground.spacing());
  const auto under = ground_under(part, ground, positions);
  double least = -std::numeric_limits<double>::infinity(), top = least;
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (under[i]) least = std::max(least, under[i]->height - positions[i].z()), top = std::max(top, under[i]->height);
  const double free = top + free_spacings * ground.spacing() + std::max(bury, 0.0) - least;
  std::vector<Meeting> meetings;
  double shift = least;
  for_each_surfel(part, [&](std::size_t i, const Vector3d& p) {
    const auto here = p.z() < free ? ground.at(p.head<2>()) : std::nullopt;
    meetings.push_back({static_cast<std::uint32_t>(i), here ? p.z() - here->height : free});
    if (here) shift = std::max(shift, here->height - p.z());
  });
  // Shift the part until its first surfel touches, then bury it. Surfels below the ground are left out.
  part.world_from_part.translation().z() += shift - bury;
  std::vector<std::uint32_t> above;
  for (const Meeting& m : meetings)
    if (m.height == free || m.height + shift - bury >= -touching) above.push_back(m.surfel);
  if (above.empty()) return std::nullopt;
  if (above.size() < meetings.size()) part.surfels = std::move(above);
  return part;
}

double height_of(const PlacedPart& part) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for_each_surfel(part,
                  [&](std::size_t, const Vector3d& p) { low = std::min(low, p.z()), high = std::max(high, p.z()); });
  return high - low;
}

double footprint_radius(const PlacedPart& part) {
  double farthest = 0;
  const Vector3d own = part.world_from_part.translation();
  for_each_surfel(part,
                  [&](std::size_t, const Vector3d& p) { farthest = std::max(farthest, (p - own).head<2>().norm()); });
  return farthest;
}

}  // namespace insonify
