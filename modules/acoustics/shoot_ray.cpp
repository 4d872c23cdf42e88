// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/shoot_ray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/require.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr const char* shoot_call = "shoot_ray";
constexpr double straight_turn = 1e-7;  // |gradient| x time below which an arc is straight to 1e-8 of its length

/// A ray on its way. `slope` is asinh(tan(angle)), the angle positive down: it changes with time at the rate -gradient.
struct RayState {
  double horizontal, depth, slope;
};

/// A layer of constant gradient; without bound above or below it the gradient is 0.
struct RayLayer {
  double top, bottom, gradient;
};

/// The layer that a ray at `depth` enters, going down or up.
RayLayer layer_at(const SoundSpeedProfile& p, double depth, bool down) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  const auto& z = p.depth;
  const auto below = down ? std::upper_bound(z.begin(), z.end(), depth) : std::lower_bound(z.begin(), z.end(), depth);
  if (below == z.begin()) return {-endless, z.front(), 0};
  if (below == z.end()) return {z.back(), endless, 0};
  const auto k = static_cast<std::size_t>(below - z.begin());
  return {z[k - 1], z[k], (p.sound_speed[k] - p.sound_speed[k - 1]) / (z[k] - z[k - 1])};
}

/// The ray after `time` in one layer. (E93)
RayState after(const RayState& from, double sound_speed, double gradient, double time) {
  const double cosine = 1 / std::cosh(from.slope), sine = std::tanh(from.slope), turn = gradient * time;
  if (std::abs(turn) < straight_turn)
    return {from.horizontal + sound_speed * time * cosine, from.depth + sound_speed * time * sine, from.slope - turn};
  const double to = from.slope - turn, radius = sound_speed / (cosine * gradient);
  return {from.horizontal + radius * (sine - std::tanh(to)), from.depth + radius * (1 / std::cosh(to) - cosine), to};
}

/// Time to the layer's end that the ray meets first [s].
double time_to_leave(const RayState& ray, double sound_speed, const RayLayer& layer) {
  const bool down = ray.slope > 0 || (ray.slope == 0 && layer.gradient < 0);
  const double ahead = down ? layer.bottom : layer.top, behind = down ? layer.top : layer.bottom;
  if (layer.gradient == 0) {
    const double speed = sound_speed * std::tanh(ray.slope);
    return speed == 0 ? std::numeric_limits<double>::infinity() : (ahead - ray.depth) / speed;
  }
  // Snell: the cosine grows with sound speed; where it would exceed 1 the ray turns back within the layer.
  const double invariant = 1 / (std::cosh(ray.slope) * sound_speed);
  const auto cosine_at = [&](double depth) { return invariant * (sound_speed + layer.gradient * (depth - ray.depth)); };
  const double there = cosine_at(ahead);
  const double sign = down ? 1 : -1;
  if (there < 1 && there > 0) return (ray.slope - sign * std::acosh(1 / there)) / layer.gradient;
  const double back = std::min(1.0, cosine_at(behind));
  return (ray.slope + sign * std::acosh(1 / back)) / layer.gradient;
}

/// How a tube of rays widens over its way: `rate` is the change of its width.
struct TubeState {
  double way = 0, width = 0, rate = 1;
  void go(double by) { way += by, width += rate * by; }
  /// Where the gradient changes by `jump` (down over depth) on a ray of slope `sine`, positive down.
  void cross(double jump, double sine, double speed) {
    if (jump != 0 && sine != 0) rate -= width * (1 - sine * sine) / sine * jump / (speed * speed);  // (E167)
  }
};

/// Straight up or down: the sum over layers, whose times are logarithms of the ratio of sound speeds.
RayTube shoot_vertically(const SoundSpeedProfile& profile, double depth, bool down, double time) {
  const double sign = down ? 1 : -1;
  RayTube tube;
  while (true) {
    const RayLayer layer = layer_at(profile, depth, down);
    const double c = sound_speed_at(profile, depth), g = sign * layer.gradient;
    const double way = sign * ((down ? layer.bottom : layer.top) - depth);
    // Beyond the profile a layer has no end and no gradient.
    const double needed = g == 0 || std::abs(g) * way < 1e-9 * c ? way / c : std::log1p(g * way / c) / g;
    if (needed >= time) {
      const double far = std::abs(g) * time < 1e-9 ? c * time : c * std::expm1(g * time) / g;
      tube.way += far * (c + 0.5 * g * far);
      tube.width = tube.way, tube.end = {0, depth + sign * far, -sign * pi / 2};
      return tube;
    }
    tube.way += way * (c + 0.5 * g * way);
    time -= needed;
    depth = down ? layer.bottom : layer.top;
  }
}

}  // namespace

double RayTube::spreading(double speed_at_start, double speed_at_end) const {
  return speed_at_start * speed_at_end / (way * std::abs(width));
}

RayEnd shoot_ray(const SoundSpeedProfile& profile, double depth, double elevation, double time) {
  return shoot_tube(profile, depth, elevation, time).end;
}

RayTube shoot_tube(const SoundSpeedProfile& profile, double depth, double elevation, double time) {
  require_valid(profile, shoot_call);
  require(std::isfinite(depth), shoot_call, "depth", depth, "m", "finite");
  require(std::abs(elevation) <= pi / 2, shoot_call, "elevation", elevation, "rad", "within -pi/2 and pi/2");
  require(time >= 0 && std::isfinite(time), shoot_call, "time", time, "s", "finite and >= 0");
  if (pi / 2 - std::abs(elevation) < 1e-9) return shoot_vertically(profile, depth, elevation < 0, time);

  RayState ray{0, depth, std::asinh(std::tan(-elevation))};
  const double invariant = std::cos(elevation) / sound_speed_at(profile, depth);  // Snell's
  TubeState tube;
  std::optional<double> gradient;
  for (int standing = 0; standing < 4;) {
    // A level ray bends towards lower sound speed.
    const bool down = ray.slope > 0 || (ray.slope == 0 && layer_at(profile, ray.depth, true).gradient < 0);
    const RayLayer layer = layer_at(profile, ray.depth, down);
    const double c = sound_speed_at(profile, ray.depth), from = ray.horizontal;
    if (gradient) tube.cross(layer.gradient - *gradient, std::tanh(ray.slope), c);
    gradient = layer.gradient;
    const double leave = time_to_leave(ray, c, layer);
    if (!(leave < time)) {
      ray = after(ray, c, layer.gradient, time);
      tube.go((ray.horizontal - from) / invariant);
      return {{ray.horizontal, ray.depth, -std::atan(std::sinh(ray.slope))}, tube.way, tube.width};
    }
    standing = leave > 0 ? 0 : standing + 1;
    if (leave > 0) {
      ray = after(ray, c, layer.gradient, leave), time -= leave;
      tube.go((ray.horizontal - from) / invariant);
    }
    ray.depth = std::abs(ray.depth - layer.bottom) < std::abs(ray.depth - layer.top) ? layer.bottom : layer.top;
  }
  // Level along the axis of a duct.
  const double far = sound_speed_at(profile, ray.depth) * time;
  tube.go(far / invariant);
  return {{ray.horizontal + far, ray.depth, 0}, tube.way, tube.width};
}

}  // namespace insonify
