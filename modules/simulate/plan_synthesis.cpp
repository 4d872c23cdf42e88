// Stages of the plan that are ways of forming beams.
#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "simulate/plan_stages_internal.hpp"

namespace insonify {
namespace {

/// Sets `method`, or leaves it for gridding if it is the one in force; another method stays as it is.
template <SynthesisMethod method>
void force_method(bool included, Environment&, SimulationOptions& options) {
  SynthesisMethod& chosen = options.synthesis.method;
  if (included)
    chosen = method;
  else if (chosen == method)
    chosen = SynthesisMethod::gridded;
}

const char* sums_intensities(const Environment&, const SimulationOptions& options) {
  return options.synthesis.method == SynthesisMethod::incoherent ? "method incoherent adds intensities, not pressures"
                                                                 : nullptr;
}

StageVerdict judge_direct_sum(const PlanFacts& facts) {
  const bool direct = facts.ping.options.synthesis.method == SynthesisMethod::direct;
  return {direct, direct ? "asked for" : "gridding keeps the tolerance", facts.ping.options.synthesis.tolerance};
}

/// First-order change of the image by the pulse's different arrival at the elements, 2.668 B / (2 pi f) |du B'|, and by
/// what focusing leaves of the waves' curvature, |du B''| u / (k r), each as a root mean square over the pattern B.
double true_delay_bound(const PlanFacts& facts) {
  const SonarHead& head = facts.ping.head;
  const double k = 2 * pi * head.pulse.centre_frequency / facts.ping.sent.medium.sound_speed;
  std::vector<double> u_beam;
  for (std::size_t b = 0; b < head.fan.beams(); ++b)
    u_beam.push_back(std::cos(head.fan.elevation[b]) * std::sin(head.fan.azimuth[b]));
  const auto [low, high] = std::minmax_element(u_beam.begin(), u_beam.end());
  const double span = std::min(2.0, *high - *low + 2 * std::sin(std::min(head.fan.beam_width, pi / 2)));
  const std::size_t elements = head.array.elements(), steps = 8 * elements + 64;
  double pattern = 0, first = 0, second = 0;
  for (std::size_t s = 0; s < steps; ++s) {
    const double du = span * (2 * (static_cast<double>(s) + 0.5) / static_cast<double>(steps) - 1);
    double b = 0, b1 = 0, b2 = 0;
    for (std::size_t m = 0; m < elements; ++m) {
      const double y = head.array.spacing * element_place(m, elements), w = head.array.shading[m];
      const double cosine = std::cos(k * y * du), sine = std::sin(k * y * du);
      b += w * cosine, b1 -= w * k * y * sine, b2 -= w * k * y * k * y * cosine;
    }
    pattern += b * b, first += du * du * b1 * b1, second += du * du * b2 * b2;
  }
  const double band = 2.668 * head.pulse.bandwidth / (2 * pi * head.pulse.centre_frequency);
  const double steepest = std::max(std::abs(*low), std::abs(*high));
  const double nearest = facts.sample.in_view_nearest;
  const double curvature = nearest > 0 ? steepest / (k * nearest) : 0;
  return std::min(2.0, plan_margin * (band * std::sqrt(first / pattern) + curvature * std::sqrt(second / pattern)));
}

StageVerdict judge_true_delays(const PlanFacts& facts) {
  const SynthesisMethod method = facts.ping.options.synthesis.method;
  const bool exact = method == SynthesisMethod::element_exact || method == SynthesisMethod::true_delays;
  return {exact,
          exact ? "asked for" : "one beam pattern at all frequencies and ranges, focused: narrow band, far field",
          true_delay_bound(facts)};
}

StageVerdict judge_double_precision(const PlanFacts& facts) {
  const bool single = facts.synthesis.single_precision;
  const SynthesisSettings& synthesis = facts.ping.options.synthesis;
  return {synthesis.method == SynthesisMethod::direct || !single,
          single ? "the tolerance leaves room for single precision" : "the tolerance needs it", synthesis.tolerance};
}

constexpr PlanStage stages[] = {
    {"direct-sum", judge_direct_sum, force_method<SynthesisMethod::direct>, sums_intensities},
    {"true-delays", judge_true_delays, force_method<SynthesisMethod::element_exact>, sums_intensities},
    {"double-precision", judge_double_precision}};

}  // namespace

std::span<const PlanStage> synthesis_stages() { return stages; }

}  // namespace insonify
