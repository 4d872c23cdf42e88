// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// Parameters of the relief below the spacing of the cloud: a fractal random height field fixed in world coordinates
/// (E52). A position therefore has the same slope in every ping and for every division of surfels.
struct MicroRelief {
  std::uint64_t seed = 1;
  double outer_scale = 0;  ///< longest wavelength [m]; 0: the scene's mean surfel spacing, sqrt(area)
  int octaves = 5;         ///< 1 .. 10; each halves wavelength and height of the one before
};

/// Evaluates the slopes of a MicroRelief at any position in closed form: a sum of plane waves in space, six per octave,
/// with random phases and random wavelengths within their octave:
///
///   gradient(x) = sum_j sqrt(1 / T) k_j sin(2 pi (k_j . x / wavelength_j + phase_j)),  T triads of directions k_j
///
/// The directions form randomly rotated orthogonal triads. For every seed and every plane the slope variance along each
/// direction in the plane is therefore exactly 1/2, and the rms slope is 1. Positions are in double: 1000 km from the
/// world's zero the phase of a 2 mm wave is still accurate to 1e-6 of a cycle.
class ReliefField {
 public:
  /// Throws Error unless outer_scale is finite and > 0 and octaves are in 1 .. 10.
  explicit ReliefField(const MicroRelief& relief);

  /// Returns the gradient [1] at `world_position` [m]; its component tangential to a surface is the slope there, of rms
  /// 1.
  Eigen::Vector3d gradient(const Eigen::Vector3d& world_position) const;

 private:
  using PerWave = Eigen::Array<double, 6, 1>;  // the six waves of one octave: two triads
  struct Octave {
    PerWave x, y, z, phase;             ///< cycles per metre; cycles
    PerWave slope_x, slope_y, slope_z;  ///< amplitude of the wave's slope
  };
  std::vector<Octave> octaves_;
};

/// Returns the unit vector `normal` tilted by the slope of the relief at `world_position` [m] (E52). `rms_slope` [rise
/// over run] scales the field: the mean of tan^2 of the tilt is rms_slope^2.
Eigen::Vector3d tilted_normal(const ReliefField& field, double rms_slope, const Eigen::Vector3d& world_position,
                              const Eigen::Vector3d& normal);

/// The relief of the surfaces of a scene: one field for the scene, or one for each of its parts. The field of a part is
/// fixed in the part's own axes and moves with the part.
class SceneRelief {
 public:
  /// Sets up the fields. The outer scale of a part's field is the spacing of the part. Throws as ReliefField.
  SceneRelief(const SceneCloud& scene, const MicroRelief& relief);

  /// Returns the normal of a surfel, tilted by tilted_normal at `world_position` [m].
  Eigen::Vector3d facet_of(const SceneCloud& scene, std::size_t surfel, double rms_slope,
                           const Eigen::Vector3d& world_position) const;

 private:
  std::vector<ReliefField> fields_;
};

/// Returns the relief of a scene, or nothing if all of its materials are smooth (relief_slope = 0).
std::optional<SceneRelief> relief_of(const SceneCloud& scene, MicroRelief relief);

}  // namespace insonify
