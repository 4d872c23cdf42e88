#pragma once
#include <cstddef>
#include <vector>

#include "view/picture.hpp"

namespace insonify {

/// The `count` strongest local maxima of an image, strongest first: cells no weaker than their neighbours in bearing
/// and range, at least a twentieth of the outer range apart from each other in the plane, stronger than the weakest
/// sample, and at most `within_db` below the strongest. Each is named by its range, bearing and level in the image:
/// "12.4 m, +5.2°, 93.1 dB". Of beams of one bearing the strongest is used, as in show_fan. Throws Error(argument) for
/// an invalid image or unless within_db > 0.
std::vector<Mark> strongest_maxima(const LevelImage& image, std::size_t count, double within_db);

}  // namespace insonify
