#include "beamforming/wideband_synthesizer.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>
#include <utility>
#include <vector>

#include "beamforming/element_series.hpp"
#include "beamforming/flush_denormals_internal.hpp"
#include "beamforming/wideband_block_internal.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace insonify {
namespace {

constexpr double finest = 1e-5, coarsest = 0.1;
constexpr double kept = 0.7;  // of the tolerance, for what bounds leave out
constexpr double most_phase =
    5;  // of the bend over a block's ranges: powers of time up to it fit single precision [rad]

/// Rooms that no thread works in.
class Rooms {
 public:
  std::unique_ptr<WidebandRoom> take(const WidebandPlan& plan, const WidebandTransforms& transforms) {
    const std::scoped_lock lock(guard_);
    if (free_.empty()) return std::make_unique<WidebandRoom>(plan, transforms);
    auto room = std::move(free_.back());
    free_.pop_back();
    return room;
  }
  void give(std::unique_ptr<WidebandRoom> room) {
    const std::scoped_lock lock(guard_);
    free_.push_back(std::move(room));
  }

 private:
  std::mutex guard_;
  std::vector<std::unique_ptr<WidebandRoom>> free_;
};

/// A plan and its transforms, for blocks of one length.
struct Level {
  WidebandPlan tables;
  WidebandTransforms transforms;
  std::vector<std::size_t> blocks;  ///< by number
  mutable Rooms rooms;

  Level(const SonarHead& head, const Medium& medium, const SynthesisOptions& options, double widest, std::size_t bins)
      : tables(head, medium, options, widest, bins), transforms(tables) {}
};

/// First and one after the last bin of a block, its level, and what is made of it when echoes first need it.
struct Span {
  double first, last;
  std::size_t level;
  mutable std::once_flag made = {};
  mutable std::unique_ptr<WidebandBlock> block = nullptr;

  const WidebandBlock& of(const WidebandPlan& plan) const {
    std::call_once(made, [&] { block = std::make_unique<WidebandBlock>(plan, first, last); });
    return *block;
  }
};

Echoes some_of(const Echoes& echoes, const std::vector<std::size_t>& which) {
  Echoes some;
  for (const std::size_t i : which) {
    some.delay.push_back(echoes.delay[i]);
    some.u.push_back(echoes.u[i]);
    some.amplitude.push_back(echoes.amplitude[i]);
    if (!echoes.doppler.empty()) some.doppler.push_back(echoes.doppler[i]);
  }
  return some;
}

}  // namespace

struct WidebandSynthesizer::Plan {
  std::vector<std::unique_ptr<Level>> levels;  ///< of ever longer blocks
  std::deque<Span> blocks;                     ///< in order of time, without gaps
  double guard;                                ///< bins that a block reaches beyond its ends
  double nearest;                              ///< range from which on blocks are used [m]
  int threads;

  Plan(const SonarHead& head, const Medium& medium, const SynthesisOptions& options, double widest);
  const WidebandPlan& tables() const { return levels[0]->tables; }
  ComplexGrid pressure(const Echoes& echoes) const;
  /// Adds echoes nearer than blocks reach, element by element.
  void add_nearest(const Echoes& echoes, ComplexGrid& pressure) const;
};

WidebandSynthesizer::WidebandSynthesizer(const SonarHead& head, const Medium& medium, const SynthesisOptions& options) {
  require_synthesis({}, head, medium, options, "WidebandSynthesizer");
  require_one_row(head, "WidebandSynthesizer");
  if (!(options.tolerance >= finest && options.tolerance <= coarsest))
    fail(ErrorKind::argument, "WidebandSynthesizer: tolerance = ", options.tolerance, ", must be within ", finest,
         " and ", coarsest, "; below that use the element-exact method");
  double widest = 0;
  for (const double u : beam_cosines(head.fan)) widest = std::max(widest, std::abs(u));
  plan_ = std::make_unique<Plan>(head, medium, SynthesisOptions{kept * options.tolerance, options.threads},
                                 std::min(1.0, 1.1 * widest + 0.05));
}
WidebandSynthesizer::~WidebandSynthesizer() = default;
WidebandSynthesizer::WidebandSynthesizer(WidebandSynthesizer&&) noexcept = default;
WidebandSynthesizer& WidebandSynthesizer::operator=(WidebandSynthesizer&&) noexcept = default;

ComplexGrid WidebandSynthesizer::pressure(const Echoes& echoes) const {
  const Plan& plan = *plan_;
  const WidebandPlan& tables = plan.tables();
  require_synthesis(echoes, tables.head, tables.medium, {tables.tolerance, plan.threads}, "WidebandSynthesizer");
  double widest = 0;
  for (const double u : echoes.u) widest = std::max(widest, std::abs(u));
  if (widest > tables.widest)
    return Plan(tables.head, tables.medium, {tables.tolerance, plan.threads}, widest).pressure(echoes);
  return plan.pressure(echoes);
}

WidebandSynthesizer::Plan::Plan(const SonarHead& head, const Medium& medium, const SynthesisOptions& options,
                                double widest)
    : threads(options.threads) {
  const auto bins = static_cast<double>(head.gate.bins());
  const std::size_t ends = wideband_guard(head, medium, options.tolerance, widest);
  guard = static_cast<double>(ends);
  const auto fits = [&](double range, std::size_t level) {
    const double far = range + static_cast<double>(2 * ends << level) * head.gate.bin_size;
    return BendPhase(head, medium, range, far).over_range <= most_phase;
  };
  nearest = std::max(wideband_nearest(head, medium, options.tolerance), 1e-3 * head.gate.bin_size);
  while (!fits(nearest, 0)) nearest *= 1.02;
  // Longer blocks spend less on their ends, but their wavefronts differ more.
  double first = std::max(-guard, std::ceil((nearest - head.gate.min_range) / head.gate.bin_size));
  do {
    const double range = std::max(nearest, head.gate.min_range + first * head.gate.bin_size);
    const double allowed = range / head.gate.bin_size, wanted = bins + guard - first;
    std::size_t level = 0;
    while (level < 2 && static_cast<double>(2 * ends << level) < wanted &&
           static_cast<double>(2 * ends << (level + 1)) <= allowed && fits(range, level + 1))
      ++level;
    while (levels.size() <= level)
      levels.push_back(std::make_unique<Level>(head, medium, options, widest, 2 * ends << levels.size()));
    const double last = first + static_cast<double>(levels[level]->tables.block);
    levels[level]->blocks.push_back(blocks.size());
    blocks.emplace_back(first, last, level);
    first = last;
  } while (first < bins + guard);
}

ComplexGrid WidebandSynthesizer::Plan::pressure(const Echoes& echoes) const {
  // Echoes by block; none is of use beyond the last one.
  const TimeAxis& axis = tables().axis;
  std::vector<std::vector<std::uint32_t>> of_block(blocks.size());
  std::vector<std::size_t> near;
  std::vector<std::uint32_t> block_of;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    block_of.resize(static_cast<std::size_t>(blocks[b].last - blocks[0].first), static_cast<std::uint32_t>(b));
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const double bin = (echoes.delay[i] - axis.start) / axis.step - blocks[0].first;
    if (bin < 0 && bin + blocks[0].first >= -guard)
      near.push_back(i);
    else if (bin >= 0 && bin < static_cast<double>(block_of.size()))
      of_block[block_of[static_cast<std::size_t>(bin)]].push_back(static_cast<std::uint32_t>(i));
  }
  ComplexGrid pressure(tables().head.fan.beams(), axis.bins);
  pressure.setZero();
  // Neighbouring blocks share bins.
  for (const auto& level : levels) {
    for (const std::size_t parity : {0U, 1U})
      parallel_for(level->blocks.size(), threads, [&](std::size_t k) {
        const std::size_t b = level->blocks[k];
        if (b % 2 != parity || of_block[b].empty()) return;
        const FlushDenormals flush;
        auto room = level->rooms.take(level->tables, level->transforms);
        room->add_image(echoes, of_block[b], blocks[b].of(level->tables), pressure);
        level->rooms.give(std::move(room));
      });
  }
  if (!near.empty()) add_nearest(some_of(echoes, near), pressure);
  return pressure;
}

void WidebandSynthesizer::Plan::add_nearest(const Echoes& echoes, ComplexGrid& pressure) const {
  const WidebandPlan& tables = this->tables();
  const PulseReach reach(tables.head.pulse, tables.medium.absorption, tables.medium.sound_speed, true, tables.cut);
  const double last = *std::max_element(echoes.delay.begin(), echoes.delay.end()),
               beyond = tables.aperture + 0.5 * tables.medium.sound_speed * reach.at(last);
  SonarHead head = tables.head;
  head.gate.max_range = std::min(head.gate.max_range, 0.5 * tables.medium.sound_speed * last + beyond);
  if (head.gate.max_range <= head.gate.min_range) return;
  const ElementOptions options{0.5 * tables.tolerance, Wavefront::spherical, threads};
  const ComplexGrid image =
      beam_from_elements(element_series(echoes, head, tables.medium, options), head, tables.medium, options);
  pressure.leftCols(image.cols()) += image;
}

ComplexGrid synthesize_true_delays(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                   const SynthesisOptions& options) {
  return WidebandSynthesizer(head, medium, options).pressure(echoes);
}

}  // namespace insonify
