// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "acoustics/echoes.hpp"
#include "acoustics/environment.hpp"
#include "acoustics/multipath_echoes.hpp"
#include "acoustics/surface_scattering.hpp"
#include "acoustics/transmission.hpp"
#include "scene/prepared_scene.hpp"

namespace insonify {

/// Echoes by way of two surfaces.
struct DoubleEchoes {
  Echoes echoes;                     ///< both senses of a pair are neighbours
  std::vector<std::uint32_t> first;  ///< surfel that the sound of each echo met first, index in the scene
  std::vector<std::uint32_t> last;   ///< surfel from which it came back
  std::vector<std::uint64_t> id;     ///< id of the pair, from its surfel and ray, one for both senses
  std::size_t rays = 0;              ///< number of rays sent from surface to surface
  std::size_t unreached = 0;         ///< number of echoes left out because a leg lies in a shadow zone of the profile
};

/// Options of double_echoes.
struct DoubleEchoOptions {
  /// Rays sent from each cell of range resolution and beam width of the surface that the head sees, on average, within
  /// 1e-6 and 1e6. More are sent where others have met a surface. The error of the expected level of a piece of image
  /// falls with the root of its rays.
  double rays_per_cell = 1;
  const Environment* through = nullptr;  ///< whose profile all three legs run through; none: legs are straight
};

/// Returns the echoes by way of two rough surfaces: out to a patch i, on to a patch j, and back (E158).
///
///   amplitude = sqrt2 p0 xi_ij sqrt(sigma_i(h, j) dA_i sigma_j(i, h) dA_j) b_o b_i exp(i k (r_i + r_ij + r_j))
///               / (r_i r_ij r_j),   delay = (r_i + r_ij + r_j) / c
///
/// sigma is the law of a surface for both directions of its path, b the one-way pattern of each leg (the square root of
/// the two-way pattern E14; times E57 on the leg out). u and v are those of the leg back from j. Sound also goes from j
/// to i: another echo of the same delay and amplitude, with the same random number xi_ij, from the other direction. A
/// beam that holds both directions adds them coherently, and receives twice the power of a radiosity sum.
///
/// Pairs are drawn by rays (E159): from patch i, half of them by its cosine, half over the lobe of its law, if it has
/// one. A ray stands for sigma_i sigma_j density / (n_i pdf_i cos_j + n_j pdf_j cos_i), n the rays per area from either
/// end, in place of both cross-sections and of r_ij^2 (balance heuristic of Veach 1997, 9.2). The expected power is
/// that of the sum over all pairs. Rays and xi are bound to surfels: they stand still while the head moves.
///
/// seen     the surfels that the head sees, indices in the scene, ascending: both ends are among them
/// returns  two echoes for each ray that meets a surfel of `seen`, without echoes that the patterns reduce by more than
///          80 dB, or whose half path lies farther outside the view's gate than the pulse reaches
///
/// Through a profile each leg is the ray between its ends (E43): travel times are those of the rays, laws have their
/// angles, and each leg has the spreading of its tube (E167, E178). What a surfel meets is found by straight rays, and
/// their weights are those of straight ones.
///
/// Echoes by way of three surfaces and more are left out. Surfels are smooth. The result does not depend on the number of
/// threads. Throws Error for an invalid argument, and Error(runtime) without Embree.
DoubleEchoes double_echoes(const PreparedScene& scene, std::span<const std::uint32_t> seen, const View& view,
                           const Transmission& sent, const DoubleEchoOptions& options = {});

/// A piece of surface, in head axes [m].
struct SurfacePoint {
  Eigen::Vector3d at, normal;
};

/// Change that a profile makes to the echo by way of two positions.
struct RefractedPair {
  std::size_t first = 0, last = 0;
  PathAngles here{}, there{};  ///< angles at both positions: in from the head, out to the other position
  double longer = 0;           ///< apparent path of all three legs, less that of straight ones [m]
  double turned = 0;           ///< change of the direction cosine u of the last position
  double pressure = 1;         ///< pressure by all three legs, over that by straight ones
};

/// Returns the change for every ordered pair of places that rays join and that face each other.
std::vector<RefractedPair> refracted_pairs(std::span<const SurfacePoint> positions, const Environment& environment,
                                           const Pose& world_from_head, const Medium& medium);

/// Returns a scatterer for each double echo at its apparent position: at half the path, in the direction of the last
/// surfel, through a profile that of the ray to it, with id, material and surfel of the last surfel. Areas and incidence are empty.
Scatterers apparent_positions(const DoubleEchoes& doubles, const SceneCloud& scene, const Pose& world_from_head,
                              double sound_speed, const Environment* through = nullptr);

}  // namespace insonify
