#pragma once
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "returns/insonification.hpp"

namespace insonify {

/// What the pings of a survey did to one surfel (E97).
struct CoveredSurfel {
  std::uint32_t id = 0;                                ///< SceneCloud::id
  std::uint32_t pings = 0;                             ///< that insonified it
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< world [m]
  float grazing_angle = 0;                             ///< largest [rad]; pi/2: normal incidence
  float range = 0;                                     ///< least [m]
  double intensity = 0;                                ///< sum over the pings [Pa^2] of the mean square (E64)

  bool operator==(const CoveredSurfel&) const = default;
};

/// The surfels that a ping insonified, by ascending id; errors as insonified_surfels.
std::vector<CoveredSurfel> coverage_of(const SceneCloud& scene, const Scatterers& scatterers, const SonarHead& head,
                                       const Medium& medium, const InsonificationOptions& options = {});

/// Adds what further pings did to the same surfel: pings and intensities add up, of angle and range the best is kept.
void add(CoveredSurfel& to, const CoveredSurfel& more);

/// Adds `more` to `to`, both by ascending id. Sums depend in their last bits on the order of the calls.
void add(std::vector<CoveredSurfel>& to, const std::vector<CoveredSurfel>& more);

}  // namespace insonify
