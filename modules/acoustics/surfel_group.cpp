// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <unordered_map>

#include "acoustics/surfel_group_internal.hpp"

namespace insonify {

std::vector<SurfelGroup> connected_groups(const SurfelGroup& all, double link) {
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
  std::vector<SurfelGroup> groups;
  for (const std::uint32_t seed : all.members) {
    std::vector<Cell> open = {cell_of(seed)};
    if (!cells.contains(open[0])) continue;
    SurfelGroup group{all.scene, {}};
    while (!open.empty()) {
      const Cell c = open.back();
      open.pop_back();
      const auto found = cells.find(c);
      if (found == cells.end()) continue;
      group.members.insert(group.members.end(), found->second.begin(), found->second.end());
      cells.erase(found);
      for (int k = 0; k < 27; ++k) open.push_back({c[0] + k % 3 - 1, c[1] + k / 3 % 3 - 1, c[2] + k / 9 - 1});
    }
    std::sort(group.members.begin(), group.members.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace insonify
