#include <algorithm>
#include <cmath>

#include "beamforming/wideband_lists_internal.hpp"

namespace insonify {

WidebandLists::WidebandLists(const Echoes& echoes, const WidebandPlan& plan) : echoes_(echoes), plan_(plan) {
  const double length = static_cast<double>(plan.block) / static_cast<double>(parts) * plan.axis.step;
  const double start = plan.start_of(0) + static_cast<double>(plan.guard) * plan.axis.step;
  const std::size_t all = plan.blocks() * parts;
  std::vector<std::uint32_t> part(echoes.size()), next(all + 1, 0);
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const double p = std::floor((echoes.delay[i] - start) / length);
    part[i] = static_cast<std::uint32_t>(p >= 0 && p < static_cast<double>(all) ? p : static_cast<double>(all));
    ++next[part[i]];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& count : next) {
    begin_.push_back(sum);
    sum += count;
    count = begin_.back();
  }
  echo_.resize(echoes.size());
  for (std::size_t i = 0; i < echoes.size(); ++i) echo_[next[part[i]]++] = static_cast<std::uint32_t>(i);
}

std::vector<WidebandBlock> WidebandLists::of(std::size_t block) const {
  std::vector<WidebandBlock> result;
  const auto bad = [this](const WidebandBlock& b) { return b.effort.error > plan_.tolerance; };
  for (std::size_t cut = 1; cut <= parts; cut *= 2) {
    result.clear();
    const std::size_t step = parts / cut;
    for (std::size_t p = block * parts; p < (block + 1) * parts; p += step)
      if (const auto some = list(p, p + step); !some.empty()) result.push_back(block_of(block, some));
    if (std::none_of(result.begin(), result.end(), bad)) break;
  }
  return result;
}

WidebandBlock WidebandLists::block_of(std::size_t number, std::span<const std::uint32_t> list) const {
  const double c = plan_.medium.sound_speed;
  double first = echoes_.delay[list[0]], last = first, unit = 0;
  for (const std::uint32_t i : list) {
    first = std::min(first, echoes_.delay[i]);
    last = std::max(last, echoes_.delay[i]);
    unit = std::max(unit, std::abs(echoes_.amplitude[i]) *
                              std::exp(-plan_.medium.absorption.a0 * c * std::max(0.0, echoes_.delay[i])));
  }
  first = std::max(first, 1e-3 * plan_.axis.step);
  last = std::max(last, first);
  const double curvature = (1 / first + 1 / last) / c;
  return {number, list, curvature, unit > 0 ? unit : 1, plan_.effort(curvature, 2 / (c * first * curvature) - 1)};
}

}  // namespace insonify
