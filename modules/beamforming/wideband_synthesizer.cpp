#include "beamforming/wideband_synthesizer.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <vector>

#include "beamforming/flush_denormals_internal.hpp"
#include "beamforming/wideband_block_internal.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace insonify {
namespace {

/// Echoes in order of the fine samples at which they stand, blocks one after another.
struct BlockLists {
  std::vector<std::uint32_t> begin, echo;

  BlockLists(const Echoes& echoes, const WidebandPlan& plan) {
    constexpr double part = 16;  // slots of a block
    const double slot = static_cast<double>(plan.block) / part * plan.axis.step;
    const double start = plan.axis.start - static_cast<double>(plan.guard) * plan.axis.step;
    const std::size_t slots = plan.blocks() * static_cast<std::size_t>(part);
    std::vector<std::uint32_t> place(echoes.size()), count(slots + 1, 0);
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      const double s = std::floor((echoes.delay[i] - start) / slot);
      place[i] = s >= 0 && s < static_cast<double>(slots) ? static_cast<std::uint32_t>(s) : static_cast<std::uint32_t>(slots);
      ++count[place[i]];
    }
    std::uint32_t sum = 0;
    for (std::size_t s = 0; s <= slots; ++s) {
      if (s % 16 == 0) begin.push_back(sum);
      const std::uint32_t here = count[s];
      count[s] = sum;
      sum += here;
    }
    echo.resize(echoes.size());
    for (std::size_t i = 0; i < echoes.size(); ++i) echo[count[place[i]]++] = static_cast<std::uint32_t>(i);
  }
  std::span<const std::uint32_t> of(std::size_t block) const {
    return {echo.data() + begin[block], begin[block + 1] - begin[block]};
  }
};

/// The echoes of a block, cut by range until what their wavefronts differ in is small enough; in order of delay if cut.
std::vector<WidebandBlock> parts_of(const Echoes& echoes, const WidebandPlan& plan, std::size_t number,
                                    std::span<const std::uint32_t> list) {
  const double c = plan.medium.sound_speed;
  const auto part_of = [&](std::span<const std::uint32_t> some) {
    double first = echoes.delay[some[0]], last = first, unit = 0;
    for (const std::uint32_t i : some) {
      first = std::min(first, echoes.delay[i]);
      last = std::max(last, echoes.delay[i]);
      unit = std::max(unit, std::abs(echoes.amplitude[i]) * std::exp(-plan.medium.absorption.a0 * c * echoes.delay[i]));
    }
    first = std::max(first, plan.axis.step);
    const double curvature = (1 / first + 1 / std::max(last, first)) / c;
    return WidebandBlock{number, some, curvature, unit > 0 ? unit : 1,
                         plan.effort(curvature, 2 / (c * first * curvature) - 1)};
  };
  constexpr std::size_t slots = 16;  // of a block, in which echoes are ordered
  std::vector<WidebandBlock> parts;
  for (std::size_t cut = 1; cut <= slots; cut *= 2) {
    parts.clear();
    double error = 0;
    std::size_t begin = 0;
    for (std::size_t k = 1; k <= cut; ++k) {
      const double until = plan.start_of(number) + (static_cast<double>(plan.guard) + static_cast<double>(plan.block * k) / static_cast<double>(cut)) * plan.axis.step;
      std::size_t end = begin;
      while (end < list.size() && (k == cut || echoes.delay[list[end]] < until)) ++end;
      if (end > begin) {
        parts.push_back(part_of(list.subspan(begin, end - begin)));
        error = std::max(error, parts.back().effort.error);
      }
      begin = end;
    }
    if (error < plan.tolerance) break;
  }
  return parts;
}

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

}  // namespace

struct WidebandSynthesizer::Plan {
  WidebandPlan tables;
  WidebandTransforms transforms;
  int threads;

  Plan(const SonarHead& head, const Medium& medium, const SynthesisOptions& options, double widest)
      : tables(head, medium, options, widest), transforms(tables), threads(options.threads) {}
};

WidebandSynthesizer::WidebandSynthesizer(const SonarHead& head, const Medium& medium, const SynthesisOptions& options) {
  require_synthesis({}, head, medium, options, "WidebandSynthesizer");
  require_one_row(head, "WidebandSynthesizer");
  double widest = 0;
  for (const double u : beam_cosines(head.fan)) widest = std::max(widest, std::abs(u));
  plan_ = std::make_unique<Plan>(head, medium, options, std::min(1.0, 1.1 * widest + 0.05));
}
WidebandSynthesizer::~WidebandSynthesizer() = default;
WidebandSynthesizer::WidebandSynthesizer(WidebandSynthesizer&&) noexcept = default;
WidebandSynthesizer& WidebandSynthesizer::operator=(WidebandSynthesizer&&) noexcept = default;

ComplexGrid WidebandSynthesizer::pressure(const Echoes& echoes) const {
  const Plan& plan = *plan_;
  const WidebandPlan& tables = plan.tables;
  require_synthesis(echoes, tables.head, tables.medium, {tables.tolerance, plan.threads}, "WidebandSynthesizer");
  const BlockLists lists(echoes, tables);
  ComplexGrid pressure(tables.head.fan.beams(), tables.axis.bins);
  const std::size_t blocks = tables.blocks();
  Rooms rooms;
  // Every other block overwrites, those between add to what they share with both neighbours.
  for (const std::size_t parity : {0U, 1U})
    parallel_for(blocks / 2 + 1, plan.threads, [&](std::size_t t) {
      const std::size_t number = 2 * t + parity, ends = parity == 0 ? 0 : 2 * tables.guard;
      if (parity == 1 && number >= blocks) return;
      const auto list = number < blocks ? lists.of(number) : std::span<const std::uint32_t>();
      if (list.empty()) {
        const std::size_t skipped = 2 * tables.guard;
        const std::size_t from = std::clamp(number * tables.block + ends, skipped, tables.axis.bins + skipped) - skipped;
        const std::size_t to =
            std::clamp(number * tables.block + tables.cycle - ends, skipped, tables.axis.bins + skipped) - skipped;
        if (from < to) pressure.middleCols(from, to - from).setZero();
        return;
      }
      const FlushDenormals flush;
      auto room = rooms.take(tables, plan.transforms);
      std::size_t added = ends;
      for (const WidebandBlock& part : parts_of(echoes, tables, number, list)) {
        room->image(echoes, part, added, pressure);
        added = tables.cycle;
      }
      rooms.give(std::move(room));
    });
  return pressure;
}

}  // namespace insonify
