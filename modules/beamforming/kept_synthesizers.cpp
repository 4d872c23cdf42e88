#include "beamforming/kept_synthesizers.hpp"

#include <algorithm>
#include <list>
#include <mutex>

#include "beamforming/ping_synthesizer.hpp"
#include "beamforming/planar_synthesizer_internal.hpp"
#include "beamforming/wideband_synthesizer.hpp"

namespace insonify {

struct KeptSynthesizers::Shelves {
  /// Synthesizers of one kind, the last used first.
  template <typename Synthesizer>
  class Shelf {
   public:
    std::shared_ptr<const Synthesizer> of(const SonarHead& head, const Medium& medium, const SynthesisOptions& options,
                                          std::size_t most) {
      const std::scoped_lock lock(guard_);
      const auto at = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) {
        return kept.head == head && kept.medium == medium && kept.options == options;
      });
      if (at != kept_.end()) {
        kept_.splice(kept_.begin(), kept_, at);
        return kept_.front().synthesizer;
      }
      auto made = std::make_shared<const Synthesizer>(head, medium, options);
      kept_.push_front({head, medium, options, made});
      while (kept_.size() > most) kept_.pop_back();
      return made;
    }

   private:
    struct Kept {
      SonarHead head;
      Medium medium;
      SynthesisOptions options;
      std::shared_ptr<const Synthesizer> synthesizer;
    };
    std::mutex guard_;
    std::list<Kept> kept_;
  };

  std::size_t most;
  Shelf<PingSynthesizer> narrow_band;
  Shelf<PlanarSynthesizer> planar;
  Shelf<WidebandSynthesizer> true_delays;
};

KeptSynthesizers::KeptSynthesizers(std::size_t most) : shelves_(std::make_unique<Shelves>()) { shelves_->most = most; }
KeptSynthesizers::~KeptSynthesizers() = default;
KeptSynthesizers::KeptSynthesizers(KeptSynthesizers&&) noexcept = default;
KeptSynthesizers& KeptSynthesizers::operator=(KeptSynthesizers&&) noexcept = default;

std::shared_ptr<const PingSynthesizer> KeptSynthesizers::narrow_band(const SonarHead& head, const Medium& medium,
                                                                     const SynthesisOptions& options) {
  return shelves_->narrow_band.of(head, medium, options, shelves_->most);
}

std::shared_ptr<const PlanarSynthesizer> KeptSynthesizers::planar(const SonarHead& head, const Medium& medium,
                                                                  const SynthesisOptions& options) {
  return shelves_->planar.of(head, medium, options, shelves_->most);
}

std::shared_ptr<const WidebandSynthesizer> KeptSynthesizers::true_delays(const SonarHead& head, const Medium& medium,
                                                                         const SynthesisOptions& options) {
  return shelves_->true_delays.of(head, medium, options, shelves_->most);
}

}  // namespace insonify
