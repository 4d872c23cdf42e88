// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <new>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "survey/make_blocks_internal.hpp"

namespace insonify {
namespace {

/// The blocks of which a ping was made. A block that is not whole holds the outcomes that it has.
class OpenBlocks {
 public:
  explicit OpenBlocks(SurveyStore& store) : store_(store) {}

  /// Returns true if a ping is still to be made.
  bool is_left(const SurveyBlock& block, std::size_t ping) {
    const std::scoped_lock lock(guard_);
    const auto [at, is_new] = open_.try_emplace({block.head, block.number}, Open{block, {}});
    Open& open = at->second;
    if (is_new) {
      const std::scoped_lock io(io_guard_);
      open.outcomes = store_.resume(block);
      open.outcomes.resize(block.end - block.begin);
    }
    return !open.kept && !open.outcomes[ping - block.begin];
  }

  /// Takes the outcome of a ping, if it was made now, and passes its block on if that is whole.
  void add(const SurveyBlock& block, std::size_t ping, std::optional<PingOutcome> made) {
    BlockOutcomes whole;
    {
      const std::scoped_lock lock(guard_);
      Open& open = open_.at({block.head, block.number});
      if (made) open.outcomes[ping - block.begin] = std::move(made);
      if (open.kept || !std::all_of(open.outcomes.begin(), open.outcomes.end(), is_there)) return;
      open.kept = true;
      whole = std::move(open.outcomes);
    }
    const std::scoped_lock io(io_guard_);
    store_.keep(block, whole);
  }

  /// Passes on the finished pings of blocks that are not whole.
  void leave() {
    for (auto& [key, open] : open_)
      if (!open.kept && std::any_of(open.outcomes.begin(), open.outcomes.end(), is_there))
        store_.keep(open.block, open.outcomes);
  }

 private:
  struct Open {
    SurveyBlock block;
    BlockOutcomes outcomes;
    bool kept = false;
  };
  static bool is_there(const std::optional<PingOutcome>& outcome) { return outcome.has_value(); }

  SurveyStore& store_;
  std::mutex guard_, io_guard_;
  std::map<std::pair<std::size_t, std::int64_t>, Open> open_;
};

PingOutcome try_ping(const std::function<PingOutcome(const SurveyPing&)>& simulate, const SurveyPing& ping) {
  PingOutcome failed;
  try {
    return simulate(ping);
  } catch (const Error& error) {
    failed.failure = error.what();
  } catch (const std::bad_alloc&) {
    failed.failure = "out of memory";
  }
  failed.ping.number = ping.number;
  return failed;
}

}  // namespace

bool make_blocks(const std::vector<SurveyPing>& pings, const std::vector<SurveyBlock>& blocks, int threads,
                 const std::function<PingOutcome(const SurveyPing&)>& simulate, SurveyStore& store) {
  std::vector<std::pair<std::size_t, std::size_t>> items;  // indices of block and ping
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (std::size_t p = blocks[b].begin; p < blocks[b].end; ++p) items.emplace_back(b, p);

  OpenBlocks open(store);
  std::atomic<bool> stopped = false;
  parallel_for(items.size(), threads, [&](std::size_t i) {
    const auto [b, p] = items[i];
    if (stopped || store.stopped()) {
      stopped = true;
      return;
    }
    std::optional<PingOutcome> made;
    if (open.is_left(blocks[b], p)) made = try_ping(simulate, pings[p]);
    store.ping_done(made ? &*made : nullptr);
    open.add(blocks[b], p, std::move(made));
  });
  open.leave();
  return !stopped;
}

}  // namespace insonify
