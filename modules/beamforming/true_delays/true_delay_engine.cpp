// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/true_delays/true_delay_engine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <latch>
#include <utility>
#include <vector>

#include "acoustics/echo_stream.hpp"
#include "beamforming/numerics/flush_denormals_internal.hpp"
#include "beamforming/numerics/lazy_internal.hpp"
#include "beamforming/numerics/tile_pool_internal.hpp"
#include "beamforming/reference/element_series.hpp"
#include "beamforming/true_delays/echo_feed_internal.hpp"
#include "beamforming/true_delays/one_beam_internal.hpp"
#include "beamforming/true_delays/time_block_internal.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace insonify {
namespace {

constexpr double farthest_out = 1 + 1e-9;    // |u| of echoes, rounded
constexpr std::size_t exact_at_once = 4096;  // echoes that are summed element by element together
constexpr std::size_t beams_at_once = 8;
constexpr double steady_band = 0.1;  // Doppler shift that the band of echoes at rest holds, over the bandwidth
constexpr double first_rung = 0.05;  // least Doppler shift of plans for moving echoes, over the bandwidth

/// A plan and its transforms, for blocks of one length.
struct LevelTables {
  TrueDelayPlan plan;
  RowFits fits;
  BlockTransforms transforms;
  mutable TilePool<BlockWorkspace> workspaces;

  LevelTables(const SonarHead& head, const Medium& medium, const TrueDelaySizes& sizes)
      : plan(head, medium, sizes.tolerance, sizes.widest, sizes.doppler, sizes.block),
        fits(plan),
        transforms(plan),
        workspaces([this] { return std::make_unique<BlockWorkspace>(plan, transforms); }) {}
};

/// Opens a latch when it is left, by an exception too.
struct CountDown {
  std::latch& latch;
  ~CountDown() { latch.count_down(); }
};

/// Returns the largest |u| of echoes for which the usual plan is used. Echoes beyond it use a second plan, which covers
/// all directions.
double usual_extent(const SonarHead& head) {
  double widest = 0;
  for (const double u : beam_cosines(head.fan)) widest = std::max(widest, std::abs(u));
  return std::min(1.0, 1.1 * widest + 0.05);
}

void append(const Echoes& from, std::uint32_t i, Echoes& to) {
  to.delay.push_back(from.delay[i]);
  to.u.push_back(from.u[i]);
  to.amplitude.push_back(from.amplitude[i]);
  if (!from.doppler.empty()) to.doppler.push_back(from.doppler[i]);
}

}  // namespace

struct TrueDelayEngine::Plan {
  SonarHead head;
  Medium medium;
  SynthesisOptions options;
  double widest;  ///< |u| of echoes
  DopplerSpan doppler;
  BlockLayout layout;
  TimeStretches stretches;                  ///< what is nearer than blocks reach, then the blocks
  std::unique_ptr<const OneBeam> one_beam;  ///< instead of blocks; nullptr: does not pay
  std::deque<Lazy<LevelTables>> levels;
  std::deque<Lazy<TimeBlock>> blocks;
  Lazy<Plan> all_around;  ///< for echoes farther out: of all directions
  /// Plans for Doppler shifts up to 2^k first rungs: one, or two about the largest shifts of either sign.
  struct Moving {
    std::unique_ptr<const Plan> closing, leaving;
  };
  std::array<Lazy<Moving>, 32> moving;

  Plan(const SonarHead& head, const Medium& medium, const SynthesisOptions& options, double widest,
       DopplerSpan doppler = {});
  const LevelTables& tables_of(std::size_t level) const;
  const TimeBlock& block(std::size_t number) const;
  /// The stretches by which echoes are fed to `pressure`.
  const TimeStretches& stretches_for(bool fast) const { return one_beam && !fast ? one_beam->stretches() : stretches; }
  /// The image of stored echoes up to |u| = `far_out`. `fast`: they have larger Doppler shifts than OneBeam takes.
  ComplexGrid image(const Echoes& echoes, double far_out, bool fast) const {
    return with(far_out,
                [&](const Plan& plan) { return plan.pressure(feed_of(echoes, plan.stretches_for(fast)), fast); });
  }
  /// Returns the image of echoes with shifts up to `fastest` [Hz] that blocks for echoes at rest do not serve (E191).
  ComplexGrid moving_image(const Echoes& echoes, double far_out, double fastest) const;
  ComplexGrid pressure(const EchoFeed& feed, bool fast = false) const;
  void add_blocks(const EchoFeed& feed, ComplexGrid& pressure) const;
  /// Adds the image of a block once wait() returns.
  void add_block(std::size_t number, const EchoFeed& feed, ComplexGrid& pressure,
                 const std::function<void()>& wait) const;
  /// Adds the echoes of the first stretch, element by element.
  void add_nearest(const EchoFeed& feed, ComplexGrid& pressure) const;
  /// Calls use(plan) with this plan, or with one for all directions if `far_out` is beyond it. Throws Error beyond 1.
  template <typename Use>
  ComplexGrid with(double far_out, const Use& use) const {
    if (far_out <= widest) return use(*this);
    if (far_out > farthest_out)
      fail(ErrorKind::argument, "TrueDelayEngine: an echo has u = +-", far_out, ", must be within -1 and 1");
    return use(all_around.get([&] { return std::make_unique<Plan>(head, medium, options, 1, doppler); }));
  }
};

TrueDelayEngine::TrueDelayEngine(const SonarHead& head, const Medium& medium, const SynthesisOptions& options) {
  require_synthesis({}, head, medium, options, "TrueDelayEngine");
  require_one_row(head, "TrueDelayEngine");
  if (!(options.tolerance >= min_true_delay_tolerance && options.tolerance <= max_element_tolerance))
    fail(ErrorKind::argument, "TrueDelayEngine: tolerance = ", options.tolerance, ", must be within ",
         min_true_delay_tolerance, " and ", max_element_tolerance, "; below that use the element-exact method");
  plan_ = std::make_shared<const Plan>(
      head, medium, SynthesisOptions{true_delay_share * options.tolerance, options.threads}, usual_extent(head));
}

ComplexGrid TrueDelayEngine::pressure(const Echoes& echoes) const {
  require_synthesis(echoes, plan_->head, plan_->medium, plan_->options, "TrueDelayEngine");
  double widest = 0, fastest = 0;
  for (const double u : echoes.u) widest = std::max(widest, std::abs(u));
  for (const double d : echoes.doppler) fastest = std::max(fastest, std::abs(d));
  const Pulse& pulse = plan_->head.pulse;
  const bool fast = fastest > BeamTableSizes::most_shifted * pulse.centre_frequency;
  if ((plan_->one_beam && !fast) || fastest <= std::min(steady_band * pulse.bandwidth, plan_->layout.steady))
    return plan_->image(echoes, widest, fast);
  return plan_->moving_image(echoes, widest, fastest);
}

ComplexGrid TrueDelayEngine::pressure(const EchoStream& stream) const {
  if (stream.stored()) return pressure(*stream.stored());
  return plan_->with(widest_of(stream, plan_->widest), [&](const Plan& plan) {
    return plan.pressure(feed_of(stream, plan.stretches_for(false), plan.medium.sound_speed));
  });
}

TrueDelayEngine::Plan::Plan(const SonarHead& head_in, const Medium& medium_in, const SynthesisOptions& options_in,
                            double widest_in, DopplerSpan doppler_in)
    : head(head_in),
      medium(medium_in),
      options(options_in),
      widest(widest_in),
      doppler(doppler_in),
      layout(head, medium, options.tolerance, widest, doppler),
      stretches(stretches_of(layout, head, medium)),
      one_beam(doppler.most > 0 ? nullptr : OneBeam::make(head, medium, options.tolerance, widest)),
      levels(layout.levels.size()),
      blocks(layout.blocks.size()) {}

ComplexGrid TrueDelayEngine::Plan::moving_image(const Echoes& echoes, double far_out, double fastest) const {
  const double first = first_rung * head.pulse.bandwidth, rung = std::max(0.0, std::ceil(std::log2(fastest / first)));
  if (!(rung < static_cast<double>(moving.size())))
    fail(ErrorKind::argument, "TrueDelayEngine: an echo has a Doppler shift of ", fastest, " Hz");
  const double most = std::ldexp(first, static_cast<int>(rung));
  const auto plan_about = [&](double centre) {
    return std::make_unique<const Plan>(head, medium, options, widest, DopplerSpan{most, centre});
  };
  const Moving& plans = moving[static_cast<std::size_t>(rung)].get([&] {
    auto made = std::make_unique<Moving>();
    made->closing = plan_about(most <= layout.steady ? 0 : most);
    if (most > layout.steady) made->leaving = plan_about(-most);
    return made;
  });
  if (!plans.leaving) return plans.closing->image(echoes, far_out, true);
  const auto half = [&](const Plan& plan, double sign) {
    Echoes some = echoes;
    for (std::size_t i = 0; i < some.size(); ++i) some.amplitude[i] *= 0.5 + 0.5 * sign * some.doppler[i] / most;
    return plan.image(some, far_out, true);
  };
  return half(*plans.closing, 1) + half(*plans.leaving, -1);  // (E191) linear in the shift
}

const LevelTables& TrueDelayEngine::Plan::tables_of(std::size_t level) const {
  return levels[level].get([&] { return std::make_unique<LevelTables>(head, medium, layout.levels[level]); });
}

const TimeBlock& TrueDelayEngine::Plan::block(std::size_t number) const {
  const BlockLayout::Block& span = layout.blocks[number];
  return blocks[number].get([&] {
    const LevelTables& tables = tables_of(span.level);
    return std::make_unique<TimeBlock>(tables.plan, tables.fits, span.first, span.last);
  });
}

ComplexGrid TrueDelayEngine::Plan::pressure(const EchoFeed& feed, bool fast) const {
  ComplexGrid pressure(head.fan.beams(), stretches.axis.bins);
  // Clear it by all threads: memory that the system clears only when it is added to costs each page two faults.
  parallel_blocks(head.fan.beams(), beams_at_once, options.threads, [&](std::size_t begin, std::size_t end) {
    pressure.middleRows(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin)).setZero();
  });
  if (one_beam && !fast)
    one_beam->add_image(feed, options.threads, pressure);
  else
    add_blocks(feed, pressure);
  add_nearest(feed, pressure);
  return pressure;
}

void TrueDelayEngine::Plan::add_blocks(const EchoFeed& feed, ComplexGrid& pressure) const {
  // Neighbouring blocks share bins: those of even numbers add to them first. Far blocks, which have most echoes, begin.
  const std::size_t odd = blocks.size() / 2, even = blocks.size() - odd;
  std::deque<std::latch> added;
  for (std::size_t number = 0; number < blocks.size(); ++number) added.emplace_back(1);
  parallel_for(blocks.size(), options.threads, [&](std::size_t k) {
    const std::size_t number = k < even ? 2 * (even - 1 - k) : 2 * (even + odd - 1 - k) + 1;
    const CountDown when_left{added[number]};
    add_block(number, feed, pressure, [&] {
      if (number % 2 == 0) return;
      added[number - 1].wait();
      if (number + 1 < added.size()) added[number + 1].wait();
    });
  });
}

void TrueDelayEngine::Plan::add_block(std::size_t number, const EchoFeed& feed, ComplexGrid& pressure,
                                      const std::function<void()>& wait) const {
  const FlushDenormals flush;
  const LevelTables* tables = nullptr;
  std::unique_ptr<BlockWorkspace> workspace;
  feed.visit(number + 1, [&](const Echoes& echoes, BlockWorkspace::List list) {
    if (!workspace) {
      tables = &tables_of(layout.blocks[number].level);
      workspace = tables->workspaces.take();
      workspace->begin(block(number));
    }
    workspace->add(echoes, list);
  });
  if (!workspace) return;
  wait();
  workspace->add_image(block(number), pressure);
  tables->workspaces.give(std::move(workspace));
}

void TrueDelayEngine::Plan::add_nearest(const EchoFeed& feed, ComplexGrid& pressure) const {
  double last = -1;
  feed.visit(0, [&](const Echoes& echoes, BlockWorkspace::List list) {
    for (const std::uint32_t i : list) last = std::max(last, echoes.delay[i]);
  });
  if (last < 0) return;
  const PulseReach reach(head.pulse, medium.absorption, medium.sound_speed, true, pulse_cut(options.tolerance));
  const double beyond = layout.levels[0].aperture + 0.5 * medium.sound_speed * reach.at(last);
  SonarHead near = head;
  near.gate.max_range = std::min(near.gate.max_range, 0.5 * medium.sound_speed * last + beyond);
  if (near.gate.max_range <= near.gate.min_range) return;
  const ElementOptions exact{0.5 * options.tolerance, Wavefront::spherical, options.threads};
  // Sum exact_at_once echoes at a time, however they come.
  ElementSeries all;
  Echoes some;
  const auto sum = [&] {
    ElementSeries series = element_series(some, near, medium, exact);
    if (all.pressure.size() > 0) series.pressure += all.pressure;
    all = std::move(series);
    some = {};
  };
  feed.visit(0, [&](const Echoes& echoes, BlockWorkspace::List list) {
    for (const std::uint32_t i : list) {
      append(echoes, i, some);
      if (some.size() == exact_at_once) sum();
    }
  });
  if (some.size() > 0) sum();
  const ComplexGrid image = beam_from_elements(all, near, medium, exact);
  pressure.leftCols(image.cols()) += image;
}

}  // namespace insonify
