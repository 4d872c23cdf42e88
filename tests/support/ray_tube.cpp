// SPDX-License-Identifier: BSD-3-Clause
#include "support/ray_tube.hpp"

#include <algorithm>
#include <cmath>

namespace insonify::traced {
namespace {

constexpr double step = 0.05, least_step = 1e-7;

/// Depth, angle (positive down) and time over the horizontal distance.
struct State {
  double depth, angle, time;
  State moved(const State& rate, double by) const {
    return {depth + by * rate.depth, angle + by * rate.angle, time + by * rate.time};
  }
};

struct Layer {
  double speed, gradient, at;  // c = speed + gradient (z - at)
  State rate(const State& s) const {
    const double c = speed + gradient * (s.depth - at);
    return {std::tan(s.angle), -gradient / c, 1 / (c * std::cos(s.angle))};
  }
};

State stepped(const Layer& layer, const State& s, double h) {
  const State a = layer.rate(s), b = layer.rate(s.moved(a, h / 2)), c = layer.rate(s.moved(b, h / 2)),
              d = layer.rate(s.moved(c, h));
  return {s.depth + h / 6 * (a.depth + 2 * b.depth + 2 * c.depth + d.depth),
          s.angle + h / 6 * (a.angle + 2 * b.angle + 2 * c.angle + d.angle),
          s.time + h / 6 * (a.time + 2 * b.time + 2 * c.time + d.time)};
}

/// Returns the ray that leaves at `angle`, at `horizontal`; nothing if it turns steeper than can be integrated over
/// distance.
std::optional<State> traced_to(const Water& water, double depth, double angle, double horizontal) {
  State s{depth, angle, 0};
  const auto layers_below = [&](double z) {
    return std::upper_bound(water.depth.begin(), water.depth.end(), z) - water.depth.begin();
  };
  for (double at = 0; at < horizontal;) {
    double h = std::min(step, horizontal - at);
    const double inside = s.depth + 1e-9 * std::tan(s.angle);
    const Layer layer{water.speed_at(inside), water.gradient_at(inside), inside};
    State next = stepped(layer, s, h);
    while (h > least_step && layers_below(next.depth) != layers_below(inside)) next = stepped(layer, s, h /= 2);
    s = next, at += h;
    if (std::abs(s.angle) > 1.5) return std::nullopt;
  }
  return s;
}

}  // namespace

double Water::speed_at(double z) const {
  if (z <= depth.front()) return speed.front();
  if (z >= depth.back()) return speed.back();
  const auto k = static_cast<std::size_t>(std::upper_bound(depth.begin(), depth.end(), z) - depth.begin());
  return speed[k - 1] + (z - depth[k - 1]) / (depth[k] - depth[k - 1]) * (speed[k] - speed[k - 1]);
}

double Water::gradient_at(double z) const {
  if (z < depth.front() || z >= depth.back()) return 0;
  const auto k = static_cast<std::size_t>(std::upper_bound(depth.begin(), depth.end(), z) - depth.begin());
  return (speed[k] - speed[k - 1]) / (depth[k] - depth[k - 1]);
}

std::optional<Arrival> fastest_arrival(const Water& water, double depth_from, double depth_to, double horizontal) {
  constexpr int tries = 80, halvings = 50;
  constexpr double reach = 1, apart = 1e-6;
  const double chord = std::atan2(depth_to - depth_from, horizontal);
  const auto miss = [&](double angle) {
    const auto end = traced_to(water, depth_from, angle, horizontal);
    return end ? end->depth - depth_to : std::nan("");
  };
  std::optional<Arrival> fastest;
  double before = std::nan(""), angle_before = 0;
  for (int k = 0; k <= tries; ++k) {
    const double angle = std::clamp(chord + reach * (2.0 * k / tries - 1), -1.45, 1.45), here = miss(angle);
    if (before * here <= 0 && angle > angle_before) {
      double low = angle_before, high = angle, at_low = before;
      for (int n = 0; n < halvings; ++n) {
        const double middle = 0.5 * (low + high), at = miss(middle);
        if (at * at_low > 0)
          low = middle, at_low = at;
        else
          high = middle;
      }
      const auto end = traced_to(water, depth_from, low, horizontal);
      if (end && (!fastest || end->time < fastest->time)) {
        const double slope = (miss(low + apart) - miss(low - apart)) / (2 * apart);
        const double tube = horizontal * std::abs(slope) * std::cos(end->angle);
        fastest = Arrival{end->time, -low, -end->angle,
                          water.speed_at(depth_to) * std::cos(low) / (water.speed_at(depth_from) * tube)};
      }
    }
    before = here, angle_before = angle;
  }
  return fastest;
}

}  // namespace insonify::traced
