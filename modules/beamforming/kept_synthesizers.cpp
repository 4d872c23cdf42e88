#include "beamforming/kept_synthesizers.hpp"

#include <algorithm>
#include <exception>
#include <future>
#include <list>
#include <mutex>

#include "beamforming/narrow_band/planar_synthesizer_internal.hpp"
#include "beamforming/ping_synthesizer.hpp"
#include "beamforming/true_delays/wideband_synthesizer.hpp"

namespace insonify {

namespace {

/// Media of one head that are kept: a head that dives does not come back to the water of earlier pings.
constexpr std::size_t most_waters = 2;

}  // namespace

struct KeptSynthesizers::Shelves {
  /// Synthesizers of one kind, the last used first.
  template <typename Synthesizer>
  class Shelf {
   public:
    std::shared_ptr<const Synthesizer> of(const SonarHead& head, const Medium& medium, const SynthesisOptions& options,
                                          std::size_t most) {
      std::promise<Made> promise;
      std::shared_future<Made> made;
      if (!find(head, medium, options, most, promise, made)) return made.get();
      try {  // outside the lock: other threads make those of their own pings meanwhile
        promise.set_value(std::make_shared<const Synthesizer>(head, medium, options));
      } catch (...) {
        promise.set_exception(std::current_exception());
        const std::scoped_lock lock(guard_);
        kept_.remove_if([&](const Kept& kept) { return kept.is(head, medium, options); });
      }
      return made.get();
    }

   private:
    using Made = std::shared_ptr<const Synthesizer>;
    struct Kept {
      SonarHead head;
      Medium medium;
      SynthesisOptions options;
      std::shared_future<Made> made;

      bool is_of(const SonarHead& h, const SynthesisOptions& o) const { return head == h && options == o; }
      bool is(const SonarHead& h, const Medium& m, const SynthesisOptions& o) const {
        return medium == m && is_of(h, o);
      }
    };

    /// Takes the synthesizer that is kept or under way; else notes that the caller makes it and returns true.
    bool find(const SonarHead& head, const Medium& medium, const SynthesisOptions& options, std::size_t most,
              std::promise<Made>& promise, std::shared_future<Made>& made) {
      const std::scoped_lock lock(guard_);
      const auto at =
          std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.is(head, medium, options); });
      if (at != kept_.end()) {
        kept_.splice(kept_.begin(), kept_, at);
        made = kept_.front().made;
        return false;
      }
      made = promise.get_future().share();
      kept_.push_front({head, medium, options, made});
      std::size_t waters = 0;
      kept_.remove_if([&](const Kept& kept) { return kept.is_of(head, options) && ++waters > most_waters; });
      while (kept_.size() > most) kept_.pop_back();
      return true;
    }
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
