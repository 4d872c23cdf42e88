// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/moving_parts.hpp"

#include <cmath>

#include "core/error.hpp"

namespace insonify {

using Eigen::Vector3d;

std::vector<Vector3d> meet_moving_parts(const SceneCloud& scene, const Pose& world_from_head, double c,
                                        Scatterers& scatterers) {
  std::vector<Vector3d> velocity;
  if (!moves(scene)) return velocity;
  velocity.assign(scatterers.size(), Vector3d::Zero());
  const Eigen::Matrix3d to_head = world_from_head.linear().transpose();
  for (std::size_t i = 0; i < scatterers.size(); ++i) {
    const ScenePart& part = *scene.part_of_surfel(scatterers.surfel[i]);
    if (!part.moves()) continue;
    const double r = scatterers.range[i];
    const Vector3d d = r * unit_vector({scatterers.azimuth[i], scatterers.elevation[i]});
    const Vector3d origin = to_head * (part.world_from_part.translation() - world_from_head.translation());
    const Vector3d w = to_head * part.velocity + (to_head * part.turn_rate).cross(Vector3d(d - origin));
    if (!(w.norm() < c / 100))
      fail(ErrorKind::argument, "part '", part.name, "': a surfel moves at ", w.norm(),
           " m/s, must be below a hundredth of the sound speed, ", c / 100, " m/s");

    // The sphere of sound meets the scatterer: a quadratic equation in the time. (E145)
    const double along = w.dot(d), rest = c * c - w.squaredNorm();
    const double time = (along + std::sqrt(along * along + rest * r * r)) / rest;
    const Vector3d met = d + time * w;
    const Direction direction = direction_of(met);
    velocity[i] = w;
    scatterers.range[i] = c * time;
    scatterers.azimuth[i] = direction.azimuth;
    scatterers.elevation[i] = direction.elevation;
  }
  return velocity;
}

void shift_by_parts(const std::vector<Vector3d>& velocity, const Motion& head, const Pose& world_from_head,
                    const Scatterers& scatterers, double centre_frequency, double c, Echoes& echoes) {
  if (velocity.empty()) return;
  if (echoes.doppler.empty()) echoes.doppler.assign(echoes.size(), 0);
  const Vector3d v = world_from_head.linear().transpose() * head.velocity;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const Vector3d& w = velocity[i];
    if (w.isZero(0)) continue;
    const Vector3d out = unit_vector({scatterers.azimuth[i], scatterers.elevation[i]});
    const Vector3d back = (scatterers.range[i] * out - echoes.delay[i] * v).normalized();
    const double of_head = centre_frequency + echoes.doppler[i];
    echoes.doppler[i] = of_head * (c - w.dot(out)) / (c + w.dot(back)) - centre_frequency;  // (E146)
  }
}

}  // namespace insonify
