// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace insonify {

/// Energies of one kind of surface at a pixel: in its cell, near it (within the radius of a surfel, which closes gaps
/// between surfels), and in the main lobe. Also the surfels with the strongest pieces in the cell and near it.
struct KindHere {
  double cell = 0, near = 0, lobe = 0;
  double in_cell = 0, in_near = 0;
  std::uint32_t of_cell = 0, of_near = 0;
};

/// Energies of the kinds of surface that one beam receives. A kind takes memory only from its first to its last bin, so
/// that the memory grows with the extents of bodies, not with bins x kinds.
class KindsInBeam {
 public:
  /// Numbers the kinds from 0 to kinds - 1, the bins from 0 to bins - 1.
  KindsInBeam(std::size_t kinds, std::size_t bins) : spans_(kinds), bins_(bins) {}

  /// Extends a kind over `length` bins from `first` on, as far as they exist. Call it for all bins of all kinds before
  /// make_room.
  void extend(std::size_t kind, std::int64_t first, std::size_t length) {
    const std::int64_t begin = std::max<std::int64_t>(first, 0);
    const std::int64_t end = std::min<std::int64_t>(first + static_cast<std::int64_t>(length), bins());
    if (begin >= end) return;
    spans_[kind].begin = std::min(spans_[kind].begin, begin), spans_[kind].end = std::max(spans_[kind].end, end);
  }
  void make_room() {
    std::size_t size = 0;
    for (Span& span : spans_)
      if (span.begin < span.end) span.at = size, size += static_cast<std::size_t>(span.end - span.begin);
    here_.resize(size);
  }
  /// Returns the energies of a kind in a bin over which it was extended.
  KindHere& at(std::size_t kind, std::int64_t bin) {
    return here_[spans_[kind].at + static_cast<std::size_t>(bin - spans_[kind].begin)];
  }

  /// The kind with the most energy in a bin, the lowest of equal ones; null: no kind has energy.
  struct Most {
    const KindHere* here = nullptr;
    std::uint16_t kind = 0;
  };
  /// Returns the kind with the most energy for each bin.
  std::vector<Most> most(double KindHere::*energy) const {
    std::vector<Most> most(bins_);
    for (std::size_t kind = 0; kind < spans_.size(); ++kind)
      for (std::int64_t bin = spans_[kind].begin; bin < spans_[kind].end; ++bin) {
        const KindHere& here = here_[spans_[kind].at + static_cast<std::size_t>(bin - spans_[kind].begin)];
        Most& so_far = most[static_cast<std::size_t>(bin)];
        if (here.*energy > (so_far.here ? so_far.here->*energy : 0)) so_far = {&here, static_cast<std::uint16_t>(kind)};
      }
    return most;
  }

 private:
  struct Span {
    std::int64_t begin = std::numeric_limits<std::int64_t>::max(), end = 0;
    std::size_t at = 0;  // index of its first bin in here_
  };
  std::int64_t bins() const { return static_cast<std::int64_t>(bins_); }

  std::vector<Span> spans_;
  std::size_t bins_;
  std::vector<KindHere> here_;
};

}  // namespace insonify
