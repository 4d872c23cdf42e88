// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <optional>
#include <vector>

#include "acoustics/boundary_internal.hpp"
#include "acoustics/find_legs_internal.hpp"
#include "acoustics/refracted_legs_internal.hpp"
#include "sampling/scatterers.hpp"

// Private to acoustics: legs between a head and patches, directly and by boundaries, straight or through a profile.
namespace insonify {

/// One leg between head and patch, in the axes of the head.
struct Leg {
  double range;               ///< [m]
  double u, v;                ///< direction cosines
  double cosine;              ///< at the patch
  Eigen::Vector3d towards;    ///< unit vector from the patch along it
  std::complex<double> gain;  ///< one-way pattern times reflection
  std::complex<double> sent;  ///< gain of the leg out: with the transmitter's pattern in azimuth too
  std::uint8_t by;            ///< 0: direct; k: by the k-th boundary
};

/// The legs of a view's patches. Refers to its arguments.
class PatchLegs {
 public:
  /// With `through` legs run through its profile, if it has one: rays to places, to their images in level boundaries and
  /// upright mirrors, and by way of tilted mirrors (E177).
  PatchLegs(const SceneCloud& scene, const std::vector<Boundary>& boundaries, const View& view,
            const Transmission& sent, const Environment* through);

  /// Readies rays to many patches.
  void prepare(const Scatterers& patches);

  /// Sets `legs` to those of `open` to one patch that reach its front, the direct one first. Returns how many no ray has.
  /// cosines      true if the cosine of the patch holds for a straight direct leg
  std::size_t find(const Scatterers& patches, std::size_t i, LegSet open, bool cosines, std::vector<Leg>& legs) const;

 private:
  /// A leg, and the reflection on it.
  struct Path {
    RefractedLeg leg;
    std::complex<double> reflection = 1;
  };
  std::optional<Path> refracted_path_to(const Eigen::Vector3d& position, std::size_t by) const;
  std::optional<Path> path_by_tilted_mirror_to(const Eigen::Vector3d& image, const Boundary& boundary) const;
  /// Sets a leg but for its gains.
  void set_leg(const RefractedLeg& way, double range, std::uint32_t surfel, const Eigen::Vector3d& normal,
               Leg& leg) const;
  void set_gains(const RefractedLeg& way, std::complex<double> reflection, std::size_t by, Leg& leg) const;
  /// Sets the leg to a position, or by boundary `by` to its image; false if no ray reaches it.
  bool set_leg_to(std::uint32_t surfel, const Eigen::Vector3d& position, const Eigen::Vector3d& normal, std::size_t by,
                  Leg& leg) const;

  const SceneCloud& scene_;
  const std::vector<Boundary>& boundaries_;
  const EchoOptions& echo_options_;
  Eigen::Matrix3d to_head_;
  std::vector<std::optional<RefractedLegs>>
      rays_;  // to places, 0, and to images, k by the k-th boundary; none: it is tilted
};

}  // namespace insonify
