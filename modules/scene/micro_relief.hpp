#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// Relief finer than the spacing of the cloud: a fractal random height field bound to the world (E52), so that the same
/// place has the same slope in every ping and for every splitting.
struct MicroRelief {
  std::uint64_t seed = 1;
  double outer_scale = 0;  ///< longest wavelength [m]; 0: the scene's mean surfel spacing, sqrt(area)
  int octaves = 5;         ///< 1 .. 10; each half as long as the one before, with half its height
};

/// Slopes of a MicroRelief at any place, in closed form: a sum of plane waves in space, six to the octave, of random
/// phase and of random length within their octave:
///
///   gradient(x) = sum_j sqrt(1 / T) k_j sin(2 pi (k_j . x / wavelength_j + phase_j)),  T triads of directions k_j
///
/// The directions come in randomly turned right-angled triads. That makes the slopes' variance over any plane, however
/// it lies and for every seed, exactly 1/2 along each direction in it: the rms slope is 1. Places in double:
/// a thousand kilometres from zero the phase of a 2 mm wave is still good to 1e-6 of a cycle.
class ReliefField {
 public:
  /// Throws Error unless outer_scale is finite and > 0 and octaves are in 1 .. 10.
  explicit ReliefField(const MicroRelief& relief);

  /// Gradient [1] at `world_position` [m]; its part along a surface is the slope there, of rms 1.
  Eigen::Vector3d gradient(const Eigen::Vector3d& world_position) const;

 private:
  using PerWave = Eigen::Array<double, 6, 1>;  // of one octave: two triads
  struct Octave {
    PerWave x, y, z, phase;             ///< cycles per metre; cycles
    PerWave slope_x, slope_y, slope_z;  ///< the wave's largest slope
  };
  std::vector<Octave> octaves_;
};

/// `normal` tilted by the slope of the relief at `world_position` [m]; unit length, as `normal`. `rms_slope` [rise over
/// run] scales the field: the mean of tan^2 of the tilt is rms_slope^2 (E52).
Eigen::Vector3d tilted_normal(const ReliefField& field, double rms_slope, const Eigen::Vector3d& world_position,
                              const Eigen::Vector3d& normal);

/// The field that the scene's materials call for; nothing if they all are smooth.
std::optional<ReliefField> relief_of(const SceneCloud& scene, MicroRelief relief);

}  // namespace insonify
