#include "beamforming/wideband_synthesizer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
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
      const auto by_delay = [&](std::uint32_t a, std::uint32_t b) { return echoes.delay[a] < echoes.delay[b]; };
      const auto [first, last] = std::minmax_element(list.begin(), list.end(), by_delay);
      double unit = 0;
      for (const std::uint32_t i : list)
        unit = std::max(unit, std::abs(echoes.amplitude[i]) * std::exp(-tables.medium.absorption.a0 *
                                                                       tables.medium.sound_speed * echoes.delay[i]));
      const double curvature = (1 / echoes.delay[*first] + 1 / echoes.delay[*last]) / tables.medium.sound_speed;
      WidebandRoom room(tables, plan.transforms);
      room.image(echoes, {number, list, curvature, unit > 0 ? unit : 1}, ends, pressure);
    });
  return pressure;
}

}  // namespace insonify
