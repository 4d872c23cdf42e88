// SPDX-License-Identifier: BSD-3-Clause
#include "scene/material_shares.hpp"

namespace insonify {

std::vector<MaterialShare> material_shares(std::span<const Material> table, std::span<const std::uint16_t> material,
                                           std::span<const float> area) {
  struct Sum {
    std::size_t points = 0;
    double area = 0;
  };
  std::vector<Sum> of(table.size());
  double whole = 0;
  for (std::size_t i = 0; i < material.size(); ++i) {
    if (material[i] >= of.size()) of.resize(material[i] + std::size_t{1});
    Sum& sum = of[material[i]];
    ++sum.points;
    if (area.empty()) continue;
    sum.area += static_cast<double>(area[i]);
    whole += static_cast<double>(area[i]);
  }

  std::vector<MaterialShare> shares;
  for (std::size_t m = 0; m < of.size(); ++m) {
    if (of[m].points == 0) continue;
    MaterialShare share{m < table.size() ? table[m].name : "label " + std::to_string(m), of[m].points, {}, 0};
    if (m < table.size()) share.law = name_of(table[m].law);
    if (area.empty()) {
      share.share = static_cast<double>(of[m].points) / static_cast<double>(material.size());
    } else {
      share.area = of[m].area;
      share.share = whole > 0 ? of[m].area / whole : 0;
    }
    shares.push_back(std::move(share));
  }
  return shares;
}

}  // namespace insonify
