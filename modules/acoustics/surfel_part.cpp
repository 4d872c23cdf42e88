// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <unordered_map>

#include "acoustics/surfel_part_internal.hpp"

namespace insonify {

std::vector<SurfelPart> connected_parts(const SurfelPart& all, double link) {
  using Cell = std::array<long, 3>;
  struct Hash {
    std::size_t operator()(const Cell& c) const {
      return static_cast<std::size_t>((c[0] * 73856093) ^ (c[1] * 19349663) ^ (c[2] * 83492791));
    }
  };
  std::unordered_map<Cell, Members, Hash> cells;
  const auto cell_of = [&](std::uint32_t s) {
    const Eigen::Vector3d p = all.point(s) / link;
    return Cell{std::lround(std::floor(p.x())), std::lround(std::floor(p.y())), std::lround(std::floor(p.z()))};
  };
  for (const std::uint32_t s : all.members) cells[cell_of(s)].push_back(s);
  std::vector<SurfelPart> parts;
  for (const std::uint32_t seed : all.members) {
    std::vector<Cell> open = {cell_of(seed)};
    if (!cells.contains(open[0])) continue;
    SurfelPart part{all.scene, {}};
    while (!open.empty()) {
      const Cell c = open.back();
      open.pop_back();
      const auto found = cells.find(c);
      if (found == cells.end()) continue;
      part.members.insert(part.members.end(), found->second.begin(), found->second.end());
      cells.erase(found);
      for (int k = 0; k < 27; ++k) open.push_back({c[0] + k % 3 - 1, c[1] + k / 3 % 3 - 1, c[2] + k / 9 - 1});
    }
    std::sort(part.members.begin(), part.members.end());
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace insonify
