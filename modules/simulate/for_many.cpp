// SPDX-License-Identifier: BSD-3-Clause
// The decision whether many pings of one scene merge its surfels (E185), judged once by an event like them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/units.hpp"
#include "simulate/ping_simulator.hpp"
#include "simulate/resolve_ping.hpp"

namespace insonify {
namespace {

constexpr std::size_t few_pings = 8, few_surfels = std::size_t{1} << 17;
constexpr std::size_t pings_for_levels = 4;  // so many pings of all surfels take the time of making and judging levels
constexpr std::size_t least_saved = 2;       // times fewer surfels, below which merging takes the time that it saves
constexpr int judged_cells = 100, judged_bands = 10;
constexpr double most_of_band_db = 0.1, quiet_band = 1e-3;
constexpr double finest_width =
    0.25;  // of nodes that stand for all surfels of a scene with levels (docs/results/detail.md)

/// The options of a ping of the expected level in display cells, by the surfels and the water of `o` alone.
SimulationOptions of_expected_level(const SimulationOptions& o, const SonarHead& head, double width) {
  SimulationOptions judged;
  judged.accuracy_db = o.accuracy_db, judged.seed = o.seed, judged.threads = o.threads;
  judged.sampling = o.sampling;
  judged.sampling.detail = chosen(width > 0), judged.sampling.detail_width = width;
  judged.synthesis.method = SynthesisMethod::incoherent;
  judged.effects.multipath = judged.effects.mirrors = judged.effects.moving = Choice::never;
  judged.effects.refraction = o.effects.refraction, judged.effects.absorption_order = o.effects.absorption_order;
  judged.outputs.display_bins = std::min(judged_cells, static_cast<int>(head.gate.bins()));
  judged.detection.threshold_db = std::numeric_limits<double>::infinity();
  return judged;
}

/// A scene that outlives it.
class GivenScene : public SceneSource {
 public:
  explicit GivenScene(const PreparedScene& scene) : scene_(std::shared_ptr<const PreparedScene>(), &scene) {}
  std::shared_ptr<const PreparedScene> scene_for(const PingSimulator&, const PingEvent&) const override {
    return scene_;
  }

 private:
  std::shared_ptr<const PreparedScene> scene_;
};

std::size_t surfels_within(const PreparedScene& scene, const InsonifiedRegion& region) {
  std::size_t sum = 0;
  for (const SurfelBlock& block : scene.blocks())
    if (may_intersect(region, scene.scene().origin + block.centre.cast<double>(), block.radius, block.largest_area))
      sum += block.end - block.begin;
  return sum;
}

/// Returns true if each tenth of the ranges that is not silent has the same level.
bool same_bands(const Ping& one, const Ping& other) {
  const auto a = one.pressure.abs2().cast<double>().eval(), b = other.pressure.abs2().cast<double>().eval();
  for (Eigen::Index k = 0; k < judged_bands; ++k) {
    const Eigen::Index first = k * a.cols() / judged_bands, n = (k + 1) * a.cols() / judged_bands - first;
    const double level = a.middleCols(first, n).sum();
    if (level <= quiet_band * a.sum()) continue;
    if (!(std::abs(db_from_power(b.middleCols(first, n).sum() / level)) <= most_of_band_db)) return false;
  }
  return a.sum() > 0;
}

}  // namespace

PingSimulator PingSimulator::for_many(std::size_t pings, const SceneSource& source, const PingEvent& event) const {
  const bool has_levels = source.has_levels();
  SimulationOptions decided = options();
  SamplingSettings& sampling = decided.sampling;
  if (sampling.detail != Choice::as_needed || sampling.detail_width > 0 || sampling.detail_spacing > 0) return *this;
  // Pressures keep the scatterers of all surfels from pose to pose, unless a scene has so many that levels are stored.
  if (!has_levels && (pings <= few_pings || options().outputs.display_bins == 0 || options().synthesis.phases))
    return *this;
  sampling.detail = Choice::always;
  if (!merges_surfels({}, decided) || sampling.kind == SamplingKind::rays) return *this;
  const PingSimulator fine = with(of_expected_level(options(), head(), has_levels ? finest_width : 0)),
                      coarse = with(of_expected_level(options(), head(), usual_detail_width));
  const std::shared_ptr<const PreparedScene> all = source.scene_for(fine, event);
  const std::size_t within = has_levels ? all->scene().size() : surfels_within(*all, reach(all->whole(), event));
  const std::size_t whole = has_levels ? 0 : all->scene().size();
  if (within < few_surfels || within < pings_for_levels * whole / pings) return *this;
  if (!all->scene().facet.empty() || !all->scene().parts.empty()) return *this;
  const auto pays = [&] {
    const std::shared_ptr<const PreparedScene> nodes = has_levels ? source.scene_for(coarse, event) : all;
    const SimulatedPing merged = coarse.ping(*nodes, event);
    const std::size_t left = has_levels ? nodes->scene().size() : merged.report.sampling.merged_to;
    return least_saved * left <= within && same_bands(fine.ping(*all, event).ping, merged.ping);
  };
  sampling.detail = chosen(pays());
  return with(std::move(decided));
}

PingSimulator PingSimulator::for_many(std::size_t pings, const PreparedScene& scene, const PingEvent& event) const {
  return for_many(pings, GivenScene(scene), event);
}

}  // namespace insonify
