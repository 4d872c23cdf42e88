// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "acoustics/echoes.hpp"
#include "sampling/scatterers.hpp"

namespace insonify {

/// Takes patches and their echoes from an EchoStream.
class EchoSink {
 public:
  virtual ~EchoSink() = default;
  /// Returns true if patches within these bounds are wanted; others may be left out.
  virtual bool wants(const SurfelBounds&) const { return true; }
  /// Returns true if wants() is to be called for each patch, not only for each surfel; this pays if few patches are
  /// wanted.
  virtual bool chooses_patches() const { return false; }
  /// Takes patches and echoes, index by index.
  virtual void take(const Scatterers& patches, const Echoes& echoes) = 0;
};

/// Number of patches of a chunk, and the interval [m] of their ranges and of half the paths of their echoes.
struct ChunkBounds {
  std::size_t size;
  double min_range, max_range;
};

/// Patches and their echoes in chunks, which are made when they are visited and not stored. A chunk may be visited any
/// number of times, also concurrently, and is the same to the byte each time.
class EchoStream {
 public:
  virtual ~EchoStream() = default;
  /// Returns the bounds of all chunks, in their order.
  virtual std::span<const ChunkBounds> chunks() const = 0;
  /// Makes a chunk, at least the part that the sink wants, and passes it to the sink.
  virtual void visit(std::size_t chunk, EchoSink& sink) const = 0;
  /// Returns all echoes if they are stored, else nullptr.
  virtual const Echoes* stored() const { return nullptr; }
  /// Returns true if echoes have Doppler shifts.
  virtual bool moving() const { return false; }

  /// Returns the number of patches.
  std::size_t size() const;
};

/// Patches and echoes that are stored, as one chunk.
class StoredEchoes final : public EchoStream {
 public:
  /// Refers to patches and echoes. Throws Error naming `who` if their numbers differ.
  StoredEchoes(const Scatterers& patches, const Echoes& echoes, const char* who);
  /// Returns one chunk, or none if there are no echoes.
  std::span<const ChunkBounds> chunks() const override { return chunks_; }
  /// Passes all patches and echoes to the sink.
  void visit(std::size_t chunk, EchoSink& sink) const override;
  /// Returns all echoes.
  const Echoes* stored() const override { return &echoes_; }

 private:
  const Scatterers& patches_;
  const Echoes& echoes_;
  std::vector<ChunkBounds> chunks_;
};

/// Returns all echoes of a stream, chunk by chunk.
Echoes all_echoes(const EchoStream& stream);

}  // namespace insonify
