#include "acoustics/echo_source.hpp"

#include <algorithm>
#include <utility>

#include "acoustics/collect_echoes_internal.hpp"
#include "core/error.hpp"

namespace insonify {

std::size_t EchoSource::size() const {
  std::size_t sum = 0;
  for (const Chunk& chunk : chunks) sum += chunk.size;
  return sum;
}

EchoSource stored_source(const Scatterers& scatterers, const Echoes& echoes, const char* who) {
  if (scatterers.size() != echoes.size())
    fail(ErrorKind::argument, who, ": ", scatterers.size(), " scatterers, but ", echoes.size(), " echoes");
  EchoSource source;
  source.stored = &echoes;
  source.visit = [&](std::size_t, const EchoSource::Filter&, const EchoSource::Visitor& visit) {
    visit(scatterers, echoes);
  };
  if (echoes.size() == 0) return source;
  const auto [low, high] = std::minmax_element(scatterers.range.begin(), scatterers.range.end());
  source.chunks.push_back({echoes.size(), *low, *high});
  return source;
}

Echoes all_echoes(const EchoSource& source) {
  std::vector<Echoes> chunks(source.chunks.size());
  for (std::size_t c = 0; c < chunks.size(); ++c)
    source.visit(c, {}, [&](const Scatterers&, const Echoes& echoes) { chunks[c] = echoes; });
  Echoes all;
  join_echoes(std::move(chunks), all);
  return all;
}

}  // namespace insonify
