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
    : parts_(std::move(parts)), rule_(rule), pool_([of = parts_, threads, stands = std::move(resting)] {
        return std::make_unique<PosedScene>(stands ? *stands : of->resting(), of->materials(), threads);
      }) {
  if (!parts_) fail(ErrorKind::argument, "PartsSource: no parts");
  moment_of(rule, 0, 0);
  if (prepare) pool_.prepare();
}

std::shared_ptr<const PreparedScene> PartsSource::scene_for(const PingSimulator&, const PingEvent& event) const {
  return scene_at(moment_for(event));
}

std::shared_ptr<const PreparedScene> PartsSource::scene_at(const SceneMoment& moment) const {
  const SceneMoment differs{parts_->moves() ? moment.time : 0, parts_->drawn_anew() ? moment.draw : 0};
  return pool_.scene_of(differs,
                        [&](PosedScene& posed) { return posed.pose(parts_->others_at(moment.time, moment.draw)); });
}

}  // namespace insonify
