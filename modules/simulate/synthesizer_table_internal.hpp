#pragma once
#include <array>
#include <mutex>
#include <vector>

#include "beamforming/synthesizer.hpp"

namespace insonify {

/// The synthesizers of the pings of one head: one for each part of its array, medium, method and tolerance, of which the
/// last few stay. May be used by several threads at once.
class SynthesizerTable {
 public:
  enum class Part { whole, port_half, starboard_half };

  /// Returns the synthesizer of a part of the array; `head` is the head with that part alone, the same in all calls.
  /// Throws Error as the constructor of Synthesizer.
  Synthesizer of(Part part, const SonarHead& head, const Medium& medium, SynthesisMethod method,
                 const SynthesisOptions& options);

 private:
  /// Two media, since a head that dives does not come back to earlier ones, by two methods.
  static constexpr std::size_t most = 4;
  struct Row {
    Medium medium;
    SynthesisMethod method;
    SynthesisOptions options;
    Synthesizer synthesizer;
  };
  std::mutex guard_;
  std::array<std::vector<Row>, 3> rows_;  ///< of each part, the last used first
};

}  // namespace insonify
