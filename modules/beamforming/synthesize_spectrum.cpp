#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <mutex>
#include <numbers>
#include <vector>

#include <fftw3.h>

#include "acoustics/pulse.hpp"
#include "beamforming/require_synthesis_internal.hpp"
#include "beamforming/synthesize.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Complex = std::complex<double>;

/// A forward complex FFT of one length, in place; ESTIMATE plans, so that bits do not depend on timing.
class ForwardFft {
 public:
  explicit ForwardFft(std::size_t n) : plan_(nullptr, &fftw_destroy_plan) {
    static std::mutex planning;  // FFTW's planner is not thread-safe; executing is
    const std::scoped_lock lock(planning);
    std::vector<Complex> room(n);
    auto* raw = reinterpret_cast<fftw_complex*>(room.data());
    plan_.reset(fftw_plan_dft_1d(static_cast<int>(n), raw, raw, FFTW_FORWARD, FFTW_ESTIMATE | FFTW_UNALIGNED));
  }
  void run(std::vector<Complex>& data) const {
    auto* raw = reinterpret_cast<fftw_complex*>(data.data());
    fftw_execute_dft(plan_.get(), raw, raw);
  }

 private:
  std::unique_ptr<std::remove_pointer_t<fftw_plan>, void (*)(fftw_plan)> plan_;
};

/// Frequencies of the sum: M equally spaced ones over `oversampling` times the output's sampling rate, wide enough
/// for the pulse, in a window that holds every echo with its pulse so that nothing wraps round.
struct SpectrumGrid {
  std::size_t oversampling = 1, samples = 0;
  std::size_t skipped = 0;  ///< output bins before the gate's first
  double step_time = 0, start_time = 0;

  SpectrumGrid(const Echoes& echoes, const SonarHead& head, const Medium& medium) {
    const double bin_time = 2 * head.gate.bin_size / medium.sound_speed;
    const double band = 10 * head.pulse.bandwidth;  // at +-5 B the spectrum is down to e^-34, 1e-15 of its peak
    oversampling = static_cast<std::size_t>(std::ceil(band * bin_time));
    step_time = bin_time / static_cast<double>(oversampling);
    const double guard = 2 * pulse_half_length(head.pulse, 1e-16);
    const double first_time = 2 * head.gate.centre(0) / medium.sound_speed;
    double earliest = first_time, latest = 2 * head.gate.max_range / medium.sound_speed;
    for (const double delay : echoes.delay) earliest = std::min(earliest, delay), latest = std::max(latest, delay);
    skipped = static_cast<std::size_t>(std::ceil((first_time - earliest + guard) / bin_time));
    start_time = first_time - static_cast<double>(skipped) * bin_time;
    const double wanted = std::ceil((latest + guard - start_time) / step_time) + 1;
    if (!(wanted <= 0x1p26))
      fail(ErrorKind::argument, "synthesize_spectrum: echoes between ", earliest, " and ", latest, " s and a pulse of ",
           guard, " s need ", wanted, " samples, must be at most 2^26; use another method");
    samples = static_cast<std::size_t>(wanted);
  }

  double frequency(std::size_t k) const {
    const auto n = static_cast<std::ptrdiff_t>(samples);
    const auto signed_k = static_cast<std::ptrdiff_t>(k) < (n + 1) / 2 ? static_cast<std::ptrdiff_t>(k)
                                                                       : static_cast<std::ptrdiff_t>(k) - n;
    return static_cast<double>(signed_k) / (static_cast<double>(samples) * step_time);
  }
};

/// Pulse spectrum in baseband, 1/Hz, integral 1: envelope peak 1 (E8).
double pulse_spectrum(double f, double bandwidth) {
  const double x = f / bandwidth;
  return std::exp(-2 * std::numbers::ln2 * x * x) * std::sqrt(2 * std::numbers::ln2 / pi) / bandwidth;
}

}  // namespace

ComplexGrid synthesize_spectrum(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                const SynthesisOptions& options) {
  require_synthesis(echoes, head, medium, options, "synthesize_spectrum");
  const SpectrumGrid grid(echoes, head, medium);
  const std::vector<double> u_beam = beam_cosines(head.fan);
  const double wavelength = medium.sound_speed / head.pulse.centre_frequency;
  const double df = 1 / (static_cast<double>(grid.samples) * grid.step_time);
  ComplexGrid pressure(u_beam.size(), head.gate.bins());

  const ForwardFft fft(grid.samples);
  parallel_for(u_beam.size(), options.threads, [&](std::size_t b) {
    std::vector<Complex> weight(echoes.size()), spectrum(grid.samples);
    for (std::size_t i = 0; i < echoes.size(); ++i)
      weight[i] = echoes.amplitude[i] * array_response(head.array, wavelength, echoes.u[i], u_beam[b]);

    // Spectrum: S(f) sum_i A_i B(u_i) exp(+2 pi i f (delay - start)) exp(-2 alpha(f) r), per hertz.
    const Absorption& a = medium.absorption;
    for (std::size_t k = 0; k < grid.samples; ++k) {
      const double f = grid.frequency(k), alpha = a.a0 + a.a1 * f + a.a2 * f * f;
      Complex sum = 0;
      for (std::size_t i = 0; i < echoes.size(); ++i) {
        const double r = 0.5 * medium.sound_speed * echoes.delay[i];
        const double phase = 2 * pi * reduced_cycles(f * (echoes.delay[i] - grid.start_time));
        sum += weight[i] * std::polar(std::exp(-2 * alpha * r), phase);
      }
      spectrum[k] = pulse_spectrum(f, head.pulse.bandwidth) * df * sum;
    }
    fft.run(spectrum);  // p(t) = sum_k P(f_k) exp(-2 pi i f_k t)
    for (std::size_t n = 0; n < head.gate.bins(); ++n)
      pressure(b, n) = spectrum[(n + grid.skipped) * grid.oversampling];
  });
  return pressure;
}

}  // namespace insonify
