#include "accuracy/synthesize_extended.hpp"

#include <cmath>
#include <numbers>

#include "core/parallel.hpp"

namespace insonify {
namespace {

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
    const Extended place = static_cast<Extended>(m) - (static_cast<Extended>(n) - 1) / 2;
    sum.add(static_cast<Extended>(array.shading[m]) * std::cos(step * place));
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
