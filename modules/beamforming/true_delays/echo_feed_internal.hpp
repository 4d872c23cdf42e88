// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "acoustics/echo_stream.hpp"
#include "beamforming/pulses/time_axis_internal.hpp"
#include "beamforming/true_delays/true_delay_plan_internal.hpp"

namespace insonify {

/// Stretches of time that follow one another without gaps: stretch k from bin edge[k] to edge[k + 1] of the axis.
struct TimeStretches {
  TimeAxis axis;
  std::vector<double> edge;

  std::size_t size() const { return edge.size() - 1; }
  /// Returns the number of the stretch that holds a delay, or size() if none does.
  std::size_t of(double delay) const;
};

/// Returns the stretches of a layout: first the ranges that are too near for blocks, then the blocks.
TimeStretches stretches_of(const BlockLayout& layout, const SonarHead& head, const Medium& medium);

/// Fraction of the requested tolerance that the bounds of a TrueDelayEngine aim at.
constexpr double true_delay_share = 0.7;

/// The echoes of an image, stretch by stretch. visit(k, add) calls add(echoes, which) one or more times with the echoes
/// of stretch k, in the order of the echoes. Several threads may call visit at once.
struct EchoFeed {
  using Add = std::function<void(const Echoes&, std::span<const std::uint32_t>)>;
  std::function<void(std::size_t stretch, const Add& add)> visit;
};

/// Returns the feed of stored echoes, which must outlive it.
EchoFeed feed_of(const Echoes& echoes, const TimeStretches& stretches);

/// Returns the feed of a stream, which must outlive it. Head and scene must be at rest: delay = 2 range / c. A chunk is
/// made again for each stretch that it reaches into. Calls of visit throw Error for an echo that is not finite.
EchoFeed feed_of(const EchoStream& stream, const TimeStretches& stretches, double sound_speed);

/// Returns the larger of `least` and the largest |u| of a stream's echoes.
double widest_of(const EchoStream& stream, double least);

}  // namespace insonify
