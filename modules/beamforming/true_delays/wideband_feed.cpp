#include <algorithm>
#include <cmath>
#include <memory>

#include "acoustics/echo_source.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/true_delays/wideband_feed_internal.hpp"

namespace insonify {

std::size_t WidebandStretches::of(double delay) const {
  const double bin = (delay - axis.start) / axis.step;
  if (!(bin >= edge.front() && bin < edge.back())) return size();
  return static_cast<std::size_t>(std::upper_bound(edge.begin(), edge.end(), bin) - edge.begin()) - 1;
}

WidebandStretches stretches_of(const WidebandLayout& layout, const SonarHead& head, const Medium& medium) {
  WidebandStretches stretches{TimeAxis(head.gate, medium.sound_speed),
                              {std::min(-layout.guard, layout.blocks[0].first)}};
  for (const WidebandLayout::Block& block : layout.blocks) stretches.edge.push_back(block.first);
  stretches.edge.push_back(layout.blocks.back().last);
  return stretches;
}

WidebandFeed feed_of(const Echoes& echoes, const WidebandStretches& stretches) {
  // Shared, since functions are copied.
  const auto lists = std::make_shared<std::vector<std::vector<std::uint32_t>>>(stretches.size() + 1);
  for (std::size_t i = 0; i < echoes.size(); ++i)
    (*lists)[stretches.of(echoes.delay[i])].push_back(static_cast<std::uint32_t>(i));
  return {[&echoes, lists](std::size_t stretch, const WidebandFeed::Add& add) {
    if (!(*lists)[stretch].empty()) add(echoes, (*lists)[stretch]);
  }};
}

WidebandFeed feed_of(const EchoSource& source, const WidebandStretches& stretches, double sound_speed) {
  return {[&source, stretches, sound_speed](std::size_t stretch, const WidebandFeed::Add& add) {
    // A bin more at either end: edges and ranges are rounded differently.
    const double near = 0.5 * sound_speed * stretches.time_of(stretches.edge[stretch] - 1),
                 far = 0.5 * sound_speed * stretches.time_of(stretches.edge[stretch + 1] + 1);
    std::vector<std::uint32_t> which;
    for (std::size_t c = 0; c < source.chunks.size(); ++c) {
      if (source.chunks[c].max_range < near || source.chunks[c].min_range > far) continue;
      source.visit(c, {[&](const PatchPlace& p) { return p.range + p.reach >= near && p.range - p.reach <= far; }},
                   [&](const Scatterers&, const Echoes& echoes) {
                     require_finite(echoes, "WidebandSynthesizer");
                     // As `of`, without a branch: most echoes of a chunk lie in one stretch.
                     const double start = stretches.axis.start, step = stretches.axis.step,
                                  first = stretches.edge[stretch], last = stretches.edge[stretch + 1];
                     std::size_t count = 0;
                     which.resize(echoes.size());
                     for (std::size_t i = 0; i < echoes.size(); ++i) {
                       const double bin = (echoes.delay[i] - start) / step;
                       which[count] = static_cast<std::uint32_t>(i);
                       count += static_cast<std::size_t>(bin >= first) & static_cast<std::size_t>(bin < last);
                     }
                     if (count > 0) add(echoes, {which.data(), count});
                   });
    }
  }};
}

double widest_of(const EchoSource& source, double least) {
  // Only of surfels that may be farther out than what was found so far.
  for (std::size_t c = 0; c < source.chunks.size(); ++c)
    source.visit(c, {[&](const PatchPlace& p) { return std::abs(p.u) + p.reach_u > least; }},
                 [&](const Scatterers&, const Echoes& echoes) {
                   for (const double u : echoes.u) least = std::max(least, std::abs(u));
                 });
  return least;
}

}  // namespace insonify
