// SPDX-License-Identifier: BSD-3-Clause
#include "returns/beam_bands.hpp"

#include <algorithm>

#include "returns/find_contributors.hpp"

namespace insonify {

BeamBands beam_bands(const SonarHead& head, int per_pixel, double mib) {
  std::vector<std::size_t> ends;
  std::size_t beams = 0;
  std::vector<FanRow> rows = fan_rows(head.fan);
  std::sort(rows.begin(), rows.end(),
            [](const FanRow& a, const FanRow& b) { return a.beams.front() < b.beams.front(); });
  for (const FanRow& row : rows) {
    if (row.beams.front() != beams || row.beams.back() + 1 != beams + row.beams.size()) return {{0, head.fan.beams()}};
    ends.push_back(beams += row.beams.size());
  }
  BeamBands bands{{0, ends.front()}};
  std::size_t in_band = 1;
  for (std::size_t r = 1; r < ends.size(); ++r) {
    auto& [first, end] = bands.back();
    const bool fits = contributor_mib((ends[r] - first) * head.gate.bins(), per_pixel) <= mib;
    // The last row joins the band before it.
    if (fits || in_band < 2 || r + 1 == ends.size()) {
      end = ends[r], ++in_band;
    } else {
      bands.emplace_back(ends[r - 1], ends[r]), in_band = 1;
    }
  }
  return bands;
}

SonarHead with_beams(const SonarHead& head, std::size_t first, std::size_t end) {
  SonarHead part = head;
  const auto cut = [&](const std::vector<double>& all) {
    return std::vector(all.begin() + static_cast<long>(first), all.begin() + static_cast<long>(end));
  };
  part.fan.azimuth = cut(head.fan.azimuth);
  part.fan.elevation = cut(head.fan.elevation);
  return part;
}

void put_labels(PixelLabels part, std::size_t first_beam, std::size_t beams, PixelLabels& all) {
  if (static_cast<std::size_t>(part.material.rows()) == beams) {
    all = std::move(part);
    return;
  }
  const auto first = static_cast<Eigen::Index>(first_beam), rows = static_cast<Eigen::Index>(beams);
  const auto put = [&](const auto& from, auto& to) {
    to.conservativeResize(rows, from.cols());
    to.middleRows(first, from.rows()) = from;
  };
  put(part.material, all.material);
  put(part.id, all.id);
  put(part.share, all.share);
  if (part.part.size() > 0) put(part.part, all.part);
  all.names = part.names, all.part_names = part.part_names, all.part_labels = part.part_labels;
}

}  // namespace insonify
