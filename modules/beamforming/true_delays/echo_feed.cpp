// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>

#include "acoustics/echo_stream.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/true_delays/echo_feed_internal.hpp"

namespace insonify {
namespace {

/// Hands on those echoes of chunks that lie in one stretch.
class StretchSink final : public EchoSink {
 public:
  StretchSink(const TimeStretches& stretches, std::size_t stretch, double sound_speed, const EchoFeed::Add& add)
      : start_(stretches.axis.start),
        step_(stretches.axis.step),
        first_(stretches.edge[stretch]),
        last_(stretches.edge[stretch + 1]),
        // A bin more at either end: edges and ranges are rounded differently.
        near_(0.5 * sound_speed * stretches.axis.time_of(first_ - 1)),
        far_(0.5 * sound_speed * stretches.axis.time_of(last_ + 1)),
        add_(add) {}

  bool reaches(double min_range, double max_range) const { return max_range >= near_ && min_range <= far_; }
  bool wants(const SurfelBounds& s) const override { return reaches(s.range - s.reach, s.range + s.reach); }
  void take(const Scatterers&, const Echoes& echoes) override {
    require_finite(echoes, "TrueDelayEngine");
    // Find the stretch as TimeStretches::of does, without a branch: most echoes of a chunk lie in one stretch.
    const double start = start_, step = step_, first = first_, last = last_;
    std::size_t count = 0;
    which_.resize(echoes.size());
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      const double bin = (echoes.delay[i] - start) / step;
      which_[count] = static_cast<std::uint32_t>(i);
      count += static_cast<std::size_t>(bin >= first) & static_cast<std::size_t>(bin < last);
    }
    if (count > 0) add_(echoes, {which_.data(), count});
  }

 private:
  double start_, step_, first_, last_;  // of the axis; bins of the stretch
  double near_, far_;                   // [m]
  const EchoFeed::Add& add_;
  std::vector<std::uint32_t> which_;
};

/// The largest |u| of echoes; asks only for surfels that may be farther out than what was found so far.
struct WidestDirection final : EchoSink {
  double widest;
  explicit WidestDirection(double least) : widest(least) {}
  bool wants(const SurfelBounds& s) const override { return std::abs(s.u) + s.reach_u > widest; }
  void take(const Scatterers&, const Echoes& echoes) override {
    for (const double u : echoes.u) widest = std::max(widest, std::abs(u));
  }
};

}  // namespace

std::size_t TimeStretches::of(double delay) const {
  const double bin = (delay - axis.start) / axis.step;
  if (!(bin >= edge.front() && bin < edge.back())) return size();
  return static_cast<std::size_t>(std::upper_bound(edge.begin(), edge.end(), bin) - edge.begin()) - 1;
}

TimeStretches stretches_of(const BlockLayout& layout, const SonarHead& head, const Medium& medium) {
  TimeStretches stretches{TimeAxis(head.gate, medium.sound_speed), {std::min(-layout.guard, layout.blocks[0].first)}};
  for (const BlockLayout::Block& block : layout.blocks) stretches.edge.push_back(block.first);
  stretches.edge.push_back(layout.blocks.back().last);
  return stretches;
}

EchoFeed feed_of(const Echoes& echoes, const TimeStretches& stretches) {
  // Shared, since functions are copied.
  const auto lists = std::make_shared<std::vector<std::vector<std::uint32_t>>>(stretches.size() + 1);
  for (std::size_t i = 0; i < echoes.size(); ++i)
    (*lists)[stretches.of(echoes.delay[i])].push_back(static_cast<std::uint32_t>(i));
  return {[&echoes, lists](std::size_t stretch, const EchoFeed::Add& add) {
    if (!(*lists)[stretch].empty()) add(echoes, (*lists)[stretch]);
  }};
}

EchoFeed feed_of(const EchoStream& stream, const TimeStretches& stretches, double sound_speed) {
  return {[&stream, stretches, sound_speed](std::size_t stretch, const EchoFeed::Add& add) {
    StretchSink sink(stretches, stretch, sound_speed, add);
    const std::span<const ChunkBounds> chunks = stream.chunks();
    for (std::size_t c = 0; c < chunks.size(); ++c)
      if (sink.reaches(chunks[c].min_range, chunks[c].max_range)) stream.visit(c, sink);
  }};
}

double widest_of(const EchoStream& stream, double least) {
  WidestDirection sink(least);
  for (std::size_t c = 0; c < stream.chunks().size(); ++c) stream.visit(c, sink);
  return sink.widest;
}

}  // namespace insonify
