// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

namespace insonify {

/// Kinds of amplitude shading.
enum class Shading { uniform, taylor, hamming, chebyshev };

/// Returns the name used in sonar files: "uniform", "taylor", "hamming", "chebyshev".
const char* shading_name(Shading shading);

/// Returns the weights of one kind; sum = elements. side_lobe_db is used by Taylor and Chebyshev only. Throws as they
/// do.
std::vector<double> shading_weights(Shading shading, std::size_t elements, double side_lobe_db);

/// Returns weights of 1.
std::vector<double> uniform_shading(std::size_t elements);

/// Returns Taylor weights (E11) with nearly equal side lobes at `side_lobe_db` (negative, e.g. -30) over the first
/// `nbar` of them, decaying beyond; sum = elements. Taylor (1955), sampled at the element positions. Throws Error
/// unless elements >= 1, -80 <= side_lobe_db < -13.3 and nbar >= 2.
std::vector<double> taylor_shading(std::size_t elements, double side_lobe_db, int nbar = 6);

/// Returns Hamming weights (E31), 0.54 + 0.46 cos(2 pi x) at the element positions x = position / elements; sum =
/// elements. The highest side lobe is -42.7 dB for many elements. Throws Error unless elements >= 1.
std::vector<double> hamming_shading(std::size_t elements);

/// Returns Dolph-Chebyshev weights (E32): all side lobes at `side_lobe_db`, with the narrowest main lobe possible for
/// that level; sum = elements. Exact to rounding; takes elements^2 / 2 steps. Throws Error unless elements >= 1 and -80
/// <= side_lobe_db < -13.3.
std::vector<double> chebyshev_shading(std::size_t elements, double side_lobe_db);

}  // namespace insonify
