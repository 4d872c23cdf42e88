// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "acoustics/double_echoes.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "simulate/echo_overlap_internal.hpp"
#include "simulate/plan_stages_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t most_positions = 512, most_refracted_points = 48;

/// A position of the sample that is in view.
struct SurfaceSample {
  Vector3d at, normal, to_head;  ///< in head axes
  double area, power, received;  ///< surface [m^2]; of its echo at one element [Pa^2]; of that in all beams
  const SurfaceScattering* law;
};

std::vector<SurfaceSample> points_in_view(const PlanFacts& facts, std::size_t most) {
  const SceneSample& s = facts.sample;
  std::vector<std::size_t> insonified;
  for (std::size_t i = 0; i < s.energy.size(); ++i)
    if (s.energy[i] > 0 && s.power[i] > 0) insonified.push_back(i);
  const std::size_t step = (insonified.size() + most - 1) / most;
  const auto each = static_cast<double>(step);
  const Eigen::Matrix3d to_head = facts.ping.view.world_from_head.linear().transpose();
  std::vector<SurfaceSample> positions;
  for (std::size_t k = 0; k < insonified.size(); k += step) {
    const std::size_t i = insonified[k];
    const std::uint32_t surfel = s.positions.surfel[i];
    const Vector3d direction = unit_vector({s.positions.azimuth[i], s.positions.elevation[i]});
    Vector3d normal = to_head * s.scene.normal[surfel].cast<double>();
    if (normal.dot(direction) > 0) normal = -normal;
    positions.push_back({s.positions.range[i] * direction, normal, -direction, s.scene.area[surfel] * each,
                         s.power[i] * each, s.energy[i] / s.power[i],
                         facts.ping.sent.surfaces[s.positions.material[i]].get()});
  }
  return positions;
}

/// Power at one element of the echoes by way of i and j, one sense (E158), from those of each alone.
double pair_power(const SurfaceSample& i, const SurfaceSample& j) {
  const Vector3d between = j.at - i.at;
  const double squared = between.squaredNorm();
  if (!(squared > 0)) return 0;
  const Vector3d direction = between / std::sqrt(squared);
  const PathAngles here{i.normal.dot(i.to_head), i.normal.dot(direction), i.to_head.dot(direction)},
      there{j.normal.dot(-direction), j.normal.dot(j.to_head), -direction.dot(j.to_head)};
  if (!(here.cos_out > 0 && there.cos_in > 0 && here.cos_in > 0 && there.cos_out > 0)) return 0;
  const auto straight_back = [](const SurfaceSample& p, double cosine) {
    return p.law->cross_section({cosine, cosine, 1});
  };
  const double alone = straight_back(i, here.cos_in) * straight_back(j, there.cos_out);
  if (!(alone > 0)) return 0;
  const double clamped = squared + (i.area + j.area) / (2 * pi);  // patches are no points
  return i.law->cross_section(here) * j.law->cross_section(there) *
         std::sqrt(i.power * j.power * i.area * j.area / alone) / clamped;
}

/// Power of the echo of a pair by refracted legs, over that by straight ones.
double refracted_power(const SurfaceSample& i, const SurfaceSample& j, const RefractedPair& refracted) {
  const auto in_front = [](const PathAngles& p) { return p.cos_in > 0 && p.cos_out > 0; };
  if (!in_front(refracted.here) || !in_front(refracted.there)) return 0;
  const Vector3d way = (j.at - i.at).normalized();
  const PathAngles here{i.normal.dot(i.to_head), i.normal.dot(way), i.to_head.dot(way)},
      there{-j.normal.dot(way), j.normal.dot(j.to_head), -way.dot(j.to_head)};
  return refracted.pressure * refracted.pressure * i.law->cross_section(refracted.here) *
         j.law->cross_section(refracted.there) / (i.law->cross_section(here) * j.law->cross_section(there));
}

}  // namespace

double double_echo_bound(const PlanFacts& facts) {
  const std::vector<SurfaceSample> positions = points_in_view(facts, most_positions);
  std::vector<double> energy(positions.size(), 0);
  parallel_for(positions.size(), facts.ping.options.threads, [&](std::size_t j) {
    for (std::size_t i = 0; i < positions.size(); ++i)
      if (i != j) energy[j] += pair_power(positions[i], positions[j]) * positions[j].received;
  });
  const double both_senses = 2;  // in one beam they add coherently
  return bound_of_added_echoes(facts, both_senses * std::accumulate(energy.begin(), energy.end(), 0.0));
}

StraightDoubleEchoes straight_double_echoes(const PlanFacts& facts) {
  const ResolvedPing& ping = facts.ping;
  if (!(ping.options.effects.double_echoes > 0) || !ping.environment.profile) return {};
  const std::vector<SurfaceSample> positions = points_in_view(facts, most_refracted_points);
  std::vector<SurfacePoint> surfaces;
  for (const SurfaceSample& position : positions) surfaces.push_back({position.at, position.normal});
  const EchoOverlap overlap(ping);
  double energy = 0, largest = 0;
  std::vector<std::pair<double, double>> moved;  // energy and error of range of each pair
  for (const RefractedPair& refracted :
       refracted_pairs(surfaces, ping.environment, ping.view.world_from_head, ping.sent.medium)) {
    const SurfaceSample &i = positions[refracted.first], &j = positions[refracted.last];
    const double power = pair_power(i, j) * j.received;
    if (!(power > 0)) continue;
    const double ratio = refracted_power(i, j, refracted);
    const double same = overlap.of(refracted.longer / ping.sent.medium.sound_speed, 0, refracted.turned);
    energy += power * (1 + ratio - 2 * std::sqrt(ratio) * same);  // (E178)
    largest = std::max(largest, power);
    moved.emplace_back(power, 0.5 * std::abs(refracted.longer));
  }
  StraightDoubleEchoes cost{bound_of_added_echoes(facts, 2 * energy), 0};
  constexpr double counts = 1e-4;  // of the energy of the largest
  for (const auto& [power, range] : moved)
    if (power >= counts * largest) cost.range = std::max(cost.range, range);
  return cost;
}

}  // namespace insonify
