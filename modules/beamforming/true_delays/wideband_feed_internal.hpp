// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "acoustics/echo_stream.hpp"
#include "beamforming/pulses/time_axis_internal.hpp"
#include "beamforming/true_delays/wideband_plan_internal.hpp"

namespace insonify {

/// Stretches of time that follow one another without gaps: stretch k from bin edge[k] to edge[k + 1] of the axis.
struct WidebandStretches {
  TimeAxis axis;
  std::vector<double> edge;

  std::size_t size() const { return edge.size() - 1; }
  double time_of(double bin) const { return axis.start + bin * axis.step; }
  /// The stretch that holds a delay; size(): none.
  std::size_t of(double delay) const;
};

/// What is nearer than blocks reach, then the blocks.
WidebandStretches stretches_of(const WidebandLayout& layout, const SonarHead& head, const Medium& medium);

/// Of the tolerance that a WidebandSynthesizer is asked for, what its bounds aim at.
constexpr double wideband_share = 0.7;

/// The echoes of an image, stretch by stretch. visit(k, add) calls add(echoes, which) as often as need be for what
/// stretch k holds, in the order of the echoes; it may be called concurrently.
struct WidebandFeed {
  using Add = std::function<void(const Echoes&, std::span<const std::uint32_t>)>;
  std::function<void(std::size_t stretch, const Add& add)> visit;
};

/// Of stored echoes, which must outlive it.
WidebandFeed feed_of(const Echoes& echoes, const WidebandStretches& stretches);

/// Of a stream, which must outlive it, of a head and a scene at rest: delay = 2 range / c. Chunks are made again for
/// each stretch that they reach into. Calls throw Error for an echo that is not finite.
WidebandFeed feed_of(const EchoStream& stream, const WidebandStretches& stretches, double sound_speed);

/// The largest |u| of a stream's echoes, or `least` if that is more.
double widest_of(const EchoStream& stream, double least);

}  // namespace insonify
