#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "beamforming/echo_spectrum_internal.hpp"
#include "beamforming/fftw_planner_internal.hpp"
#include "core/units.hpp"

namespace insonify {

using Complex = std::complex<double>;

namespace {

void destroy_plan(fftw_plan plan) {
  const std::scoped_lock lock(fftw_planner());
  fftw_destroy_plan(plan);
}

}  // namespace

ForwardFft::ForwardFft(std::size_t n) : plan_(nullptr, &destroy_plan) {
  const std::scoped_lock lock(fftw_planner());
  std::vector<Complex> buffer(n);
  auto* raw = reinterpret_cast<fftw_complex*>(buffer.data());
  plan_.reset(fftw_plan_dft_1d(static_cast<int>(n), raw, raw, FFTW_FORWARD, FFTW_ESTIMATE | FFTW_UNALIGNED));
}

void ForwardFft::run(std::vector<Complex>& data) const {
  auto* raw = reinterpret_cast<fftw_complex*>(data.data());
  fftw_execute_dft(plan_.get(), raw, raw);
}

double gaussian_spectrum(double f, double bandwidth) {
  const double x = f / bandwidth;
  return std::exp(-2 * std::numbers::ln2 * x * x) * std::sqrt(2 * std::numbers::ln2 / pi) / bandwidth;
}

EchoSpectrum::EchoSpectrum(const Pulse& pulse, const Medium& medium, const FrequencyGrid& grid)
    : pulse_(pulse), absorption_(medium.absorption), grid_(grid), fft_(grid.samples) {
  if (pulse.shape != PulseShape::linear_fm) return;
  sent_ = sweep_spectrum(false, 0);
  replica_ = sweep_spectrum(true, 0);
  replica_area_ = pulse.duration * replica_weight(pulse, 0.25 * pulse.duration);  // the weight at T/4 equals its mean
}

std::vector<Complex> EchoSpectrum::sweep_spectrum(bool weighted, double doppler) const {
  // Samples of the sweep in reversed time: its time dependence is exp(-i omega t), the opposite sign of the forward
  // FFT.
  std::vector<Complex> x(grid_.samples, 0);
  const double half = 0.5 * pulse_.duration, rate = pulse_.bandwidth / pulse_.duration;
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(half / grid_.step_time));
  for (std::ptrdiff_t n = -reach; n <= reach; ++n) {
    const double t = static_cast<double>(n) * grid_.step_time;
    const double covered = std::clamp((half - std::abs(t)) / grid_.step_time + 0.5, 0.0, 1.0);
    const double weight = weighted ? replica_weight(pulse_, t) : 1;
    x[static_cast<std::size_t>(n > 0 ? static_cast<std::ptrdiff_t>(grid_.samples) - n : -n)] =
        std::polar(covered * weight * grid_.step_time, -pi * rate * t * t - 2 * pi * doppler * t);
  }
  fft_.run(x);
  return x;
}

std::vector<Complex> EchoSpectrum::of(double range, double doppler) const {
  const bool sweep = pulse_.shape == PulseShape::linear_fm;
  std::vector<Complex> x(grid_.samples);
  if (sweep) x = doppler == 0 ? sent_ : sweep_spectrum(false, doppler);
  const double edge = sweep ? 0.5 * pulse_.bandwidth : std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double sent = grid_.at(k) - doppler, f = std::clamp(sent, -edge, edge);
    const double alpha = absorption_.a0 + f * (absorption_.a1 + f * absorption_.a2);
    const double loss = std::exp(-2 * alpha * range);
    x[k] =
        sweep ? loss / replica_area_ * x[k] * std::conj(replica_[k]) : loss * gaussian_spectrum(sent, pulse_.bandwidth);
  }
  return x;
}

}  // namespace insonify
