// SPDX-License-Identifier: BSD-3-Clause
// The fastest ray between two depths at a horizontal distance, in layers of constant gradient of sound speed, where
// rays are arcs of circles (Jensen et al., Computational Ocean Acoustics, ch. 3; E43). Steps, from the upper to the
// lower end:
//   1. a vertical ray, or ends within one layer: closed forms (vertical_time, offer_arc)
//   2. rays that turn at most once: the direct one, and for every layer that can turn a ray above or below the ends a family
//      of rays; in each family the steepness that reaches the distance is found by sampling, bisection, and golden
//      section
//      about an extremum of the reach (a caustic)
//   3. only where there is none: rays in a duct, that turn up to eight times above and below
// The fastest candidate is kept; travel time is stationary in steepness (Fermat), so that it is good to 1e-12.
// Cost for n layers: O(n) for the direct ray; O(n^2) for step 2, n families of some tens of sums over the layers each;
// O(n^3) for step 3.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "acoustics/ray_families_internal.hpp"
#include "core/error.hpp"

namespace insonify {
namespace {

constexpr int samples = 16;    ///< samples of a family's reach, between which a ray is sought
constexpr int most_turns = 8;  ///< turns above, and below, of rays that are sought where no simple ray is

/// A ray from the upper to the lower end; slopes as tangents, positive down.
struct Candidate {
  double travel_time = std::numeric_limits<double>::infinity();
  double down_upper = 0, down_lower = 0;
};

/// Keeps the fastest; of two equally fast ones the first.
struct Fastest {
  std::optional<Candidate> ray;
  void offer(const Candidate& other) {
    if (!ray || other.travel_time < ray->travel_time * (1 - 1e-12)) ray = other;
  }
};

// Straight down: the sum over the layers.
double vertical_time(const SoundSpeedProfile& profile, double upper, double lower) {
  double time = 0, depth = upper;
  while (depth < lower) {
    const auto next = std::upper_bound(profile.depth.begin(), profile.depth.end(), depth);
    const double end = next == profile.depth.end() ? lower : std::min(*next, lower);
    const double c1 = sound_speed_at(profile, depth), c2 = sound_speed_at(profile, end);
    time += arc_time(end - depth, std::abs(c2 - c1) / (end - depth), std::sqrt(c1 * c2));
    depth = end;
  }
  return time;
}

// The one arc between two depths of layer `k` (below entry k - 1, above entry k), if it stays in it.
void offer_arc(const SoundSpeedProfile& profile, std::size_t k, double upper, double lower, double horizontal,
               Fastest& fastest) {
  const std::vector<double>&z = profile.depth, &c = profile.sound_speed;
  const bool bounded = k > 0 && k < z.size();
  const double gradient = bounded ? (c[k] - c[k - 1]) / (z[k] - z[k - 1]) : 0;
  const double c1 = sound_speed_at(profile, upper), c2 = sound_speed_at(profile, lower), height = lower - upper;

  // Tangents at right angles to the radii from the arc's centre, which stands where sound speed would be zero.
  const double bow = 0.5 * gradient * horizontal * horizontal, chord = 0.5 * (c1 + c2) * height;
  const double down_upper = (chord + bow) / (c1 * horizontal), down_lower = (chord - bow) / (c2 * horizontal);
  if (down_upper > 0 && down_lower < 0 && c1 * std::hypot(1, down_upper) > c[k]) return;
  if (down_upper < 0 && down_lower > 0 && c1 * std::hypot(1, down_upper) > c[k - 1]) return;
  fastest.offer(
      {arc_time(std::hypot(horizontal, height), std::abs(gradient), std::sqrt(c1 * c2)), down_upper, down_lower});
}

/// Looks for the rays of one family that get exactly `target` far.
class FamilySearch {
 public:
  FamilySearch(const RayWater& water, const RayFamily& family, double target)
      : water_(water), family_(family), target_(target) {}

  // Between steepness `low` and `high`; its root-like starts are resolved by sampling it in squares.
  template <typename Found>
  void search(double low, double high, const Found& found) {
    low_ = low;
    span_ = high - low;
    std::array<double, samples + 1> f{};
    for (int i = 0; i <= samples; ++i) f[i] = excess(at(i));
    for (const int end : {0, samples})
      if (std::abs(f[end]) <= 1e-9 * target_) found(steepness(at(end)));
    for (int i = 0; i < samples; ++i)
      if ((f[i] < 0) != (f[i + 1] < 0)) found(steepness(root(at(i), at(i + 1), f[i] < 0)));
    for (int i = 1; i < samples; ++i) {
      const bool valley = f[i] > 0 && f[i] <= f[i - 1] && f[i] <= f[i + 1];
      const bool hill = f[i] < 0 && f[i] >= f[i - 1] && f[i] >= f[i + 1];
      if (valley || hill) search_about_extremum(at(i - 1), at(i + 1), valley ? 1 : -1, found);
    }
  }

 private:
  static double at(int i) { return static_cast<double>(i) / samples; }
  double steepness(double t) const { return t < 1 ? low_ + span_ * t * t : low_ + span_; }
  double excess(double t) const { return water_.horizontal(family_, steepness(t)) - target_; }

  double root(double a, double b, bool rising) const {
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (a + b);
      if (middle <= a || middle >= b) break;
      ((excess(middle) < 0) == rising ? a : b) = middle;
    }
    return 0.5 * (a + b);
  }

  // Two rays hide between samples where reach has an extremum (a caustic): golden section until it is crossed.
  template <typename Found>
  void search_about_extremum(double a, double b, double sign, const Found& found) const {
    constexpr double golden = 0.6180339887498949;
    const double left = a, right = b;
    for (int step = 0; step < 40; ++step) {
      const double p = b - golden * (b - a), q = a + golden * (b - a), fp = sign * excess(p), fq = sign * excess(q);
      const double lowest = fp < fq ? p : q;
      if (std::min(fp, fq) <= 0) {
        found(steepness(root(left, lowest, sign < 0)));
        found(steepness(root(lowest, right, sign > 0)));
        return;
      }
      (fp < fq ? b : a) = fp < fq ? q : p;
    }
  }

  const RayWater& water_;
  const RayFamily& family_;
  const double target_;
  double low_ = 0, span_ = 0;
};

// Rays of a family whose steepness lies within the intervals in which it turns.
void offer_family(const RayWater& water, RayFamily family, double horizontal, Fastest& fastest) {
  double low = 0, high = std::numeric_limits<double>::infinity();
  for (const TurningInterval* turn : {family.turn_above, family.turn_below})
    if (turn) {
      low = std::max(low, turn->steepness_min);
      high = std::min(high, turn->steepness_max);
    }
  if (!(high > low) || water.horizontal(family, high, low) > (1 + 1e-9) * horizontal ||
      water.horizontal(family, low, high) < (1 - 1e-9) * horizontal)
    return;
  // A ray that sets out into one side and has turned as often in it as in the other arrives from the other.
  const int trips = family.between;
  FamilySearch(water, family, horizontal).search(low, high, [&](double steepness) {
    const bool leaves_up = family.above > (trips - 1) / 2, arrives_up = family.below > (trips - 1) / 2;
    const double upper = water.tangent_upper(steepness), lower = water.tangent_lower(steepness);
    fastest.offer(
        {water.travel_time(family, steepness, horizontal), leaves_up ? -upper : upper, arrives_up ? -lower : lower});
  });
}

// Rays that turn once at most.
void offer_simple_rays(const RayWater& water, double horizontal, Fastest& fastest) {
  if (const auto steepness = water.direct_steepness(horizontal))
    fastest.offer({water.travel_time({}, *steepness, horizontal), water.tangent_upper(*steepness),
                   water.tangent_lower(*steepness)});
  for (const TurningInterval& turn : water.above().turning)
    offer_family(water, {1, 1, 0, &turn, nullptr}, horizontal, fastest);
  for (const TurningInterval& turn : water.below().turning)
    offer_family(water, {1, 0, 1, nullptr, &turn}, horizontal, fastest);
}

// Rays caught in a duct, that turn above and below: m whole cycles, and a loop above, below or both.
void offer_ducted_rays(const RayWater& water, double horizontal, Fastest& fastest) {
  for (const TurningInterval& above : water.above().turning)
    for (const TurningInterval& below : water.below().turning)
      for (int m = 0; m < most_turns; ++m)
        for (const auto& [up, down] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
          if (m + up > 0 && m + down > 0)
            offer_family(water, {1 + 2 * m, m + up, m + down, &above, &below}, horizontal, fastest);
}

std::optional<Candidate> fastest_ray(const SoundSpeedProfile& profile, double upper, double lower, double horizontal) {
  // So steep that its slope would overflow: straight down.
  if (horizontal <= 1e-100 * (lower - upper)) {
    const double down = upper < lower ? std::numeric_limits<double>::infinity() : 0;
    return Candidate{vertical_time(profile, upper, lower), down, down};
  }
  Fastest fastest;
  const std::vector<double>& z = profile.depth;
  const auto upper_layer = static_cast<std::size_t>(std::upper_bound(z.begin(), z.end(), upper) - z.begin());
  const auto lower_layer = static_cast<std::size_t>(std::lower_bound(z.begin(), z.end(), lower) - z.begin());
  if (upper_layer >= lower_layer)  // at the same entry: one may look at the layers on either side of it
    for (std::size_t k = lower_layer; k <= upper_layer; ++k) offer_arc(profile, k, upper, lower, horizontal, fastest);

  const RayWater water(profile, upper, lower, horizontal);
  offer_simple_rays(water, horizontal, fastest);
  if (!fastest.ray) offer_ducted_rays(water, horizontal, fastest);
  return fastest.ray;
}

}  // namespace

std::optional<Eigenray> eigenray_between(const SoundSpeedProfile& profile, double depth_from, double depth_to,
                                         double horizontal) {
  const bool downwards = depth_from <= depth_to;
  const auto ray = fastest_ray(profile, std::min(depth_from, depth_to), std::max(depth_from, depth_to), horizontal);
  if (!ray) return std::nullopt;
  return Eigenray{ray->travel_time, std::atan(downwards ? -ray->down_upper : ray->down_lower)};
}

Eigenray find_eigenray(const SoundSpeedProfile& profile, double depth_from, double depth_to, double horizontal) {
  constexpr const char* who = "find_eigenray";
  require_valid(profile, who);
  if (!std::isfinite(depth_from) || !std::isfinite(depth_to))
    fail(ErrorKind::argument, who, ": depths ", depth_from, " m and ", depth_to, " m, must be finite");
  if (!(horizontal >= 0) || !std::isfinite(horizontal))
    fail(ErrorKind::argument, who, ": horizontal = ", horizontal, " m, must be finite and >= 0");
  const auto ray = eigenray_between(profile, depth_from, depth_to, horizontal);
  if (!ray)
    fail(ErrorKind::content, who, ": no ray joins depths ", depth_from, " m and ", depth_to, " m over ", horizontal,
         " m: a shadow zone of the sound speed profile");
  return *ray;
}

}  // namespace insonify
