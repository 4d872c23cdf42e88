#pragma once
#include <memory>

#include "beamforming/synthesize.hpp"

namespace insonify {

class PingSynthesizer;
class PlanarSynthesizer;
class WidebandSynthesizer;

/// Synthesizers of earlier images, for the pings that follow: their plans, tables, transforms and buffers are made once
/// per head, medium and options instead of once per ping. Images have the same bytes as without. May be used by several
/// threads at once.
class KeptSynthesizers {
 public:
  /// most   synthesizers of each kind that are kept; beyond, the one not used for the longest time is dropped. One of true
  ///        delays takes 10 to 100 MB, and for each thread that uses it at once as much as the blocks of a single ping.
  ///        Of one head and options, those of the last two media
  explicit KeptSynthesizers(std::size_t most = 8);
  ~KeptSynthesizers();
  KeptSynthesizers(KeptSynthesizers&&) noexcept;
  KeptSynthesizers& operator=(KeptSynthesizers&&) noexcept;

  /// The synthesizer of the narrow band for these, kept or made. Throws Error as its constructor does.
  std::shared_ptr<const PingSynthesizer> narrow_band(const SonarHead& head, const Medium& medium,
                                                     const SynthesisOptions& options);
  /// The same of a planar array.
  std::shared_ptr<const PlanarSynthesizer> planar(const SonarHead& head, const Medium& medium,
                                                  const SynthesisOptions& options);
  /// The same with true delays.
  std::shared_ptr<const WidebandSynthesizer> true_delays(const SonarHead& head, const Medium& medium,
                                                         const SynthesisOptions& options);

 private:
  struct Shelves;
  std::unique_ptr<Shelves> shelves_;
};

}  // namespace insonify
