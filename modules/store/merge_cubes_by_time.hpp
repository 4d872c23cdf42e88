// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "store/cube.hpp"

namespace insonify {

/// A cube, and its name for messages.
struct NamedCube {
  std::string name;
  Cube cube;
};

/// The origin of a ping of a merged cube.
struct PingOrigin {
  std::size_t cube;     ///< index of its cube among the merged cubes
  std::int64_t number;  ///< number of the ping in that cube
};

/// A merged cube, and the origin of each of its pings.
struct MergedCube {
  Cube cube;
  std::vector<PingOrigin> origins;
};

/// Returns one cube with all pings, ordered by time of transmission; pings of equal time keep the given order. Ping
/// numbers are kept if they are unique, else replaced by 0, 1, ... Layers, maps and labels are kept if all pings have
/// the same ones, else dropped. Seed, tolerance, version and water are those of the first cube; each ping keeps the
/// water of its own cube. Throws Error(argument) if there is no cube. Throws Error(content) if sonar, fan, gate, centre
/// frequency or bandwidth of a cube differ from those of the first, naming the cube and the difference.
MergedCube merge_cubes_by_time(std::vector<NamedCube> cubes);

}  // namespace insonify
