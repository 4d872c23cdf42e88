// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "scene/material.hpp"

namespace insonify {

/// The directions i, towards where the sound comes from, and o, towards where it goes, at a point of a surface of
/// normal n.
struct PathAngles {
  double cos_in = 1;       ///< i . n
  double cos_out = 1;      ///< o . n
  double cos_between = 1;  ///< i . o; 1: straight back
};

/// The scattering of a surface for one frequency and one water, computed from a SurfaceLaw. All laws are isotropic about
/// the normal and reciprocal: i and o may change places. Safe to use from several threads.
class SurfaceScattering {
 public:
  virtual ~SurfaceScattering() = default;
  /// Returns the cross-section per area and solid angle [1/sr], mu (i . n) (o . n) by Lambert's law; 0 unless both
  /// cosines are > 0.
  virtual double cross_section(const PathAngles& path) const = 0;
  /// Returns the cross-section per area as seen from the direction of incidence: divided by cos_in, which is > 0.
  virtual double per_seen_area(const PathAngles& path) const { return cross_section(path) / path.cos_in; }
  /// Returns per_seen_area straight back, at this cosine of incidence > 0, from a table.
  virtual double back(double cosine) const = 0;
  /// Returns the root mean square of the slope of the facets that make the law's lobe about the specular direction,
  /// over both axes; 0: no lobe.
  virtual double lobe_slope() const { return 0; }
};

/// The scattering of each material of a scene for one frequency and water: SurfaceLaw is data, SurfaceScattering the
/// law as computed.
using SurfaceTable = std::vector<std::shared_ptr<const SurfaceScattering>>;

/// Returns the laws of `materials` for sound of `frequency` [Hz] in water of `sound_speed` [m/s], tabulated.
SurfaceTable surface_table(std::span<const Material> materials, double frequency, double sound_speed);

/// A patch of a surface as the legs out and back of one echo meet it.
struct InsonifiedPatch {
  double cos_out = 1;      ///< cosine between the normal and the leg out, in [0, 1]
  double cos_back = 1;     ///< cosine between the normal and the leg back
  double seen_area = 0;    ///< [m^2], as seen along the leg out: cos_out dS, or solid angle of a ray x range^2
  double cos_between = 1;  ///< cosine between the two legs; 1: they are one line
};

/// Returns the cross-section [m^2] of a patch; 0 unless both cosines are > 0.
double cross_section(const SurfaceScattering& surface, const InsonifiedPatch& patch);

/// Returns the cross-section by Lambert's law alone [m^2] (E4): lambert_mu cos_back seen_area. The area as seen holds
/// one cosine already, so that this is mu cos^2 dS for a surfel whose legs out and back are one line, and mu cos r^2
/// dOmega for a ray.
double lambert_cross_section(double lambert_mu, double cos_back, double seen_area);

/// Returns the direction (normal = z) in which sound from direction `in` goes on, for two numbers in [0, 1): half of
/// them fall by the cosine, half off facets of rms slope `lobe_slope` (all by the cosine if that is 0). May lead into
/// the surface.
Eigen::Vector3d sampled_direction(double lobe_slope, const Eigen::Vector3d& in, double number, double turn);

/// Returns the density [1/sr] of these directions (E138): cos_out / pi, and of facets exp(-tan^2 t / S^2) / (pi S^2
/// cos^4 t) cos t / (4 cos d), t between normal and facet, d of incidence on the facet.
double sampling_density(double lobe_slope, const PathAngles& path);

/// Returns the fraction of the power arriving at cosine `cos_in` > 0 that the surface scatters: integral of the
/// cross-section over all directions, over cos_in. By 8192 directions of sampled_direction, within 0.001.
double albedo(const SurfaceScattering& surface, double cos_in);

}  // namespace insonify
