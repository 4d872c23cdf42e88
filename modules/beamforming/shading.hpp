#pragma once
#include <cstddef>
#include <vector>

namespace insonify {

/// How the elements of an array are weighted.
enum class Shading { uniform, taylor, hamming, chebyshev };

/// As sonar files spell it: "uniform", "taylor", "hamming", "chebyshev".
const char* shading_name(Shading shading);

/// Weights of one kind; sum = elements. side_lobe_db counts for Taylor and Chebyshev alone. Throws as they do.
std::vector<double> shading_weights(Shading shading, std::size_t elements, double side_lobe_db);

/// Equal weights 1.
std::vector<double> uniform_shading(std::size_t elements);

/// Taylor weights (E11) with nearly equal side lobes at `side_lobe_db` (negative, e.g. -30) over the first `nbar`
/// of them, falling off beyond; sum = elements. Taylor (1955), sampled at the element places.
/// Throws Error unless elements >= 1, -80 <= side_lobe_db < -13.3 and nbar >= 2.
std::vector<double> taylor_shading(std::size_t elements, double side_lobe_db, int nbar = 6);

/// Hamming weights (E31), 0.54 + 0.46 cos(2 pi x) at the element places x = place / elements; sum = elements.
/// Highest side lobe -42.7 dB for many elements. Throws Error unless elements >= 1.
std::vector<double> hamming_shading(std::size_t elements);

/// Dolph-Chebyshev weights (E32): every side lobe at `side_lobe_db`, and no narrower main lobe for that level;
/// sum = elements. Exact up to rounding; takes elements^2 / 2 steps.
/// Throws Error unless elements >= 1 and -80 <= side_lobe_db < -13.3.
std::vector<double> chebyshev_shading(std::size_t elements, double side_lobe_db);

}  // namespace insonify
