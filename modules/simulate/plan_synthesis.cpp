// Stages of the plan that are ways of forming beams.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "beamforming/reference/element_series.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "simulate/narrow_band_loops_internal.hpp"
#include "simulate/plan_stages_internal.hpp"
#include "simulate/pulse_spectrum_internal.hpp"

namespace insonify {
namespace {

/// Sets the direct sum, or leaves it for gridding if it is the one in force; another method stays as it is.
void force_direct_sum(bool included, Environment&, SimulationOptions& options) {
  SynthesisMethod& method = options.synthesis.method;
  if (included)
    method = SynthesisMethod::direct;
  else if (method == SynthesisMethod::direct)
    method = SynthesisMethod::gridded;
}

const char* sums_intensities(const Environment&, const SimulationOptions& options, const PingEvent&) {
  return options.synthesis.method == SynthesisMethod::incoherent ? "method incoherent adds intensities, not pressures"
                                                                 : nullptr;
}

StageVerdict judge_direct_sum(const PlanFacts& facts) {
  const bool direct = facts.ping.options.synthesis.method == SynthesisMethod::direct;
  return {direct, direct ? "asked for" : "gridding keeps the tolerance", facts.ping.options.synthesis.tolerance};
}

/// The narrow-band, far-field image against what elements receive, for some echoes of the sample in some beams: at
/// frequency f off the carrier the phase of element y is k (1 + f / f_c) times the difference of the ways to it that
/// echo and focus have (E61, E62); gridding takes -k y (u - u_b) (E10). The focus stands where the bin is: the pulse's
/// length before and behind the echo.
class NarrowBandError {
 public:
  explicit NarrowBandError(const PlanFacts& facts) : head_(facts.ping.head), nodes_(spectrum_nodes(head_.pulse)) {
    const double c = facts.ping.sent.medium.sound_speed;
    cycles_per_m_ = head_.pulse.centre_frequency / c;
    off_focus_ = std::sqrt(3 * std::numbers::ln2 / 2) * c / (2 * pi * head_.pulse.bandwidth);
    for (std::size_t b = 0; b < head_.fan.beams(); ++b)
      u_beam_.push_back(std::cos(head_.fan.elevation[b]) * std::sin(head_.fan.azimuth[b]));
    for (std::size_t m = 0; m < head_.array.elements(); ++m)
      y_.push_back(head_.array.spacing * element_place(m, head_.array.elements()));
    shading_ = head_.array.shading;
    while (y_.size() % kernels::phasor_lanes != 0) y_.push_back(0), shading_.push_back(0);
  }

  /// How many places to add.
  double places() const { return std::max(32.0, 768.0 / static_cast<double>(std::min(u_beam_.size(), near_beams))); }

  /// Sums of squares over beams.
  struct Sums {
    double error = 0, image = 0;
  };
  /// Those of an echo from (range, u) that stands for `times`: all beams that have it in or near their main lobes, and a
  /// few that stand for the rest.
  Sums of(double range, double u, double times) const {
    std::vector<double> u_beam = u_beam_;
    const std::size_t beams = u_beam.size(), near = std::min(near_beams, beams);
    std::sort(u_beam.begin(), u_beam.end(), [u](double a, double b) { return std::abs(a - u) < std::abs(b - u); });
    Sums sums;
    std::vector<double> room(2 * Phasors::rows * y_.size());
    for (std::size_t b = 0; b < near; ++b) add_beam(range, u, u_beam[b], times, room, sums);
    const std::size_t rest = beams - near, step = std::max<std::size_t>(1, rest / far_beams);
    for (std::size_t b = near + step / 2; b < beams; b += step)
      add_beam(range, u, u_beam[b], times * static_cast<double>(step), room, sums);
    return sums;
  }

 private:
  using Phasors = kernels::EchoPhasors;
  static constexpr std::size_t near_beams = 16, far_beams = 8;

  // Nodes of the spectrum with the focus at the echo, and nodes of the pulse's length at the carrier: both at once are
  // of higher order.
  void add_beam(double range, double u, double u_beam, double weight, std::vector<double>& room, Sums& sums) const {
    Phasors p{};
    for (std::size_t row = 0; row < Phasors::rows; ++row)
      p.cosine[row] = room.data() + 2 * row * y_.size(), p.sine[row] = p.cosine[row] + y_.size();
    const double carrier = head_.pulse.centre_frequency;
    kernels::echo_phasors(y_.data(), y_.size(),
                          {range, u, u_beam, std::max(range - off_focus_, 0.3 * range), range + off_focus_,
                           cycles_per_m_, nodes_[3].frequency / carrier, nodes_[4].frequency / carrier},
                          p);
    const kernels::PhasorSums all = kernels::sum_phasors(shading_.data(), y_.size(), p);
    const auto sum_of = [](const double(&parts)[2]) { return std::complex(parts[0], parts[1]); };
    const std::complex<double> narrow = sum_of(all.row[p.narrow]), before = sum_of(all.row[p.before]),
                               behind = sum_of(all.row[p.behind]);
    std::complex<double> truth[5];  // nodes come in pairs about the carrier
    truth[2] = sum_of(all.row[p.carrier]);
    for (const int n : {1, 2}) {
      const std::complex<double> by_cosine = sum_of(all.by_cosine[n - 1]), by_sine = sum_of(all.by_sine[n - 1]);
      truth[2 + n] = by_cosine + by_sine, truth[2 - n] = by_cosine - by_sine;
    }
    const auto add_node = [&](const std::complex<double>& t, double part) {
      sums.error += weight * part * std::norm(t - narrow);
      sums.image += weight * part * std::norm(t);
    };
    for (std::size_t n = 0; n < nodes_.size(); ++n) add_node(truth[n], nodes_[n].weight - (n == 2 ? 1.0 / 3 : 0));
    add_node(before, 1.0 / 6);
    add_node(behind, 1.0 / 6);
  }

  const SonarHead& head_;
  std::array<SpectrumNode, 5> nodes_;
  double cycles_per_m_, off_focus_;
  std::vector<double> u_beam_, y_, shading_;
};

/// The error of all places with these powers at an element, and their image, by some of them that each stand for the same
/// power [Pa^2, summed over beams].
NarrowBandError::Sums narrow_band_sums(const PlanFacts& facts, const NarrowBandError& error,
                                       const std::vector<double>& power) {
  const SceneSample& s = facts.sample;
  const double all = std::accumulate(power.begin(), power.end(), 0.0), part = all / error.places();
  double passed = -0.5 * part;
  std::vector<std::pair<std::size_t, double>> places;  // and how many each stands for
  for (std::size_t i = 0; i < power.size(); ++i) {
    passed += power[i];
    if (power[i] == 0 || passed < 0) continue;
    places.emplace_back(i, std::floor(passed / part) + 1);
    passed -= places.back().second * part;
  }
  std::vector<NarrowBandError::Sums> sums(places.size());
  parallel_blocks(places.size(), 8, facts.ping.options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto [i, times] = places[k];
      sums[k] = error.of(s.places.range[i], std::cos(s.places.elevation[i]) * std::sin(s.places.azimuth[i]), times);
    }
  });
  NarrowBandError::Sums sum;
  for (const auto& of_place : sums) sum.error += part * of_place.error, sum.image += part * of_place.image;
  return sum;
}

/// Of what is in view, and of what side lobes hear unless it is out by the options.
double narrow_band_bound(const PlanFacts& facts) {
  const NarrowBandError error(facts);
  const NarrowBandError::Sums inside = narrow_band_sums(facts, error, facts.sample.power),
                              beside = narrow_band_sums(facts, error, facts.sample.power_off_azimuth);
  return added_bound(facts, inside.image > 0 ? (inside.error + beside.error) / inside.image * facts.sample.in_view : 0);
}

StageVerdict judge_true_delays(const PlanFacts& facts) {
  if (facts.ping.options.synthesis.method == SynthesisMethod::incoherent)
    return {false, "intensities have no delays across the array", 0};
  const bool planar = facts.ping.head.column.has_value();
  return {false,
          planar ? "a planar array is summed row by row for them, at that cost: only by --with true-delays"
                 : "elements receive wide bands and near echoes at other times: one pattern does not hold",
          narrow_band_bound(facts), planar};
}

/// What the plan does where the narrow-band image is not good enough.
void force_true_delays(bool included, Environment&, SimulationOptions& options) {
  auto& [method, tolerance, true_delays] = options.synthesis;
  true_delays = chosen(included);
  if (!included) {
    if (method == SynthesisMethod::true_delays || method == SynthesisMethod::element_exact)
      method = SynthesisMethod::gridded;
    return;
  }
  const bool fast = tolerance >= min_true_delay_tolerance;  // finer than that only the referee is
  method = fast ? SynthesisMethod::true_delays : SynthesisMethod::element_exact;
  tolerance = std::min(tolerance, max_element_tolerance);
}

/// A method given by name is what it is; gridding leaves it to `true_delays`.
Choice asked_true_delays(const SimulationOptions& options) {
  switch (options.synthesis.method) {
    case SynthesisMethod::gridded:
      return options.synthesis.true_delays;
    case SynthesisMethod::true_delays:
    case SynthesisMethod::element_exact:
      return Choice::always;
    default:
      return Choice::never;
  }
}

StageVerdict judge_double_precision(const PlanFacts& facts) {
  const bool single = facts.synthesis.single_precision;
  const SynthesisSettings& synthesis = facts.ping.options.synthesis;
  return {synthesis.method == SynthesisMethod::direct || !single,
          single ? "the tolerance leaves room for single precision" : "the tolerance needs it", synthesis.tolerance};
}

constexpr PlanStage stages[] = {
    {"direct-sum", DecidedBy::choice, judge_direct_sum, force_direct_sum, sums_intensities},
    {"true-delays", DecidedBy::budget, judge_true_delays, force_true_delays, sums_intensities, asked_true_delays},
    {"double-precision", DecidedBy::scene, judge_double_precision}};

}  // namespace

std::span<const PlanStage> synthesis_stages() { return stages; }

}  // namespace insonify
