// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "acoustics/boundary_internal.hpp"
#include "acoustics/fit_shapes.hpp"

namespace insonify {

/// A way to an image of the head and back from it, in head axes.
struct ImagePath {
  Eigen::Vector3d outgoing, returning;     ///< apparent positions of the image on the way out, and on the way back
  std::complex<double> factor = 1;         ///< reflections and edges
  std::vector<Eigen::Vector3d> bounces{};  ///< places at which it bounces
  std::vector<const Boundary*> by{};       ///< off these
  const SmoothTarget* target = nullptr;    ///< or off this
  double least = echo_floor;               ///< least factor with patterns that counts
  std::complex<double> rise = 0;           ///< change of the factor with wavenumber, times the wavenumber

  /// Scales the factor at all wavenumbers.
  void scale(std::complex<double> with) { factor *= with, rise *= with; }
};

/// Least factor of an edge or a corner re the image of the head: -120 dB. A plate turned by 40 degrees still has it.
inline constexpr double edge_floor = 1e-6;

/// Returns the paths by up to `most` mirrors one after the other (E151), at least one of them at index `first` or
/// later, on which reflections and edges leave at least -80 dB. By one mirror with edges these are paths by its specular
/// point, by each edge and by each corner (E164, E165), down to -120 dB; by several, edges change the level of the
/// image alone (E150).
std::vector<ImagePath> image_paths(std::span<const Boundary> mirrors, std::size_t first, int most);

/// Returns for each way whether the surfels of a scene leave it open: they block it, if the view has occlusion, and a
/// target must have surfels where it reflects.
std::vector<std::uint8_t> unblocked_paths(const SceneCloud& scene, const View& view,
                                          const std::vector<ImagePath>& paths, int threads);

}  // namespace insonify
