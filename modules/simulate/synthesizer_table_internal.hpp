// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "beamforming/synthesize_cells.hpp"
#include "beamforming/synthesizer.hpp"
#include "simulate/last_made_internal.hpp"

namespace insonify {

/// The synthesizers of the pings of one head: one for each part of its array, medium, method and tolerance. Those of
/// the last two media stay, since a head that dives does not come back to earlier ones. May be used by several threads
/// at once.
class SynthesizerTable {
 public:
  enum class Part { whole, port_half, starboard_half };

  /// Returns the synthesizer of a part of the array; `head` is the head with that part alone, the same in all calls.
  /// Throws Error as the constructor of Synthesizer.
  std::shared_ptr<const Synthesizer> of(Part part, const SonarHead& head, const Medium& medium, SynthesisMethod method,
                                        const SynthesisOptions& options);
  /// Returns what draws the display cells of a head, the same in all calls but for its gate, for means of samples so far
  /// apart [m]. Throws Error as the constructor of CellSynthesizer.
  std::shared_ptr<const CellSynthesizer> cells_of(const SonarHead& head, const Medium& medium, double sample_length);

 private:
  static constexpr std::size_t most_media = 2;
  struct Row {
    Medium medium;
    SynthesisMethod method;
    SynthesisOptions options;
    std::shared_ptr<const Synthesizer> synthesizer;
  };
  struct CellsKey {
    Medium medium;
    RangeGate gate;
    double sample_length;
    bool operator==(const CellsKey&) const = default;
  };
  std::mutex guard_;
  std::array<std::vector<Row>, 3> rows_;  ///< synthesizers of each part, the last used first
  LastMade<CellsKey, CellSynthesizer> cells_{most_media};
};

}  // namespace insonify
