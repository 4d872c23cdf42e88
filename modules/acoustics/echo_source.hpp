#pragma once
#include <cstddef>
#include <functional>
#include <vector>

#include "acoustics/echoes.hpp"
#include "sampling/scatterers.hpp"
#include "sampling/visible_surfels.hpp"

namespace insonify {

/// Patches and their echoes in chunks, which are made when they are visited and not kept. A chunk may be visited any
/// number of times, also concurrently, and is the same to the byte each time.
struct EchoSource {
  /// How many patches, and between which ranges [m] they and half the ways of their echoes lie.
  struct Chunk {
    std::size_t size;
    double min_range, max_range;
  };
  /// Takes the patches and echoes of a chunk.
  using Visitor = std::function<void(const Scatterers&, const Echoes&)>;
  /// What a visit may leave out; an empty function asks for everything.
  struct Filter {
    std::function<bool(const PatchPlace&)> surfel{};               ///< whether patches of a surfel are wanted
    std::function<bool(const PatchPlace&, double range)> patch{};  ///< of such a surfel, a patch at this range [m]
  };

  std::vector<Chunk> chunks;
  /// Visits a chunk, patches and echoes index by index. What the filter refuses may be left out.
  std::function<void(std::size_t chunk, const Filter& wanted, const Visitor& visit)> visit;
  const Echoes* stored = nullptr;  ///< all echoes, if they are stored
  bool moving = false;             ///< echoes have Doppler shifts

  std::size_t size() const;  ///< number of patches
};

/// Returns a source of one chunk, of patches and echoes that are stored and must outlive it. Throws Error naming `who`
/// if their numbers differ.
EchoSource stored_source(const Scatterers& scatterers, const Echoes& echoes, const char* who);

/// Returns all echoes of a source, chunk by chunk.
Echoes all_echoes(const EchoSource& source);

}  // namespace insonify
