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

constexpr std::size_t most_places = 512, most_bent_places = 48;

/// A place of the sample that is in view.
struct Place {
  Vector3d at, normal, to_head;  ///< in head axes
  double area, power, received;  ///< surface [m^2]; of its echo at one element [Pa^2]; of that in all beams
  const SurfaceScattering* law;
};

std::vector<Place> places_in_view(const PlanFacts& facts, std::size_t most) {
  const SceneSample& s = facts.sample;
  std::vector<std::size_t> heard;
  for (std::size_t i = 0; i < s.energy.size(); ++i)
    if (s.energy[i] > 0 && s.power[i] > 0) heard.push_back(i);
  const std::size_t step = (heard.size() + most - 1) / most;
  const auto each = static_cast<double>(step);
  const Eigen::Matrix3d to_head = facts.ping.view.world_from_head.linear().transpose();
  std::vector<Place> places;
  for (std::size_t k = 0; k < heard.size(); k += step) {
    const std::size_t i = heard[k];
    const std::uint32_t surfel = s.places.surfel[i];
    const Vector3d direction = unit_vector({s.places.azimuth[i], s.places.elevation[i]});
    Vector3d normal = to_head * s.scene.normal[surfel].cast<double>();
    if (normal.dot(direction) > 0) normal = -normal;
    places.push_back({s.places.range[i] * direction, normal, -direction, s.scene.area[surfel] * each, s.power[i] * each,
                      s.energy[i] / s.power[i], facts.ping.sent.surfaces[s.places.material[i]].get()});
  }
  return places;
}

/// Power at one element of the echoes by way of i and j, one sense (E158), from those of each alone.
double pair_power(const Place& i, const Place& j) {
  const Vector3d between = j.at - i.at;
  const double squared = between.squaredNorm();
  if (!(squared > 0)) return 0;
  const Vector3d direction = between / std::sqrt(squared);
  const PathAngles here{i.normal.dot(i.to_head), i.normal.dot(direction), i.to_head.dot(direction)},
      there{j.normal.dot(-direction), j.normal.dot(j.to_head), -direction.dot(j.to_head)};
  if (!(here.cos_out > 0 && there.cos_in > 0 && here.cos_in > 0 && there.cos_out > 0)) return 0;
  const auto straight_back = [](const Place& p, double cosine) { return p.law->cross_section({cosine, cosine, 1}); };
  const double alone = straight_back(i, here.cos_in) * straight_back(j, there.cos_out);
  if (!(alone > 0)) return 0;
  const double clamped = squared + (i.area + j.area) / (2 * pi);  // patches are no points
  return i.law->cross_section(here) * j.law->cross_section(there) *
         std::sqrt(i.power * j.power * i.area * j.area / alone) / clamped;
}

/// Power of the echo of a pair by bent legs, over that by straight ones.
double bent_power(const Place& i, const Place& j, const BentPair& bent) {
  const auto in_front = [](const PathAngles& p) { return p.cos_in > 0 && p.cos_out > 0; };
  if (!in_front(bent.here) || !in_front(bent.there)) return 0;
  const Vector3d way = (j.at - i.at).normalized();
  const PathAngles here{i.normal.dot(i.to_head), i.normal.dot(way), i.to_head.dot(way)},
      there{-j.normal.dot(way), j.normal.dot(j.to_head), -way.dot(j.to_head)};
  return bent.pressure * bent.pressure * i.law->cross_section(bent.here) * j.law->cross_section(bent.there) /
         (i.law->cross_section(here) * j.law->cross_section(there));
}

}  // namespace

double double_echo_bound(const PlanFacts& facts) {
  const std::vector<Place> places = places_in_view(facts, most_places);
  std::vector<double> energy(places.size(), 0);
  parallel_for(places.size(), facts.ping.options.threads, [&](std::size_t j) {
    for (std::size_t i = 0; i < places.size(); ++i)
      if (i != j) energy[j] += pair_power(places[i], places[j]) * places[j].received;
  });
  const double both_senses = 2;  // in one beam they add coherently
  return bound_of_added_echoes(facts, both_senses * std::accumulate(energy.begin(), energy.end(), 0.0));
}

StraightDoubleEchoes straight_double_echoes(const PlanFacts& facts) {
  const ResolvedPing& ping = facts.ping;
  if (!(ping.options.effects.double_echoes > 0) || !ping.environment.profile) return {};
  const std::vector<Place> places = places_in_view(facts, most_bent_places);
  std::vector<SurfacePlace> surfaces;
  for (const Place& place : places) surfaces.push_back({place.at, place.normal});
  const EchoOverlap overlap(ping);
  double energy = 0, largest = 0;
  std::vector<std::pair<double, double>> moved;  // energy and error of range of each pair
  for (const BentPair& bent : bent_pairs(surfaces, ping.environment, ping.view.world_from_head, ping.sent.medium)) {
    const Place &i = places[bent.first], &j = places[bent.last];
    const double power = pair_power(i, j) * j.received;
    if (!(power > 0)) continue;
    const double ratio = bent_power(i, j, bent);
    const double same = overlap.of(bent.longer / ping.sent.medium.sound_speed, 0, bent.turned);
    energy += power * (1 + ratio - 2 * std::sqrt(ratio) * same);  // (E178)
    largest = std::max(largest, power);
    moved.emplace_back(power, 0.5 * std::abs(bent.longer));
  }
  StraightDoubleEchoes cost{bound_of_added_echoes(facts, 2 * energy), 0};
  constexpr double counts = 1e-4;  // of the energy of the largest
  for (const auto& [power, range] : moved)
    if (power >= counts * largest) cost.range = std::max(cost.range, range);
  return cost;
}

}  // namespace insonify
