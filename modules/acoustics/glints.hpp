// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>

#include "acoustics/fit_shapes.hpp"
#include "acoustics/multipath_echoes.hpp"

namespace insonify {

/// Options of glint_echoes.
struct GlintOptions {
  int most_bounces = 3;  ///< off mirrors, surface and bottom, one after the other
  /// True if ways run through the profile of the environment, if it has one (E43, E167): to targets and to edges as two
  /// rays to the position; by upright mirrors and one level boundary as the ray to the image; by other mirrors as the ray
  /// that they reflect (E177), without a new place on their edges.
  bool refraction = false;
  /// True if edges and corners rise or fade over the band (E179), by two more echoes each, which are opposite at the
  /// carrier: not for sums of power.
  bool over_band = true;
  std::size_t* unreached = nullptr;  ///< takes the number of ways that no ray of the profile has
};

/// Returns the echoes of a head's own image: sound that returns by way of one to `most_bounces` mirrors, and by way of
/// targets.
///
///   amplitude = sqrt2 p0 b_o b_i R F exp(i k L) / L                                                  (E151)
///
/// L is the length of the path, that of a straight line to the image of the head in all mirrors one after the other (2
/// d for one mirror d away); b is as in E48; R is the product of the reflections (E47, E148); F is the factor of all
/// edges (E150), of the polygon in which the mirrors overlap across the line. Two mirrors that meet at a right angle
/// are a corner: its image lies on the edge, and each order, A before B and B before A, has the half of the aperture
/// where it meets A first. Of a mirror without edges, the part in front of the others on the way counts. Ways of one
/// image add up and are one echo. Of one mirror with edges, the specular point, each edge and each corner are echoes of
/// their own, with their own delays, directions and patterns (E164, E165). The edge along which two mirrors meet is one
/// of these: it coincides with the image of the corner, and is weak beside it.
///
/// A target at its least distance d has (E152)
///
///   amplitude = sqrt2 p0 b^2 R exp(-2 (k H)^2) F exp(2 i k d) / (2 d sqrt((1 + d / a1) (1 + d / a2)))
///
/// with a1 and a2 its radii of curvature there: both that of a sphere, one of them infinite for a cylinder, both for a
/// plate. Edges and corners of plates (E164) and ends of cylinders (E166) are echoes of their own. It is the integral
/// of Kirchhoff over the surface without the waves of its shadow's edge, by stationary phase across the curved
/// directions. Targets are not mirrors: echoes of other surfaces by way of targets are left out, and so are echoes of
/// targets by way of mirrors.
///
/// A way is left out that leaves or arrives outside of the sector of surfels (insonified_sector of the view, with all
/// elevations in which the pattern of one way leaves -80 dB), that surfels block that belong neither to its mirrors nor
/// to its target, that is shorter or longer than twice the gate and a pulse, or of which reflections, edges and
/// patterns leave less than -80 dB (-120 dB of one plate or target); a target's, if it has no surfel where it would
/// reflect. The mirrors are those that mirror_echoes takes; with `with_levels` surface and bottom are mirrors too, but
/// each way has at least one of `shapes`.
Echoes glint_echoes(const SceneCloud& scene, const SmoothShapes& shapes, const Environment& environment,
                    bool with_levels, const View& view, const Transmission& transmission,
                    const GlintOptions& options = {});

}  // namespace insonify
