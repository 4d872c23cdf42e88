// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "acoustics/ray_families_internal.hpp"

namespace insonify {
namespace {

double root(double x) { return std::sqrt(std::max(x, 0.0)); }

// Out to where it turns and back.
double turning_horizontal(const TurningInterval& turn, double steepness, double highest) {
  return 2 * root(turn.delta + steepness) * highest / turn.gradient;
}

// Calls visit(horizontal, height, gradient, root_speed, times) for every arc of a ray.
template <typename Visit>
void visit_loop(const RaySide& side, const TurningInterval& turn, double steepness, double highest, int times,
                const Visit& visit) {
  for (std::size_t i = 0; i < turn.crossings; ++i) {
    const LayerCrossing& c = side.crossings[i];
    visit(c.horizontal(steepness), c.height, c.gradient, c.root_speed, 2 * times);
  }
  visit(turning_horizontal(turn, steepness, highest), 0.0, turn.gradient, turn.speed, times);
}

}  // namespace

double arc_time(double chord, double gradient, double root_speed) {
  const double x = gradient * chord / (2 * root_speed);
  return chord / root_speed * (x > 0 ? std::asinh(x) / x : 1);  // (E43)
}

double LayerCrossing::horizontal(double steepness) const {
  return reach / (root(delta_1 + steepness) + root(delta_2 + steepness));  // (E43)
}

RayWater::RayWater(const SoundSpeedProfile& profile, double upper, double lower, double horizontal) {
  speed_upper_ = sound_speed_at(profile, upper);
  speed_lower_ = sound_speed_at(profile, lower);

  // Depths between the ends at which the gradient changes, with the ends themselves.
  std::vector<std::pair<double, double>> stations{{upper, speed_upper_}};
  const auto first = std::upper_bound(profile.depth.begin(), profile.depth.end(), upper) - profile.depth.begin();
  for (auto i = static_cast<std::size_t>(first); i < profile.depth.size() && profile.depth[i] < lower; ++i)
    stations.emplace_back(profile.depth[i], profile.sound_speed[i]);
  if (lower > upper) stations.emplace_back(lower, speed_lower_);
  for (const auto& [depth, speed] : stations) highest_ = std::max(highest_, speed);
  for (std::size_t i = 1; i < stations.size(); ++i)
    add_crossing(between_, stations[i].first - stations[i - 1].first, stations[i - 1].second, stations[i].second);

  above_ = side(profile, upper, -1, horizontal);
  below_ = side(profile, lower, +1, horizontal);
}

void RayWater::add_crossing(std::vector<LayerCrossing>& list, double height, double speed_1, double speed_2) const {
  list.push_back({height, std::abs(speed_2 - speed_1) / height, std::sqrt(speed_1 * speed_2),
                  height * (speed_1 + speed_2) / highest_, delta(speed_1), delta(speed_2)});
}

RaySide RayWater::side(const SoundSpeedProfile& profile, double from, int step, double horizontal) const {
  const std::vector<double>&z = profile.depth, &c = profile.sound_speed;
  // A ray is nowhere steeper than where sound is slowest, so it climbs only so far in half its horizontal way.
  const auto [slowest, fastest] = std::minmax_element(c.begin(), c.end());
  const double climb = 0.5 * horizontal * std::sqrt((*fastest / *slowest) * (*fastest / *slowest) - 1);

  RaySide side;
  double depth = from, speed = sound_speed_at(profile, from), record = highest_, lowest = speed;
  auto next = step > 0 ? std::upper_bound(z.begin(), z.end(), from) - z.begin()
                       : std::lower_bound(z.begin(), z.end(), from) - z.begin() - 1;
  for (; next >= 0 && next < static_cast<std::ptrdiff_t>(z.size()) && std::abs(depth - from) <= climb; next += step) {
    const auto i = static_cast<std::size_t>(next);
    const double height = std::abs(z[i] - depth);
    // Sound faster than anywhere on the way here: rays turn, if their loop is not too long even when steepest.
    if (c[i] > record) {
      const double loop = 2 * std::abs(depth - from) * lowest / root(c[i] * c[i] - lowest * lowest);
      if (loop <= horizontal)
        side.turning.push_back({-delta(record), -delta(c[i]), side.crossings.size(), delta(speed),
                                std::abs(c[i] - speed) / height, speed});
      record = c[i];
    }
    add_crossing(side.crossings, height, speed, c[i]);
    lowest = std::min(lowest, c[i]);
    depth = z[i];
    speed = c[i];
  }
  return side;
}

double RayWater::horizontal(const RayFamily& family, double crossing_steepness, double turning_steepness) const {
  double sum = 0;
  for (const LayerCrossing& c : between_) sum += family.between * c.horizontal(crossing_steepness);
  const auto add_loops = [&](const RaySide& side, const TurningInterval& turn, int times) {
    for (std::size_t i = 0; i < turn.crossings; ++i)
      sum += 2 * times * side.crossings[i].horizontal(crossing_steepness);
    sum += times * turning_horizontal(turn, turning_steepness, highest_);
  };
  if (family.above > 0) add_loops(above_, *family.turn_above, family.above);
  if (family.below > 0) add_loops(below_, *family.turn_below, family.below);
  return sum;
}

std::optional<double> RayWater::direct_steepness(double target) const {
  if (between_.empty() || horizontal({}, 0) < target) return std::nullopt;
  double reach = 0;
  for (const LayerCrossing& c : between_) reach += c.reach;

  // In the tangent, 1/horizontal rises from below 1/target to above it, and is nearly straight: Newton in a bracket.
  double low = 0, high = reach / (2 * target), tangent = high;
  for (int step = 0; step < 100; ++step) {
    double sum = 0, slope = 0;
    for (const LayerCrossing& c : between_) {
      const double r1 = root(c.delta_1 + tangent * tangent), r2 = root(c.delta_2 + tangent * tangent);
      const double x = c.reach / (r1 + r2);
      sum += x;
      slope += x / (r1 + r2) * (tangent / r1 + tangent / r2);
    }
    (sum > target ? low : high) = tangent;
    // d(1/X)/dq = slope / X^2
    double next = tangent - (1 / sum - 1 / target) * sum * sum / slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - tangent) <= 1e-15 * tangent) return next * next;
    tangent = next;
  }
  return tangent * tangent;
}

double RayWater::travel_time(const RayFamily& family, double steepness, double target) const {
  const double stretch = target / horizontal(family, steepness);
  double time = 0;
  const auto add = [&](double x, double height, double gradient, double root_speed, int times) {
    time += times * arc_time(std::hypot(x * stretch, height), gradient, root_speed);
  };
  for (const LayerCrossing& c : between_)
    add(c.horizontal(steepness), c.height, c.gradient, c.root_speed, family.between);
  if (family.above > 0) visit_loop(above_, *family.turn_above, steepness, highest_, family.above, add);
  if (family.below > 0) visit_loop(below_, *family.turn_below, steepness, highest_, family.below, add);
  return time;
}

double RayWater::tangent_upper(double steepness) const {
  return root(delta(speed_upper_) + steepness) * highest_ / speed_upper_;
}

double RayWater::tangent_lower(double steepness) const {
  return root(delta(speed_lower_) + steepness) * highest_ / speed_lower_;
}

}  // namespace insonify
