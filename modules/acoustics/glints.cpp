// SPDX-License-Identifier: BSD-3-Clause
// Echoes of a head from its images in mirrors, and from targets. All coordinates are in the axes of the head.
#include "acoustics/glints.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "acoustics/bent_chain_internal.hpp"
#include "acoustics/collect_echoes_internal.hpp"
#include "acoustics/edge_waves_internal.hpp"
#include "acoustics/find_legs_internal.hpp"
#include "acoustics/image_ways_internal.hpp"
#include "acoustics/reflection.hpp"
#include "core/parallel.hpp"
#include "core/require.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;
using complex = std::complex<double>;

constexpr const char* glints = "glint_echoes";
constexpr double same_image = 1e-6;  // [m]

/// Adds the ways to a sphere or cylinder and back, if the head is in front of it.
void add_ways_to(const SmoothTarget& target, const Pose& to_head, double wavenumber, std::vector<ImageWay>& ways) {
  const Vector3d middle = to_head * target.surface.place, axis = to_head.linear() * target.axis;
  const auto add = [&](const Vector3d& heard, const Vector3d& reflects, complex factor, complex rise, double grazing) {
    ways.push_back({2 * heard, 2 * heard, factor, {reflects}, {}, &target, edge_floor, rise});
    ways.back().scale(target.surface.reflection *
                      coherent_reflection_loss(wavenumber, target.surface.rms_height, grazing));  // (E152)
  };
  if (target.length > 0) {
    for (const BodyArrival& a : cylinder_arrivals(middle, axis, target.length, target.radius, wavenumber))
      add(a.apparent, a.place, a.factor, a.rise, a.grazing);
    return;
  }
  const double d = middle.norm() - target.radius;
  if (!(d > 0)) return;
  const Vector3d reflects = d / middle.norm() * middle;
  add(reflects, reflects, 1 / (1 + d / target.radius), 0, pi / 2);
}

/// Ways by one image as one.
std::vector<ImageWay> joined(const std::vector<ImageWay>& ways, const std::vector<std::uint8_t>& open) {
  std::vector<ImageWay> all;
  for (std::size_t w = 0; w < ways.size(); ++w) {
    if (!open[w]) continue;
    const auto same = std::find_if(all.begin(), all.end(), [&](const ImageWay& other) {
      return !other.target && !ways[w].target && (other.sent - ways[w].sent).norm() < same_image &&
             (other.heard - ways[w].heard).norm() < same_image;
    });
    if (same == all.end())
      all.push_back(ways[w]);
    else
      same->factor += ways[w].factor, same->rise += ways[w].rise;
  }
  return all;
}

/// The boundaries that mirrors are chained from; number of the first mirror.
std::pair<std::vector<Boundary>, std::size_t> all_boundaries(const SmoothShapes& shapes, const Environment& environment,
                                                             bool with_levels, const View& view,
                                                             const Transmission& sent) {
  std::vector<Boundary> all;
  if (with_levels)
    all = boundaries_of(environment, view.world_from_head, sent, MultipathOptions{}.boundary_tolerance, glints);
  const std::size_t first = all.size();
  for (Boundary& mirror : boundaries_of(shapes.mirrors, view.world_from_head, sent, glints))
    all.push_back(std::move(mirror));
  return {std::move(all), first};
}

/// The directions that legs by mirrors may have: the azimuths of the surfels, and elevations down to -80 dB one way.
SectorBounds directions_of_legs(const View& view, const Transmission& sent) {
  SamplingOptions sampling = view.sampling;
  sampling.elevation_half_extent = extent_of_legs(sent.echo_options);
  return SectorBounds(insonified_sector(view.fan, sampling));
}

/// Adds the echo of a way; and where it rises with frequency two more about it, which are opposite at the carrier and
/// the rise beside it (E179).
void add_echoes_of(const ImageWay& way, bool over_band, const Transmission& sent, Echoes& echoes) {
  constexpr double apart = 2;          // [rad] of the carrier, there and back, from the echo to either of the two
  constexpr double least_rise = 0.01;  // of the factor
  const double frequency = sent.pulse.centre_frequency, c = sent.medium.sound_speed;
  const double length = way.sent.norm(), cycles = frequency / c;
  const Vector3d out = way.sent / length, back = way.heard / length;
  const complex patterns = one_way_pattern(sent.echo_options, out.z()) * one_way_pattern(sent.echo_options, back.z()) *
                           transmit_pattern(sent.echo_options, std::atan2(out.y(), out.x()));
  const complex gain = patterns * way.factor;
  if (!(std::norm(gain) >= way.least * way.least)) return;
  const complex carrier = std::polar(1 / length, 2 * pi * reduced_cycles(cycles * length));
  const auto add = [&](double later, complex size) {
    add_echo(echoes, (length + later) / c, back.y(), back.z(), source_pressure(sent.pulse) * size * carrier);
  };
  add(0, gain);
  if (!over_band || !(std::norm(way.rise) > least_rise * least_rise * std::norm(way.factor))) return;
  const double later = apart / (2 * pi * cycles);
  const complex half = patterns * way.rise / complex(0, 2 * apart);
  add(later, half), add(-later, -half);
}

/// The bent counterparts, in a profile, of ways by images.
class BentWays {
 public:
  BentWays(const Environment& environment, const View& view, const Transmission& sent)
      : direct_(*environment.profile, environment.water.depth, view.world_from_head, sent.medium.absorption.a0) {}

  /// Bends a way; returns false if no ray takes it.
  bool bend(ImageWay& way) const {
    constexpr double specular = 1e-6;  // part of the way: an image is twice as far as the place that reflects it
    const bool one_place = way.bounces.size() == 1;
    const bool to_image =
        one_place && !way.target && (way.sent - 2 * way.bounces[0]).norm() < specular * way.sent.norm();
    if (one_place && !to_image) return bend_to_place(way);

    if (!has_image(way)) return is_corner(way) || !reflects(way) ? bend_to_place(way) : bend_chain(way);
    std::optional<BentLegs> by_level;
    for (const Boundary* boundary : way.by)
      if (tilt_of(*boundary) == BoundaryTilt::level)
        by_level.emplace(direct_.mirrored(boundary->head_distance, boundary->plane.normal().z() < 0));
    const BentLegs& rays = by_level ? *by_level : direct_;
    const auto out = rays.to(way.sent), back = rays.to(way.heard);
    if (!out || !back) return false;
    way.sent = out->apparent, way.heard = back->apparent;
    way.scale(out->pressure);
    return true;
  }

 private:
  /// Both legs are the ray to the place; what the way is longer than that, its phase, stays.
  bool bend_to_place(ImageWay& way) const {
    const Vector3d place = way.bounces[0];
    const auto leg = direct_.to(place);
    if (!leg) return false;
    const double longer = 2 * (leg->apparent.norm() - place.norm());
    const Vector3d turned = leg->apparent.normalized() - place.normalized();
    for (Vector3d* end : {&way.sent, &way.heard})
      *end = (end->norm() + longer) * (end->normalized() + turned).normalized();
    way.scale(leg->pressure * leg->pressure);
    return true;
  }

  /// Returns true if the way is one ray to an image: by upright mirrors and one level boundary at most.
  static bool has_image(const ImageWay& way) {
    std::size_t levels = 0;
    for (const Boundary* boundary : way.by) {
      if (tilt_of(*boundary) == BoundaryTilt::tilted) return false;
      levels += tilt_of(*boundary) == BoundaryTilt::level;
    }
    return levels < 2;
  }

  /// Returns true if all bounces are in one place, where mirrors meet.
  static bool is_corner(const ImageWay& way) {
    constexpr double one_place = 1e-3;  // [m]
    return way.bounces.size() > 1 && std::all_of(way.bounces.begin(), way.bounces.end(), [&](const Vector3d& bounce) {
             return (bounce - way.bounces[0]).norm() < one_place;
           });
  }

  /// False for the edge of a single mirror, and if the ray that the mirror reflects would meet it beyond its edges.
  bool reflects(const ImageWay& way) const {
    if (way.by.size() > 1 || way.by[0]->corners.empty()) return true;
    constexpr double face_on = 1e-3;  // [rad]
    if (way.by[0]->normal.cross(way.bounces[0]).norm() > face_on * way.bounces[0].norm()) return false;
    const auto chain = bent_chain(direct_, way.by, way.bounces, Vector3d::Zero());
    return !chain || way.by[0]->within_edges(chain->bounces[0]);
  }

  /// The way is the ray by its mirrors.
  bool bend_chain(ImageWay& way) const {
    const auto chain = bent_chain(direct_, way.by, way.bounces, Vector3d::Zero());
    if (!chain) return false;
    Vector3d from = Vector3d::Zero();
    for (std::size_t k = 0; k < way.by.size(); ++k) {
      const Boundary& mirror = *way.by[k];
      const Vector3d straight = (way.bounces[k] - from).normalized();
      const complex before = mirror.reflection(std::asin(std::min(1.0, std::abs(mirror.normal.dot(straight)))));
      if (before != 0.0) way.scale(mirror.reflection(chain->grazing_on(mirror, k)) / before);
      from = way.bounces[k];
    }
    way.sent = chain->leg.apparent;
    way.heard = -chain->leg.apparent.norm() * chain->leg.arrival;
    way.scale(chain->leg.pressure);
    return true;
  }

  BentLegs direct_;
};

}  // namespace

Echoes glint_echoes(const SceneCloud& scene, const SmoothShapes& shapes, const Environment& environment,
                    bool with_levels, const View& view, const Transmission& sent, const GlintOptions& options) {
  require(options.most_bounces >= 0 && options.most_bounces <= 6, glints, "options.most_bounces", options.most_bounces,
          "", "within 0 and 6");
  const double frequency = sent.pulse.centre_frequency, c = sent.medium.sound_speed, margin = pulse_margin(sent);
  const auto [mirrors, first] = all_boundaries(shapes, environment, with_levels, view, sent);
  std::vector<ImageWay> ways = image_ways(mirrors, first, options.most_bounces);
  std::vector<Mirror> plates;
  for (const SmoothTarget& target : shapes.targets) {
    if (target.radius == 0)
      plates.push_back(target.surface);
    else
      add_ways_to(target, view.world_from_head.inverse(), 2 * pi * frequency / c, ways);
  }
  const std::vector<Boundary> planes = boundaries_of(plates, view.world_from_head, sent, glints);
  for (const Boundary& plane : planes)
    for (ImageWay& way : image_ways({&plane, 1}, 0, 1)) ways.push_back(std::move(way));
  const SectorBounds sector = directions_of_legs(view, sent);
  std::erase_if(ways, [&](const ImageWay& way) {
    const double range = 0.5 * way.sent.norm();
    return range < view.gate.min_range - margin || range > view.gate.max_range + margin || !sector.holds(way.sent) ||
           !sector.holds(way.heard);
  });

  Echoes echoes;
  const std::vector<std::uint8_t> open = open_ways(scene, view, ways, sent.echo_options.threads);
  std::vector<ImageWay> heard = joined(ways, open);
  if (options.refraction && environment.profile) {
    const BentWays bent(environment, view, sent);
    const std::size_t unreached = std::erase_if(heard, [&](ImageWay& way) { return !bent.bend(way); });
    if (options.unreached) *options.unreached = unreached;
  }
  for (const ImageWay& way : heard) add_echoes_of(way, options.over_band, sent, echoes);
  return echoes;  // (E151)
}

}  // namespace insonify
