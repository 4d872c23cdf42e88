#include "accuracy/synthesize_windowed.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "acoustics/pulse.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t echoes_at_once = 2048;

/// The beam pattern, an even function of the difference of direction cosines.
class PatternTable {
 public:
  PatternTable(const LineArray& array, double wavelength, double tolerance) {
    // Cubic interpolation errs by 3/128 step^4 |B''''|, and B is a sum of cosines no faster than `fastest`.
    const double fastest = pi * static_cast<double>(array.elements()) * array.spacing / wavelength;
    step_ = std::pow(128.0 / 3 * 0.1 * tolerance, 0.25) / fastest;
    const auto size = static_cast<std::size_t>(2 / step_) + 5;
    for (std::size_t k = 0; k < size; ++k)
      value_.push_back(array_response(array, wavelength, (static_cast<double>(k) - 1) * step_, 0));
  }
  double at(double u) const {
    const double x = std::abs(u) / step_, whole = std::floor(x), t = x - whole;
    const double* v = value_.data() + static_cast<std::size_t>(whole);
    return -t * (t - 1) * (t - 2) / 6 * v[0] + (t + 1) * (t - 1) * (t - 2) / 2 * v[1] -
           (t + 1) * t * (t - 2) / 2 * v[2] + (t + 1) * t * (t - 1) / 6 * v[3];
  }

 private:
  double step_;
  std::vector<double> value_;  ///< from -step on
};

void require_windowed(const SonarHead& head, const Medium& medium, const WindowedOptions& o) {
  require_valid(head, "synthesize_windowed");
  require_valid(medium, "synthesize_windowed");
  if (head.column || fan_rows(head.fan).size() != 1)
    fail(ErrorKind::argument, "synthesize_windowed: the head has several rows of beams, must have one");
  if (head.pulse.shape != PulseShape::gaussian)
    fail(ErrorKind::argument, "synthesize_windowed: the head sends a sweep, must be a Gaussian pulse");
  if (!(o.tolerance >= 1e-12 && o.tolerance < 1))
    fail(ErrorKind::argument, "synthesize_windowed: tolerance = ", o.tolerance, ", must be within [1e-12, 1)");
}

/// Samples of the pulses of some echoes: where each begins, and `length` of them.
struct CutPulses {
  std::vector<std::size_t> first, count;
  std::vector<std::complex<double>> sample;
};

class Windowed {
 public:
  Windowed(const SonarHead& head, const Medium& medium, const WindowedOptions& options)
      : head_(head),
        options_(options),
        shapes_(head.pulse, medium),
        start_(2 * head.gate.centre(0) / medium.sound_speed),
        step_(2 * head.gate.bin_size / medium.sound_speed),
        half_(pulse_half_length(head.pulse, 0.2 * options.tolerance)),
        length_(static_cast<std::size_t>(2 * half_ / step_) + 2),
        table_(head.array, medium.sound_speed / head.pulse.centre_frequency, options.tolerance),
        reach_(options.pattern_nulls * medium.sound_speed /
               (head.pulse.centre_frequency * head.array.spacing * static_cast<double>(head.array.elements()))) {
    for (std::size_t b = 0; b < head.fan.beams(); ++b)
      u_beam_.push_back(std::cos(head.fan.elevation[b]) * std::sin(head.fan.azimuth[b]));
  }

  void add(const Echoes& echoes, std::size_t first, std::size_t last, ComplexGrid& pressure) const {
    const CutPulses pulses = cut(echoes, first, last);
    parallel_for(u_beam_.size(), options_.threads, [&](std::size_t b) {
      for (std::size_t i = first; i < last; ++i) {
        const double du = echoes.u[i] - u_beam_[b];
        const std::size_t k = i - first, n0 = pulses.first[k];
        if (pulses.count[k] == 0 || (options_.pattern_nulls > 0 && std::abs(du) > reach_)) continue;
        const std::complex<double> weight = echoes.amplitude[i] * table_.at(du);
        std::complex<double>* p = &pressure(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(n0));
        const std::complex<double>* g = pulses.sample.data() + k * length_;
        for (std::size_t n = 0; n < pulses.count[k]; ++n) p[n] += times(weight, g[n]);
      }
    });
  }

 private:
  /// Complex product without the test for infinities of operator*.
  static std::complex<double> times(std::complex<double> a, std::complex<double> b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
  }

  CutPulses cut(const Echoes& echoes, std::size_t first, std::size_t last) const {
    CutPulses pulses;
    pulses.first.resize(last - first);
    pulses.count.resize(last - first);
    pulses.sample.resize((last - first) * length_);
    const auto bins = static_cast<double>(head_.gate.bins());
    parallel_for(last - first, options_.threads, [&](std::size_t k) {
      const double delay = echoes.delay[first + k];
      const EchoEnvelope envelope = shapes_.of(delay);
      const double place = options_.nearest_bin ? start_ + step_ * std::nearbyint((delay - start_) / step_) : delay;
      const double low = std::max(0.0, std::ceil((place - half_ - start_) / step_));
      const double high = std::min(bins - 1, std::floor((place + half_ - start_) / step_));
      if (high < low) return;
      pulses.first[k] = static_cast<std::size_t>(low);
      pulses.count[k] = std::min(length_, static_cast<std::size_t>(high - low) + 1);
      for (std::size_t n = 0; n < pulses.count[k]; ++n)
        pulses.sample[k * length_ + n] = envelope.at(start_ + (low + static_cast<double>(n)) * step_ - place);
    });
    return pulses;
  }

  const SonarHead& head_;
  WindowedOptions options_;
  EchoShapes shapes_;
  double start_, step_, half_;
  std::size_t length_;
  PatternTable table_;
  double reach_;
  std::vector<double> u_beam_;
};

}  // namespace

struct WindowedSynthesizer::Plan {
  const SonarHead& head;
  Windowed windowed;
};

WindowedSynthesizer::WindowedSynthesizer(const SonarHead& head, const Medium& medium, const WindowedOptions& options) {
  require_windowed(head, medium, options);
  plan_ = std::unique_ptr<Plan>(new Plan{head, Windowed(head, medium, options)});
}

WindowedSynthesizer::~WindowedSynthesizer() = default;

ComplexGrid WindowedSynthesizer::pressure(const Echoes& echoes) const {
  if (!echoes.doppler.empty())
    fail(ErrorKind::argument, "synthesize_windowed: the echoes have Doppler shifts, must have none");
  ComplexGrid pressure = ComplexGrid::Zero(plan_->head.fan.beams(), plan_->head.gate.bins());
  for (std::size_t first = 0; first < echoes.size(); first += echoes_at_once)
    plan_->windowed.add(echoes, first, std::min(first + echoes_at_once, echoes.size()), pressure);
  return pressure;
}

ComplexGrid synthesize_windowed(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                const WindowedOptions& options) {
  return WindowedSynthesizer(head, medium, options).pressure(echoes);
}

}  // namespace insonify
