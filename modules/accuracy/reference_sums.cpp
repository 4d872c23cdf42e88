// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/reference_sums.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "sonar/pulse.hpp"
#include "sonar/pulse_kind.hpp"
#include "sonar/receive_array.hpp"

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
      value_.push_back(array_response(array, wavelength, (static_cast<double>(k) - 1) * step_, 0).real());
  }
  double at(double u) const {
    const double x = std::abs(u) / step_, whole = std::floor(x), t = x - whole;
    const double* v = value_.data() + static_cast<std::size_t>(whole);
    return -t * (t - 1) * (t - 2) / 6 * v[0] + (t + 1) * (t - 1) * (t - 2) / 2 * v[1] -
           (t + 1) * t * (t - 2) / 2 * v[2] + (t + 1) * t * (t - 1) / 6 * v[3];
  }

 private:
  double step_;
  std::vector<double> value_;  ///< pattern at multiples of step_, from -step_ on
};

void require_windowed(const SonarHead& head, const Medium& medium, const WindowedOptions& o) {
  require_valid(head, "windowed_synthesizer");
  require_valid(medium, "windowed_synthesizer");
  if (head.column || fan_rows(head.fan).size() != 1 || !has_line(head))
    fail(ErrorKind::argument, "windowed_synthesizer: the head must have one row of beams of a line array");
  if (!is_gaussian(head.pulse))
    fail(ErrorKind::argument, "windowed_synthesizer: the head has another pulse, must be a Gaussian");
  if (!(o.tolerance >= 1e-12 && o.tolerance < 1))
    fail(ErrorKind::argument, "windowed_synthesizer: tolerance = ", o.tolerance, ", must be within [1e-12, 1)");
}

/// Samples of the pulses of some echoes: where each begins, and `length` of them.
struct CutPulses {
  std::vector<std::size_t> first, count;
  ComplexGrid sample;  ///< echoes x samples
};

class Windowed {
 public:
  Windowed(const SonarHead& head, const Medium& medium, const WindowedOptions& options)
      : options_(options),
        shapes_(head.pulse, medium),
        start_(2 * head.gate.centre(0) / medium.sound_speed),
        step_(2 * head.gate.bin_size / medium.sound_speed),
        last_(static_cast<double>(head.gate.bins()) - 1),
        half_(pulse_half_length(head.pulse, 0.2 * options.tolerance)),
        length_(static_cast<std::size_t>(2 * half_ / step_) + 2),
        table_(head.array, medium.sound_speed / head.pulse.centre_frequency, options.tolerance),
        reach_(options.pattern_nulls * medium.sound_speed /
               (head.pulse.centre_frequency * head.array.spacing * static_cast<double>(head.array.elements()))),
        axes_(beam_axes(head.fan)) {}

  void add(const Echoes& echoes, std::size_t first, std::size_t last, ComplexGrid& pressure) const {
    const CutPulses pulses = cut(echoes, first, last);
    parallel_for(axes_.size(), options_.threads, [&](std::size_t b) {
      for (std::size_t i = first; i < last; ++i) {
        const double du = echoes.u[i] - axes_[b].y();
        const std::size_t k = i - first, n0 = pulses.first[k];
        if (pulses.count[k] == 0 || (options_.pattern_nulls > 0 && std::abs(du) > reach_)) continue;
        const std::complex<double> weight = echoes.amplitude[i] * table_.at(du);
        pressure.row(b).segment(n0, pulses.count[k]) += weight * pulses.sample.row(k).head(pulses.count[k]);
      }
    });
  }

 private:
  CutPulses cut(const Echoes& echoes, std::size_t first, std::size_t last) const {
    CutPulses pulses;
    pulses.first.resize(last - first);
    pulses.count.resize(last - first);
    pulses.sample.resize(last - first, length_);
    parallel_for(last - first, options_.threads, [&](std::size_t k) {
      const double delay = echoes.delay[first + k];
      const EchoEnvelope envelope = shapes_.of(delay);
      const double position = options_.nearest_bin ? start_ + step_ * std::nearbyint((delay - start_) / step_) : delay;
      const double low = std::max(0.0, std::ceil((position - half_ - start_) / step_));
      const double high = std::min(last_, std::floor((position + half_ - start_) / step_));
      if (high < low) return;
      pulses.first[k] = static_cast<std::size_t>(low);
      pulses.count[k] = std::min(length_, static_cast<std::size_t>(high - low) + 1);
      for (std::size_t n = 0; n < pulses.count[k]; ++n)
        pulses.sample(k, n) = envelope.at(start_ + (low + static_cast<double>(n)) * step_ - position);
    });
    return pulses;
  }

  WindowedOptions options_;
  EchoShapes shapes_;
  double start_, step_, last_, half_;
  std::size_t length_;
  PatternTable table_;
  double reach_;
  std::vector<Eigen::Vector3d> axes_;  ///< directions of the beams
};

using Extended = long double;
constexpr Extended turn = 2 * std::numbers::pi_v<Extended>;

/// Kahan's sum.
struct Sum {
  Extended value = 0, lost = 0;
  void add(Extended term) {
    const Extended corrected = term - lost, sum = value + corrected;
    lost = (sum - value) - corrected;
    value = sum;
  }
};

Extended response(const LineArray& array, Extended wavelength, Extended u, Extended u_beam) {
  const Extended step = turn * static_cast<Extended>(array.spacing) / wavelength * (u - u_beam);
  const std::size_t n = array.elements();
  Sum sum;
  for (std::size_t m = 0; m < n; ++m) {
    const Extended position = static_cast<Extended>(m) - (static_cast<Extended>(n) - 1) / 2;
    sum.add(static_cast<Extended>(array.shading[m]) * std::cos(step * position));
  }
  return sum.value / static_cast<Extended>(n);
}

/// The Gaussian pulse after absorption (E8) at t from its delay.
std::complex<Extended> envelope(const Pulse& pulse, const Absorption& absorption, Extended range, Extended t) {
  const Extended sent = 2 * std::numbers::ln2_v<Extended> /
                        (static_cast<Extended>(pulse.bandwidth) * static_cast<Extended>(pulse.bandwidth));
  const Extended a = sent + 2 * static_cast<Extended>(absorption.a2) * range;
  const Extended b = 2 * static_cast<Extended>(absorption.a1) * range, w = turn * t;
  const Extended gain =
      std::sqrt(sent / a) * std::exp((b * b - w * w) / (4 * a) - 2 * static_cast<Extended>(absorption.a0) * range);
  return std::polar(gain, b * w / (2 * a));
}

}  // namespace

std::function<ComplexGrid(const Echoes&)> windowed_synthesizer(const SonarHead& head, const Medium& medium,
                                                               const WindowedOptions& options) {
  require_windowed(head, medium, options);
  return [&head, windowed = Windowed(head, medium, options)](const Echoes& echoes) {
    if (!echoes.doppler.empty())
      fail(ErrorKind::argument, "windowed_synthesizer: the echoes have Doppler shifts, must have none");
    ComplexGrid pressure = ComplexGrid::Zero(head.fan.beams(), head.gate.bins());
    for (std::size_t first = 0; first < echoes.size(); first += echoes_at_once)
      windowed.add(echoes, first, std::min(first + echoes_at_once, echoes.size()), pressure);
    return pressure;
  };
}

ComplexGrid synthesize_extended(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                const std::vector<std::size_t>& bins, int threads) {
  const Extended c = medium.sound_speed, wavelength = c / static_cast<Extended>(head.pulse.centre_frequency);
  ComplexGrid pressure(head.fan.beams(), bins.size());
  parallel_for(head.fan.beams(), threads, [&](std::size_t b) {
    const Extended u_beam = std::cos(head.fan.elevation[b]) * std::sin(head.fan.azimuth[b]);
    std::vector<Sum> re(bins.size()), im(bins.size());
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      const Extended delay = echoes.delay[i], weight = response(head.array, wavelength, echoes.u[i], u_beam);
      const std::complex<Extended> amplitude(echoes.amplitude[i].real() * weight, echoes.amplitude[i].imag() * weight);
      for (std::size_t k = 0; k < bins.size(); ++k) {
        const Extended t = 2 * static_cast<Extended>(head.gate.centre(bins[k])) / c - delay;
        const std::complex<Extended> p =
            amplitude * envelope(head.pulse, medium.absorption, c * delay / 2, t);  // (E12)
        re[k].add(p.real());
        im[k].add(p.imag());
      }
    }
    for (std::size_t k = 0; k < bins.size(); ++k)
      pressure(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(k)) = {static_cast<double>(re[k].value),
                                                                              static_cast<double>(im[k].value)};
  });
  return pressure;
}

}  // namespace insonify
