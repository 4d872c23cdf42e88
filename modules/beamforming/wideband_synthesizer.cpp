#include "beamforming/wideband_synthesizer.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include "beamforming/element_series.hpp"
#include "beamforming/flush_denormals_internal.hpp"
#include "beamforming/wideband_lists_internal.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace insonify {
namespace {

constexpr double finest = 1e-5, coarsest = 0.1;
constexpr double kept = 0.7;  // of the tolerance, for what bounds leave out

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

/// Bins of the axis that a block's cycle covers but for `ends` bins of it: first and one after the last.
std::pair<std::size_t, std::size_t> bins_of(const WidebandPlan& plan, std::size_t number, std::size_t ends) {
  const std::size_t before = 2 * plan.guard, last = plan.axis.bins + before;
  const std::size_t from = std::clamp(number * plan.block + ends, before, last) - before;
  return {from, std::max(from, std::clamp(number * plan.block + plan.cycle - ends, before, last) - before)};
}

/// Echoes so near that no series keeps the tolerance, element by element.
ComplexGrid near_image(const Echoes& echoes, const WidebandPlan& plan, const WidebandBlock& block) {
  Echoes near;
  for (const std::uint32_t i : block.list) {
    near.delay.push_back(echoes.delay[i]);
    near.u.push_back(echoes.u[i]);
    near.amplitude.push_back(echoes.amplitude[i]);
    if (!echoes.doppler.empty()) near.doppler.push_back(echoes.doppler[i]);
  }
  const auto [from, to] = bins_of(plan, block.number, 0);
  SonarHead head = plan.head;
  head.gate.min_range += static_cast<double>(from) * head.gate.bin_size;
  head.gate.max_range = head.gate.min_range + (static_cast<double>(to - from) - 0.5) * head.gate.bin_size;
  const ElementOptions options{0.5 * plan.tolerance, Wavefront::spherical, 1};
  return beam_from_elements(element_series(near, head, plan.medium, options), head, plan.medium, options);
}

}  // namespace

struct WidebandSynthesizer::Plan {
  WidebandPlan tables;
  WidebandTransforms transforms;
  int threads;

  Plan(const SonarHead& head, const Medium& medium, const SynthesisOptions& options, double widest)
      : tables(head, medium, options, widest), transforms(tables), threads(options.threads) {}
  ComplexGrid pressure(const Echoes& echoes) const;
  /// The parts of one block, one after another; see WidebandRoom::image.
  void add_block(const Echoes& echoes, const std::vector<WidebandBlock>& parts, std::size_t ends, Rooms& rooms,
                 ComplexGrid& pressure) const;
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
  const WidebandPlan& tables = plan.tables;
  require_synthesis(echoes, tables.head, tables.medium, {tables.tolerance, plan.threads}, "WidebandSynthesizer");
  double widest = 0;
  for (const double u : echoes.u) widest = std::max(widest, std::abs(u));
  if (widest > tables.widest)
    return Plan(tables.head, tables.medium, {tables.tolerance, plan.threads}, widest).pressure(echoes);
  return plan.pressure(echoes);
}

ComplexGrid WidebandSynthesizer::Plan::pressure(const Echoes& echoes) const {
  const WidebandLists lists(echoes, tables);
  ComplexGrid pressure(tables.head.fan.beams(), tables.axis.bins);
  const std::size_t blocks = tables.blocks();
  Rooms rooms;
  // Every other block overwrites; those between add to what they share with both neighbours.
  for (const std::size_t parity : {0U, 1U})
    parallel_for(blocks / 2 + 1, threads, [&](std::size_t t) {
      const std::size_t number = 2 * t + parity, ends = parity == 0 ? 0 : 2 * tables.guard;
      if (parity == 1 && number >= blocks) return;
      if (number >= blocks || lists.empty(number)) {
        const auto [from, to] = bins_of(tables, number, ends);
        pressure.middleCols(from, to - from).setZero();
        return;
      }
      add_block(echoes, lists.of(number), ends, rooms, pressure);
    });
  return pressure;
}

void WidebandSynthesizer::Plan::add_block(const Echoes& echoes, const std::vector<WidebandBlock>& parts,
                                          std::size_t ends, Rooms& rooms, ComplexGrid& pressure) const {
  const FlushDenormals flush;
  auto room = rooms.take(tables, transforms);
  for (const WidebandBlock& part : parts) {
    if (part.effort.error <= tables.tolerance) {
      room->image(echoes, part, ends, pressure);
    } else if (const auto [from, to] = bins_of(tables, part.number, 0); from < to) {
      const auto [own_from, own_to] = bins_of(tables, part.number, ends);
      pressure.middleCols(own_from, own_to - own_from).setZero();
      pressure.middleCols(from, to - from) += near_image(echoes, tables, part);
    }
    ends = tables.cycle / 2;  // all is there now: what follows adds
  }
  rooms.give(std::move(room));
}

ComplexGrid synthesize_true_delays(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                   const SynthesisOptions& options) {
  return WidebandSynthesizer(head, medium, options).pressure(echoes);
}

}  // namespace insonify
