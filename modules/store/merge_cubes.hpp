#pragma once
#include <string>
#include <vector>

#include "store/cube.hpp"

namespace insonify {

/// A cube and where it comes from, for messages.
struct NamedCube {
  std::string name;
  Cube cube;
};

/// All pings in one cube, by time of transmission; pings of the same time stay in the order given. Numbers of pings are
/// kept if no two are alike, else they count from 0. Layers are kept if all pings have the same ones, else dropped from
/// all. What else a cube says (seed, tolerance, version, water) is that of the first.
/// Throws Error(argument) if there is no cube, Error(content) naming the cube and what differs if sonar, fan, gate, centre
/// frequency, bandwidth or sound speed are not those of the first.
Cube merge_cubes(std::vector<NamedCube> cubes);

}  // namespace insonify
