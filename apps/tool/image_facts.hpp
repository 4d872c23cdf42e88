#pragma once
#include <vector>

#include "store/cube.hpp"
#include "view/show_panels.hpp"

namespace insonify::tool {

/// Sonar, pose, gate, water and settings of one ping of a cube in words.
std::vector<Fact> facts_of(const Cube& cube, std::size_t ping);

}  // namespace insonify::tool
