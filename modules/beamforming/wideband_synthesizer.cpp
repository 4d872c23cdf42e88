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

/// A plan and its transforms, and the range from which on it is used [m].
struct Level {
  WidebandPlan tables;
  WidebandTransforms transforms;
  double nearest;

  Level(const SonarHead& head, const Medium& medium, const SynthesisOptions& options, double widest, std::size_t parts,
        double used_from)
      : tables(head, medium, options, widest, parts, used_from),
        transforms(tables),
        nearest(std::max(tables.nearest(), parts == 1 ? 0 : used_from)) {}
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
  std::vector<std::unique_ptr<Level>> levels;  ///< of the whole array, and of ever shorter parts
  int threads;

  Plan(const SonarHead& head, const Medium& medium, const SynthesisOptions& options, double widest);
  const WidebandPlan& whole() const { return levels[0]->tables; }
  ComplexGrid pressure(const Echoes& echoes) const;
  /// The image of the whole array.
  ComplexGrid far_image(const Echoes& echoes) const;
  /// Adds that of the array's parts, one after another.
  void add_parts(const Echoes& echoes, const Level& level, ComplexGrid& pressure) const;
  /// Adds echoes nearer than any level reaches, element by element.
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
  const WidebandPlan& tables = plan.whole();
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
  const double length = head.array.spacing * static_cast<double>(head.array.elements() - 1);
  double used_from = 1e9;
  // Parts of four elements at least, and no more of them than the gate's begin asks for.
  for (std::size_t parts = 1; parts == 1 || 4 * parts <= head.array.elements(); parts *= 2) {
    if (used_from < std::max(0.6 * length, head.gate.min_range - 0.5 * length)) break;
    levels.push_back(
        std::make_unique<Level>(head, medium, options, widest, parts, std::max(0.6 * length, 0.25 * used_from)));
    used_from = levels.back()->nearest;
  }
}

ComplexGrid WidebandSynthesizer::Plan::pressure(const Echoes& echoes) const {
  std::vector<std::vector<std::size_t>> of_level(levels.size() + 1);
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const double range = 0.5 * whole().medium.sound_speed * echoes.delay[i];
    std::size_t level = 0;
    while (level < levels.size() && range < levels[level]->nearest) ++level;
    of_level[level].push_back(i);
  }
  ComplexGrid pressure = far_image(of_level[0].size() == echoes.size() ? echoes : some_of(echoes, of_level[0]));
  for (std::size_t level = 1; level < levels.size(); ++level)
    if (!of_level[level].empty()) add_parts(some_of(echoes, of_level[level]), *levels[level], pressure);
  if (!of_level.back().empty()) add_nearest(some_of(echoes, of_level.back()), pressure);
  return pressure;
}

ComplexGrid WidebandSynthesizer::Plan::far_image(const Echoes& echoes) const {
  const WidebandPlan& tables = whole();
  const SeenEchoes seen = seen_by(echoes, tables, 0);
  const WidebandLists lists(seen, tables, 0);
  ComplexGrid pressure(tables.head.fan.beams(), tables.axis.bins);
  const std::size_t blocks = tables.blocks();
  Rooms rooms;
  // Every other block overwrites; those between add to what they share with both neighbours.
  for (const std::size_t parity : {0U, 1U})
    parallel_for(blocks / 2 + 1, threads, [&](std::size_t t) {
      const std::size_t number = 2 * t + parity;
      std::size_t ends = parity == 0 ? 0 : 2 * tables.guard;
      if (parity == 1 && number >= blocks) return;
      if (number >= blocks || lists.empty(number)) {
        const auto [from, to] = bins_of(tables, number, ends);
        pressure.middleCols(from, to - from).setZero();
        return;
      }
      const FlushDenormals flush;
      auto room = rooms.take(tables, levels[0]->transforms);
      for (const WidebandBlock& part : lists.of(number)) {
        room->image(seen, part, ends, pressure);
        ends = tables.cycle / 2;  // all is there now: what follows adds
      }
      rooms.give(std::move(room));
    });
  return pressure;
}

void WidebandSynthesizer::Plan::add_parts(const Echoes& echoes, const Level& level, ComplexGrid& pressure) const {
  const WidebandPlan& tables = level.tables;
  Rooms rooms;
  for (std::size_t part = 0; part < tables.parts.count(); ++part) {
    const SeenEchoes seen = seen_by(echoes, tables, part);
    const WidebandLists lists(seen, tables, part);
    // Neighbouring blocks share bins.
    for (const std::size_t parity : {0U, 1U})
      parallel_for(tables.blocks() / 2 + 1, threads, [&](std::size_t t) {
        const std::size_t number = 2 * t + parity;
        if (number >= tables.blocks() || lists.empty(number)) return;
        const FlushDenormals flush;
        auto room = rooms.take(tables, level.transforms);
        for (const WidebandBlock& block : lists.of(number)) room->image(seen, block, 0, pressure);
        rooms.give(std::move(room));
      });
  }
}

void WidebandSynthesizer::Plan::add_nearest(const Echoes& echoes, ComplexGrid& pressure) const {
  const WidebandPlan& tables = whole();
  const PulseReach reach(tables.head.pulse, tables.medium.absorption, tables.medium.sound_speed, true, tables.cut);
  const double last = *std::max_element(echoes.delay.begin(), echoes.delay.end()),
               beyond = tables.parts.aperture + 0.5 * tables.medium.sound_speed * reach.at(last);
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
