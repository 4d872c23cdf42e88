// SPDX-License-Identifier: BSD-3-Clause
#include "survey/part_placement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/require.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

/// Largest share of the area that discs about random centres may take. Discs placed one by one reach 0.547 at most.
constexpr double most_cover = 0.45;

double perimeter_of(const std::vector<Eigen::Vector2d>& corners) {
  double length = 0;
  for (std::size_t a = 0, b = corners.size() - 1; a < corners.size(); b = a++)
    length += (corners[a] - corners[b]).norm();
  return length;
}

}  // namespace

double area_of_polygon(const std::vector<Eigen::Vector2d>& corners) {
  double twice = 0;
  for (std::size_t a = 0, b = corners.size() - 1; a < corners.size(); b = a++)
    twice += corners[b].x() * corners[a].y() - corners[b].y() * corners[a].x();
  return std::abs(twice) / 2;
}

bool is_within(const std::vector<Eigen::Vector2d>& corners, const Eigen::Vector2d& position) {
  bool inside = false;
  for (std::size_t a = 0, b = corners.size() - 1; a < corners.size(); b = a++) {
    const Eigen::Vector2d &p = corners[a], &q = corners[b];
    if ((p.y() > position.y()) != (q.y() > position.y()) &&
        position.x() < p.x() + (q.x() - p.x()) * (position.y() - p.y()) / (q.y() - p.y()))
      inside = !inside;
  }
  return inside;
}

MovingAxes axes_at(const PartPlacement& p, const std::string& name, double time) {
  const Pose turned = pose_from_yaw_pitch_roll(Eigen::Vector3d::Zero(), p.yaw, p.pitch, p.roll);
  if (p.trajectory) {
    const double first = p.trajectory->time.front(), last = p.trajectory->time.back();
    if (!(time >= first && time <= last))
      fail(ErrorKind::content, "part '", name, "': its trajectory is from ", first, " to ", last,
           " s, but is asked for at ", time, " s; make the trajectory longer, or ping within it");
    return {pose_at(*p.trajectory, time) * turned, motion_at(*p.trajectory, time)};
  }
  MovingAxes axes{turned, {p.velocity, p.turn_rate}};
  const double angle = p.turn_rate.norm() * time;
  if (angle != 0) axes.pose.linear() = Eigen::AngleAxisd(angle, p.turn_rate.normalized()) * axes.pose.linear();
  axes.pose.translation() = p.position + time * p.velocity;
  return axes;
}

std::shared_ptr<const SceneCloud> scaled(const std::shared_ptr<const SceneCloud>& cloud, double scale) {
  if (scale == 1) return cloud;
  SceneCloud by = *cloud;
  const auto s = static_cast<float>(scale);
  by.origin *= scale;
  for (Eigen::Vector3f& p : by.point) p *= s;
  for (float& a : by.area) a *= s * s;
  for (auto* lengths : {&by.noise, &by.unevenness})
    for (float& x : *lengths) x *= s;
  for (Facet& facet : by.facet)
    for (Eigen::Vector3f& corner : facet) corner *= s;
  if (by.part_of) by.part_of->mean_spacing *= scale, by.part_of->largest_area *= s * s;
  return std::make_shared<const SceneCloud>(std::move(by));
}

void require_valid(const ScatterRule& rule, const char* who) {
  require(rule.least >= 0, who, "count", rule.least, "", "at least 0");
  require(rule.most >= rule.least, who, "count", rule.most, "", "at least the other number of count");
  if (rule.area.size() < 3)
    fail(ErrorKind::argument, who, ": area_m has ", rule.area.size(), " corners, must have three at least");
  const double area = area_of_polygon(rule.area);
  require(area > 0 && std::isfinite(area), who, "area_m", area, "m^2", "a polygon with an area > 0");
  require(rule.yaw >= 0 && std::isfinite(rule.yaw), who, "yaw", rule.yaw, "rad", "at least 0");
  require(rule.tilt >= 0 && std::isfinite(rule.tilt), who, "tilt", rule.tilt, "rad", "at least 0");
  require(rule.least_bury >= 0 && rule.most_bury <= 1 && rule.least_bury <= rule.most_bury, who, "bury", rule.most_bury,
          "", "within 0 and 1, the least first");
  require(rule.least_scale > 0 && rule.least_scale <= rule.most_scale && std::isfinite(rule.most_scale), who, "scale",
          rule.least_scale, "", "> 0, the least first");
  require(rule.empty_share >= 0 && rule.empty_share <= 1, who, "empty_share", rule.empty_share, "", "within 0 and 1");
  if (rule.rest == PartRest::none) fail(ErrorKind::argument, who, ": rest must be ground or bed");
  if (!rule.min_distance) return;
  const double d = *rule.min_distance;
  require(d > 0 && std::isfinite(d), who, "min_distance_m", d, "m", "> 0");
  // Discs of this diameter about centres in the area lie within the area widened by their radius.
  const double disc = pi * d * d / 4, room = area + perimeter_of(rule.area) * d / 2 + disc;
  const double most = std::max(1.0, std::floor(most_cover * room / disc));
  if (rule.most > most)
    fail(ErrorKind::argument, who, ": count = ", rule.most, " does not fit: about ", most, " bodies ", d,
         " m apart (min_distance_m) find a place in area_m of ", area, " m^2; ask for fewer, or a smaller distance");
}

}  // namespace insonify
