// SPDX-License-Identifier: BSD-3-Clause
#include "survey/parts_source.hpp"

#include <utility>

#include "core/error.hpp"

namespace insonify {

PartsSource::PartsSource(std::shared_ptr<const SceneParts> parts, std::int64_t pings_per_draw, int threads,
                         bool prepare)
    : parts_(std::move(parts)), pings_per_draw_(pings_per_draw), threads_(threads), pool_(std::make_shared<Pool>()) {
  if (!parts_) fail(ErrorKind::argument, "PartsSource: no parts");
  if (pings_per_draw < 0)
    fail(ErrorKind::argument, "PartsSource: pings_per_draw = ", pings_per_draw, ", must be at least 0");
  if (prepare) pool_->idle.push_back(take());
}

std::unique_ptr<PosedScene> PartsSource::take() const {
  {
    const std::scoped_lock lock(pool_->guard);
    if (!pool_->idle.empty()) {
      std::unique_ptr<PosedScene> scene = std::move(pool_->idle.back());
      pool_->idle.pop_back();
      return scene;
    }
  }
  return std::make_unique<PosedScene>(parts_->resting(), parts_->others_materials(), threads_);
}

std::uint64_t PartsSource::draw_of(const PingEvent& event) const {
  // The number of a ping among those of its head is in the lower 40 bits.
  const std::int64_t number = event.number & ((std::int64_t{1} << 40) - 1);
  return pings_per_draw_ == 0 ? 0 : static_cast<std::uint64_t>(number / pings_per_draw_);
}

/// A scene that is out; it goes back to the pool with the last of its owners.
struct PartsSource::Loan {
  std::shared_ptr<Pool> pool;
  std::unique_ptr<PosedScene> posed;
  std::shared_ptr<const PreparedScene> scene{};

  ~Loan() {
    scene.reset();
    const std::scoped_lock lock(pool->guard);
    pool->idle.push_back(std::move(posed));
  }
};

std::shared_ptr<const PreparedScene> PartsSource::scene_for(const PingSimulator&, const PingEvent& event) const {
  const std::vector<PlacedPart> others = others_of(event);
  const auto loan = std::make_shared<Loan>(pool_, take());
  loan->scene = loan->posed->pose(others);
  return {loan, loan->scene.get()};
}

}  // namespace insonify
