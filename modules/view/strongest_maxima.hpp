#pragma once
#include <cstddef>
#include <vector>

#include "view/picture.hpp"

namespace insonify {

/// The `count` strongest local maxima of an image, strongest first: cells no weaker than any of their neighbours in
/// bearing and range, at least a twentieth of the outer range apart from each other in the plane, stronger than the
/// weakest sample, and at most `within_db` below the strongest. Each is named by range, bearing and level as it stands in
/// the image: "12.4 m, +5.2°, 93.1 dB". Of beams of one bearing the strongest counts, as in show_fan.
/// Throws Error(argument) for an invalid image or a within_db that is not > 0.
std::vector<Mark> strongest_maxima(const LevelImage& image, std::size_t count, double within_db);

}  // namespace insonify
