// SPDX-License-Identifier: BSD-3-Clause
#include "survey/parts_source.hpp"

#include <utility>

#include "core/error.hpp"

namespace insonify {

SceneMoment moment_of(const DrawRule& rule, double time, std::int64_t number) {
  if (rule.pings_per_draw < 0)
    fail(ErrorKind::argument, "moment_of: pings_per_draw = ", rule.pings_per_draw, ", must be at least 0");
  if (rule.pings_per_draw == 0) return {time, rule.draw};
  // The lower 40 bits are the number of a ping among the pings of its head.
  const std::int64_t own = number & ((std::int64_t{1} << 40) - 1);
  return {time, static_cast<std::uint64_t>(own / rule.pings_per_draw)};
}

PartsSource::PartsSource(std::shared_ptr<const SceneParts> parts, const DrawRule& rule, int threads, bool prepare,
                         std::optional<std::vector<PlacedPart>> resting)
    : parts_(std::move(parts)),
      resting_(std::move(resting)),
      rule_(rule),
      threads_(threads),
      pool_(std::make_shared<Pool>()) {
  if (!parts_) fail(ErrorKind::argument, "PartsSource: no parts");
  moment_of(rule, 0, 0);
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
  return std::make_unique<PosedScene>(resting_ ? *resting_ : parts_->resting(), parts_->materials(), threads_);
}

/// A scene in use. It goes back to the pool when its last owner releases it.
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
  return scene_at(moment_for(event));
}

std::shared_ptr<const PreparedScene> PartsSource::scene_at(const SceneMoment& moment) const {
  const SceneMoment differs{parts_->moves() ? moment.time : 0, parts_->drawn_anew() ? moment.draw : 0};
  {
    const std::scoped_lock lock(pool_->guard);
    for (const auto& [of, scene] : pool_->in_use)
      if (of == differs)
        if (std::shared_ptr<const PreparedScene> there = scene.lock()) return there;
  }
  const std::vector<PlacedPart> others = parts_->others_at(moment.time, moment.draw);
  const auto loan = std::make_shared<Loan>(pool_, take());
  loan->scene = loan->posed->pose(others);
  std::shared_ptr<const PreparedScene> scene(loan, loan->scene.get());
  const std::scoped_lock lock(pool_->guard);
  std::erase_if(pool_->in_use, [](const auto& use) { return use.second.expired(); });
  pool_->in_use.emplace_back(differs, scene);
  return scene;
}

}  // namespace insonify
