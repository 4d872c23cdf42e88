#include <algorithm>
#include <cmath>

#include "beamforming/wideband_lists_internal.hpp"

namespace insonify {

WidebandLists::WidebandLists(const SeenEchoes& seen, const WidebandPlan& plan, std::size_t array_part)
    : seen_(seen), plan_(plan), array_part_(array_part) {
  const Echoes& echoes = seen.echoes;
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
  const double loss = plan_.medium.absorption.a0 * plan_.medium.sound_speed;
  double least = seen_.curvature[list[0]], most = least, unit = 0;
  for (const std::uint32_t i : list) {
    least = std::min(least, seen_.curvature[i]);
    most = std::max(most, seen_.curvature[i]);
    unit = std::max(unit, std::abs(seen_.echoes.amplitude[i]) * std::exp(-loss * std::max(0.0, seen_.path[i])));
  }
  const double curvature = 0.5 * (least + most);
  return {array_part_, number, list, curvature, unit > 0 ? unit : 1, plan_.effort(curvature, most / curvature - 1)};
}

}  // namespace insonify
