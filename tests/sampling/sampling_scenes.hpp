#pragma once
#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "core/error.hpp"
#include "core/units.hpp"
#include "sampling/find_scatterers.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Adds a rectangle with one surfel per cell of about `spacing`, moved from its centre by up to `jitter`
/// cells.
inline void add_rectangle(SceneCloud& scene, const Eigen::Vector3d& corner, const Eigen::Vector3d& u,
                          const Eigen::Vector3d& v, const Eigen::Vector3d& normal, double spacing, double jitter = 0) {
  std::mt19937 random(static_cast<unsigned>(scene.size()) + 7);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  const double nu = std::round(u.norm() / spacing), nv = std::round(v.norm() / spacing);
  for (double i = 0; i < nu; ++i)
    for (double j = 0; j < nv; ++j) {
      const double a = (i + 0.5 + shift(random)) / nu, b = (j + 0.5 + shift(random)) / nv;
      add_surfel(scene, corner + a * u + b * v, normal, u.norm() * v.norm() / (nu * nv));
    }
}

/// Adds a sphere of n surfels on a Fibonacci spiral, each with 1/n of the area; side = -1: normals inward.
inline void add_sphere(SceneCloud& scene, const Eigen::Vector3d& centre, double radius, int n, double side = 1) {
  for (int k = 0; k < n; ++k) {
    const double z = 1 - (2 * k + 1.0) / n, turn = k * pi * (3 - std::sqrt(5.0)), s = std::sqrt(1 - z * z);
    const Eigen::Vector3d d(s * std::cos(turn), s * std::sin(turn), z);
    add_surfel(scene, centre + radius * d, side * d, 4 * pi * radius * radius / n);
  }
}

/// A wall at x that faces the head at the origin.
inline void add_wall(SceneCloud& scene, double x, double half_width, double half_height, double spacing,
                     double jitter = 0) {
  add_rectangle(scene, {x, -half_width, -half_height}, {0, 2 * half_width, 0}, {0, 0, 2 * half_height}, {-1, 0, 0},
                spacing, jitter);
}

inline BeamFan wide_fan() { return make_fan(91, radians(90), radians(1), radians(60)); }
inline RangeGate long_gate() { return {0.1, 100, 0.05}; }

/// Options for visibility alone: every visible surfel is one scatterer at its centre.
inline SamplingOptions unsplit() { return {.scatterers_per_cell = 0}; }

inline Pose at(double x, double y, double z, double yaw_deg = 0, double pitch_deg = 0) {
  return pose_from_yaw_pitch_roll({x, y, z}, radians(yaw_deg), radians(pitch_deg), 0);
}

inline bool equal(const Scatterers& a, const Scatterers& b) {
  return a.range == b.range && a.azimuth == b.azimuth && a.elevation == b.elevation &&
         a.cos_incidence == b.cos_incidence && a.projected_area == b.projected_area && a.material == b.material &&
         a.id == b.id && a.surfel == b.surfel;
}

inline std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace insonify
