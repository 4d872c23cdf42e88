// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <vector>

#include "acoustics/echo_stream.hpp"

namespace insonify {

/// Stored echoes of a head at rest, handed over in chunks of `size` without patches.
class EchoChunks final : public EchoStream {
 public:
  EchoChunks(const Echoes& echoes, double sound_speed, std::size_t size = 100) {
    for (std::size_t first = 0; first < echoes.size(); first += size) {
      Echoes some;
      for (std::size_t i = first; i < std::min(first + size, echoes.size()); ++i) {
        some.delay.push_back(echoes.delay[i]), some.u.push_back(echoes.u[i]);
        if (!echoes.v.empty()) some.v.push_back(echoes.v[i]);
        some.amplitude.push_back(echoes.amplitude[i]);
      }
      const auto [low, high] = std::minmax_element(some.delay.begin(), some.delay.end());
      bounds_.push_back({some.size(), 0.5 * sound_speed * *low, 0.5 * sound_speed * *high});
      chunks_.push_back(some);
    }
  }
  std::span<const ChunkBounds> chunks() const override { return bounds_; }
  void visit(std::size_t chunk, EchoSink& sink) const override { sink.take({}, chunks_[chunk]); }

 private:
  std::vector<Echoes> chunks_;
  std::vector<ChunkBounds> bounds_;
};

}  // namespace insonify
