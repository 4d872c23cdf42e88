#include "survey/simulate_survey.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <new>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace insonify {
namespace {

/// Blocks that were begun: those that are not whole yet hold their returns.
class OpenBlocks {
 public:
  explicit OpenBlocks(const SurveyWork& work) : work_(work) {}

  /// Whether a ping is still to be made.
  bool is_left(const SurveyBlock& block, std::size_t ping) {
    const std::scoped_lock lock(guard_);
    const auto [at, is_new] = open_.try_emplace({block.head, block.number}, Open{block, {}});
    Open& open = at->second;
    if (is_new) {
      const std::scoped_lock io(io_guard_);
      open.returns = work_.resume(block);
      open.returns.resize(block.end - block.begin);
    }
    return !open.kept && !open.returns[ping - block.begin];
  }

  /// Notes what a ping gave, if it was made now, and passes its block on if that is whole.
  void add(const SurveyBlock& block, std::size_t ping, std::optional<SurveyReturn> made) {
    BlockReturns whole;
    {
      const std::scoped_lock lock(guard_);
      Open& open = open_.at({block.head, block.number});
      if (made) open.returns[ping - block.begin] = std::move(made);
      if (open.kept || !std::all_of(open.returns.begin(), open.returns.end(), is_there)) return;
      open.kept = true;
      whole = std::move(open.returns);
    }
    const std::scoped_lock io(io_guard_);
    work_.keep(block, whole);
  }

  /// Passes on what is done of blocks that are not whole.
  void leave() {
    for (auto& [key, open] : open_)
      if (!open.kept && std::any_of(open.returns.begin(), open.returns.end(), is_there))
        work_.keep(open.block, open.returns);
  }

 private:
  struct Open {
    SurveyBlock block;
    BlockReturns returns;
    bool kept = false;
  };
  static bool is_there(const std::optional<SurveyReturn>& returned) { return returned.has_value(); }

  const SurveyWork& work_;
  std::mutex guard_, io_guard_;
  std::map<std::pair<std::size_t, std::int64_t>, Open> open_;
};

SurveyReturn try_ping(const SurveyWork& work, const SurveyPing& ping) {
  SurveyReturn failed;
  try {
    return work.simulate(ping);
  } catch (const Error& error) {
    failed.failure = error.what();
  } catch (const std::bad_alloc&) {
    failed.failure = "out of memory";
  }
  failed.ping.number = ping.number;
  return failed;
}

}  // namespace

SimulationOptions options_of(const SimulationOptions& of_head, const SurveyPing& ping, const PingPlace& place) {
  SimulationOptions options = of_head;
  options.ping = random_number_of(ping);
  options.time = ping.time;
  options.effects.motion = place.motion;
  options.threads = 1;
  return options;
}

SurveyReturn return_of(SimulatedPing&& simulated, const Mission& mission, const SurveyPing& ping) {
  SurveyReturn kept{std::move(simulated.ping), std::move(simulated.soundings), {}, {}};
  kept.ping.number = ping.number;
  if (!mission.navigation.nodes.empty()) {
    const Pose believed = believed_place_of(mission, ping);
    const Pose moved = believed * kept.ping.world_from_head.inverse();
    for (Eigen::Vector3d& position : kept.soundings.position) position = moved * position;
    kept.ping.world_from_head = believed;
  }
  if (mission.heads[ping.head].scan) kept.ping.scan = ScanPlace{ping.sweep, ping.scan_angle};
  return kept;
}

bool simulate_survey(const std::vector<SurveyPing>& pings, const std::vector<SurveyBlock>& blocks, int threads,
                     const SurveyWork& work) {
  std::vector<std::pair<std::size_t, std::size_t>> items;  // of block and ping
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (std::size_t p = blocks[b].begin; p < blocks[b].end; ++p) items.emplace_back(b, p);

  OpenBlocks open(work);
  std::atomic<bool> stopped = false;
  parallel_for(items.size(), threads, [&](std::size_t i) {
    const auto [b, p] = items[i];
    if (stopped || work.stop()) {
      stopped = true;
      return;
    }
    std::optional<SurveyReturn> made;
    if (open.is_left(blocks[b], p)) made = try_ping(work, pings[p]);
    work.done(made ? &*made : nullptr);
    open.add(blocks[b], p, std::move(made));
  });
  open.leave();
  return !stopped;
}

}  // namespace insonify
