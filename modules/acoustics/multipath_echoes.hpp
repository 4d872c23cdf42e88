// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "acoustics/direct_echoes.hpp"
#include "acoustics/echoes.hpp"
#include "acoustics/environment.hpp"
#include "acoustics/transmission.hpp"
#include "sampling/find_scatterers.hpp"

namespace insonify {

/// A plane that mirrors sound, in the world [m]; its normal points into the water.
using MirrorPlane = Eigen::Hyperplane<double, 3>;

/// Legs on which sound went out to a patch and came back: 0 direct, k by the k-th boundary (first the surface, then the
/// bottom, then the mirrors).
struct LegPair {
  std::uint8_t out = 0, back = 0;

  /// Returns the number of legs by a boundary: 0, 1 or 2.
  int bounces() const { return (out != 0) + (back != 0); }
  bool operator==(const LegPair&) const = default;
};

/// Echoes by the boundaries, and how many of each kind.
struct Multipath {
  Echoes echoes;
  std::vector<std::uint32_t> surfel{};  ///< surfel of each echo, index in the scene
  std::vector<LegPair> legs{};          ///< legs of each echo
  std::vector<MirrorPlane> planes{};    ///< boundaries by which legs are numbered
  std::size_t one_bounce = 0;           ///< out direct and back by a boundary, or the other way round
  std::size_t two_bounces = 0;          ///< out and back by a boundary
  std::size_t blocked = 0;              ///< legs from surfels by a boundary that the scene hides
  std::size_t unreached = 0;            ///< legs of patches that no ray of the profile has
};

/// View of a head, for later stages.
struct View {
  Pose world_from_head = Pose::Identity();
  BeamFan fan;
  RangeGate gate;
  SamplingOptions sampling;
};

/// Options of multipath_echoes.
struct MultipathOptions {
  /// Captured surfels along a boundary (within 60 degrees) that are nearer to it than this [m], and than three times
  /// its rms relief, count as the boundary itself: they neither block a bounce off it nor give an echo by one.
  double boundary_tolerance = 0.3;
  /// True if legs run through the profile of the environment, if it has one (E43, E167, E177).
  bool refraction = false;
};

/// Returns the echoes whose leg out, leg back or both touch the surface or the bottom of `environment` once (E48). They
/// follow from images: the scene mirrored in each boundary.
///
///   amplitude = sqrt2 p0 xi sqrt(mu cos_o cos_i dS) b_o b_i R_o R_i exp(i k (r_o + r_i)) / (r_o r_i)
///   delay     = (r_o + r_i) / c
///
/// o is the leg out, i the leg back; r, cos, b and R are a leg's length, cosine at the patch, one-way elevation pattern
/// (the square root of the two-way pattern E14; times E57 on the leg out) and reflection: bottom_reflection, or -1 at
/// the surface, times coherent_reflection_loss; 1 without a bounce. u and v are those of the leg back. A mixed path
/// gives two echoes of one delay and size, one for each sense, which add coherently where the beam holds both
/// directions. The result holds no direct echoes.
///
/// Every leg is tested for occlusion: before the bounce against the scene itself, behind it against its image. Surfels
/// beyond a boundary have no leg by it, and those above the surface none at all. Sector in azimuth and gate are the
/// view's; in elevation the sector goes on to where the one-way pattern is -80 dB, and everywhere without a pattern.
/// Echoes are left out whose pattern and reflection take off more than 80 dB, or whose apparent range (r_o + r_i) / 2
/// is farther outside the gate than the pulse reaches.
///
/// direct   what the head sees directly, of the same view. Its patches keep places and amplitude xi on all their paths;
///          those seen only by a boundary are found and split here. With rays it is not used: patches are surfels then,
///          whose xi is not that of the rays.
///
/// With `refraction` a leg is the ray to the position or to its image: by a level boundary through the profile and its
/// image in the boundary, by an upright mirror through the profile itself, each within one degree. By a plane that is
/// tilted it is the ray that the plane reflects (E177). `direct` holds straight places all the same.
/// Visibility is that of straight legs. Legs take the smooth surfel for the facet.
/// Does not depend on the thread count. Throws Error if there is no boundary, the head is not in the water, or an
/// invalid environment, pulse or medium is met.
Multipath multipath_echoes(const SceneCloud& scene, const Scatterers& direct, const Environment& environment,
                           const View& view, const Transmission& transmission, const MultipathOptions& options = {});

/// Returns the same by way of `mirrors`: the echoes with at least one leg by a mirror. The others are direct or, if
/// `with_levels`, by surface and bottom. A leg by a mirror has the factor
///
///   R exp(-2 (k H cos)^2) F                                                                      (E47, E148, E150)
///
/// with R its reflection, H its rms height, cos that of incidence and F what its edges let through, by the Fresnel
/// parameters of the corners of the plane. Only mirrors that face the head count; those without edges must. Surfels
/// that are a mirror's own (Mirror::thickness) have no legs by it.
Multipath mirror_echoes(const SceneCloud& scene, const Scatterers& direct, const Environment& environment,
                        std::span<const Mirror> mirrors, bool with_levels, const View& view,
                        const Transmission& transmission, const MultipathOptions& options = {});

/// Adds `more`, which has v, at the end of `echoes`. If either has Doppler shifts, those of the other are 0.
void append(Echoes& echoes, const Echoes& more);

/// Returns the range [m] beyond which neither a surfel nor its image takes part in multipath_echoes. By the triangle
/// inequality two legs to one patch differ by no more than twice the head's distance from the farther boundary, so
/// neither is longer than their mean, which lies within the gate and a pulse, by more than that distance.
double longest_leg(const Environment& environment, std::span<const Mirror> mirrors, const View& view,
                   const Transmission& transmission);

/// Returns the largest pressure factor of roughness on a bounce off any boundary within the view's gate: 1 for a smooth
/// boundary, 0 without boundaries. It bounds the error without multipath, for each mixed path, relative to a direct
/// echo of the same length and pattern.
double strongest_bounce(const Environment& environment, const View& view, const Transmission& transmission);

}  // namespace insonify
