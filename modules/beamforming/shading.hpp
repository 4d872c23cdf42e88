#pragma once
#include <cstddef>
#include <vector>

namespace insonify {

/// Equal weights 1.
std::vector<double> uniform_shading(std::size_t elements);

/// Taylor weights (E11) with nearly equal side lobes at `side_lobe_db` (negative, e.g. -30) over the first `nbar`
/// of them, falling off beyond; sum = elements. Taylor (1955), sampled at the element places.
/// Throws Error unless elements >= 1, -80 <= side_lobe_db < -13.3 and nbar >= 2.
std::vector<double> taylor_shading(std::size_t elements, double side_lobe_db, int nbar = 6);

}  // namespace insonify
