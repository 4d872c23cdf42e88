// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/echo_stream.hpp"

#include <algorithm>
#include <utility>

#include "acoustics/collect_echoes_internal.hpp"
#include "core/error.hpp"

namespace insonify {
namespace {

struct CopyEchoes final : EchoSink {
  Echoes copy;
  void take(const Scatterers&, const Echoes& echoes) override { copy = echoes; }
};

}  // namespace

std::size_t EchoStream::size() const {
  std::size_t sum = 0;
  for (const ChunkBounds& chunk : chunks()) sum += chunk.size;
  return sum;
}

StoredEchoes::StoredEchoes(const Scatterers& patches, const Echoes& echoes, const char* who)
    : patches_(patches), echoes_(echoes) {
  if (patches.size() != echoes.size())
    fail(ErrorKind::argument, who, ": ", patches.size(), " scatterers, but ", echoes.size(), " echoes");
  if (echoes.size() == 0) return;
  const auto [low, high] = std::minmax_element(patches.range.begin(), patches.range.end());
  chunks_.push_back({echoes.size(), *low, *high});
}

void StoredEchoes::visit(std::size_t, EchoSink& sink) const { sink.take(patches_, echoes_); }

Echoes all_echoes(const EchoStream& stream) {
  std::vector<Echoes> chunks(stream.chunks().size());
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    CopyEchoes sink;
    stream.visit(c, sink);
    chunks[c] = std::move(sink.copy);
  }
  Echoes all;
  join_echoes(std::move(chunks), all);
  return all;
}

}  // namespace insonify
