// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/glints.hpp"
#include "support/heads.hpp"
#include "support/point_targets.hpp"
#include "support/ray_tube.hpp"
#include "support/test.hpp"

namespace insonify::bent_bounces {

/// A thermocline of 53 m/s over 4 m, and one of 10 m/s.
inline const SoundSpeedProfile thermoclines[] = {{{0, 6, 10, 30}, {1530, 1530, 1477, 1477}},
                                                 {{0, 5, 9, 30}, {1500, 1500, 1490, 1490}}};

/// A head in a profile, with the rays from it.
struct Bench {
  Environment environment;
  View view;
  Transmission sent;
  double head_depth, speed;

  Bench(const SoundSpeedProfile& profile, double depth, double yaw, double pitch, double roll) : head_depth(depth) {
    environment.profile = profile;
    environment.water.depth = depth;
    view.world_from_head = pose_from_yaw_pitch_roll({300, -70, -depth}, yaw, pitch, roll);
    view.fan = make_fan(64, radians(170), radians(2), radians(150));
    view.gate = {0.5, 120, 0.1};
    view.sampling.elevation_half_extent = pi / 2;
    speed = sound_speed_at(profile, depth);
    sent.pulse = pulse_900k;
    sent.medium = {speed, {}};
    sent.echo_options.amplitude = SurfaceAmplitude::coherent;
  }
  Eigen::Vector3d head() const { return view.world_from_head.translation(); }
  traced::Water water() const { return {environment.profile->depth, environment.profile->sound_speed}; }
  /// Returns the water with its image above the surface at depth 0.
  traced::Water with_surface() const {
    traced::Water both = water();
    for (std::size_t k = 1; k < environment.profile->depth.size(); ++k) {
      both.depth.insert(both.depth.begin(), -environment.profile->depth[k]);
      both.speed.insert(both.speed.begin(), environment.profile->sound_speed[k]);
    }
    return both;
  }
  traced::Arrival ray(const traced::Water& in, const Eigen::Vector3d& position) const {
    const Eigen::Vector3d way = position - head();
    return traced::fastest_arrival(in, head_depth, head_depth - way.z(), std::hypot(way.x(), way.y())).value();
  }
  /// Returns the direction cosines at the head of a ray that leaves in the vertical plane of a position.
  Eigen::Vector3d beam_azimuth(const Eigen::Vector3d& position, double launch) const {
    const Eigen::Vector3d way = position - head();
    const double out = std::hypot(way.x(), way.y());
    return view.world_from_head.linear().transpose() *
           Eigen::Vector3d(std::cos(launch) * way.x() / out, std::cos(launch) * way.y() / out, std::sin(launch));
  }
};

}  // namespace insonify::bent_bounces
