// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/direct_echoes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "acoustics/collect_echoes_internal.hpp"
#include "acoustics/echo_loops_internal.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t block = 1024;  // echoes, whose numbers stay in the cache

/// Numbers that all echoes of one ping share.
struct EchoBuilder {
  double source;        ///< sqrt2 p0 [Pa]
  double cycles_per_m;  ///< two-way carrier cycles per metre of range
  double sound_speed;   ///< [m/s]
  const EchoOptions& options;

  EchoBuilder(const Pulse& pulse, const Medium& medium, const EchoOptions& options_in)
      : source(source_pressure(pulse)),
        cycles_per_m(2 * pulse.centre_frequency / medium.sound_speed),
        sound_speed(medium.sound_speed),
        options(options_in) {}

  /// Sets echoes [begin, end) of targets with cross-sections `sigma` [m^2] and amplitudes xi, arrays of this block.
  void build(const Scatterers& s, std::size_t begin, std::size_t end, const double* sigma, const double* xi_re,
             const double* xi_im, Echoes& echoes) const {
    std::array<double, block> gain;
    for (std::size_t i = begin; i < end; ++i) {
      const double r = s.range[i];
      if (!(r > 0) || !std::isfinite(r))
        fail(ErrorKind::argument, "direct_echoes: range[", i, "] = ", r, " m, must be > 0");
      gain[i - begin] = source * std::sqrt(sigma[i - begin]);  // (E7)
    }
    apply_patterns(s, begin, end - begin, gain.data());
    kernels::direct_echoes(
        {s.range.data() + begin, s.azimuth.data() + begin, s.elevation.data() + begin, gain.data(), xi_re, xi_im},
        end - begin, cycles_per_m, sound_speed,
        {echoes.delay.data() + begin, echoes.u.data() + begin, echoes.v.data() + begin,
         reinterpret_cast<double*>(echoes.amplitude.data() + begin)});
  }

 private:
  void apply_patterns(const Scatterers& s, std::size_t begin, std::size_t count, double* gain) const {
    if (options.elevation_width > 0 && options.elevation_shape == ElevationShape::gaussian)
      kernels::apply_lobe(s.elevation.data() + begin, count, options.elevation_centre, options.elevation_width, gain);
    else
      for (std::size_t k = 0; k < count; ++k) gain[k] *= elevation_pattern(options, s.elevation[begin + k]);
    if (options.transmit_width > 0)
      kernels::apply_lobe(s.azimuth.data() + begin, count, 0, options.transmit_width, gain);
  }
};

// In parallel, since new memory costs as much as writing to it; a stop request ends the loop between two arrays.
Echoes room_for(std::size_t n, int threads) {
  Echoes echoes;
  parallel_for(4, threads, [&](std::size_t array) {
    if (array == 0)
      echoes.amplitude.resize(n);
    else
      std::array{&echoes.delay, &echoes.u, &echoes.v}[array - 1]->resize(n);
  });
  return echoes;
}

/// Returns true if amplitudes are drawn; if not, all are 1.
bool draws(const EchoOptions& options) {
  return options.amplitude != SurfaceAmplitude::coherent && options.amplitude != SurfaceAmplitude::mean_power;
}

/// Amplitude of a surface of which `xi` is the complex normal number.
std::complex<double> amplitude_of(const EchoOptions& options, double coherent_fraction, std::complex<double> xi) {
  if (options.amplitude == SurfaceAmplitude::random_phase) xi /= std::abs(xi);
  if (coherent_fraction == 0) return xi;
  return std::sqrt(coherent_fraction) + std::sqrt(1 - coherent_fraction) * xi;  // (E53)
}

/// Amplitudes of scatterers [begin, end), each as surface_amplitude.
void surface_amplitudes(const EchoOptions& options, std::span<const Material> materials, const Scatterers& s,
                        std::size_t begin, std::size_t end, double* re, double* im) {
  std::fill_n(re, end - begin, 1.0);
  std::fill_n(im, end - begin, 0.0);
  if (!draws(options)) return;
  random_amplitudes(options.seed, {s.id.data() + begin, end - begin}, re, im);
  const bool plain = std::all_of(materials.begin(), materials.end(), [](auto& m) { return m.coherent_fraction == 0; });
  if (plain && options.amplitude != SurfaceAmplitude::random_phase) return;
  for (std::size_t k = 0; k < end - begin; ++k) {
    const double coherent_fraction = materials[s.material[begin + k]].coherent_fraction;
    const std::complex<double> xi = amplitude_of(options, coherent_fraction, {re[k], im[k]});
    re[k] = xi.real(), im[k] = xi.imag();
  }
}

}  // namespace

std::complex<double> surface_amplitude(const EchoOptions& options, double coherent_fraction, std::uint64_t id) {
  if (!draws(options)) return 1;
  return amplitude_of(options, coherent_fraction,
                      random_complex_normal(options.seed, RandomStage::surface_amplitude, {id, 0, 0}));  // (E9)
}

void random_amplitudes(std::uint64_t seed, std::span<const std::uint64_t> id, double* re, double* im) {
  std::array<double, block> u, turn;
  for (std::size_t begin = 0; begin < id.size(); begin += block) {
    const std::size_t count = std::min(block, id.size() - begin);
    random_uniform_pairs(seed, RandomStage::surface_amplitude, id.data() + begin, count, u.data(), turn.data());
    complex_normals(u.data(), turn.data(), count, re + begin, im + begin);
  }
}

double elevation_pattern(const EchoOptions& options, double elevation) {
  if (!(options.elevation_width > 0)) return 1;
  return elevation_response(options.elevation_shape, options.elevation_width, elevation - options.elevation_centre);
}

double transmit_pattern(const EchoOptions& options, double azimuth) {
  if (!(options.transmit_width > 0)) return 1;
  return gaussian_lobe(options.transmit_width, std::remainder(azimuth, 2 * pi));  // (E57)
}

SurfaceTable surfaces_of(const Transmission& sent, std::span<const Material> materials) {
  if (sent.surfaces.empty()) return surface_table(materials, sent.pulse.centre_frequency, sent.medium.sound_speed);
  if (sent.surfaces.size() != materials.size())
    fail(ErrorKind::argument, "surfaces_of: sent.surfaces has ", sent.surfaces.size(), " laws, but there are ",
         materials.size(), " materials");
  return sent.surfaces;
}

Echoes direct_echoes(const Scatterers& scatterers, std::span<const Material> materials, const Transmission& sent) {
  require_valid(sent.pulse, "direct_echoes");
  require_valid(sent.medium, "direct_echoes");
  for (const Material& material : materials) require_valid(material, "direct_echoes");
  const SurfaceTable surfaces = surfaces_of(sent, materials);
  Echoes echoes = room_for(scatterers.size(), sent.echo_options.threads);
  const EchoBuilder builder(sent.pulse, sent.medium, sent.echo_options);
  parallel_blocks(scatterers.size(), block, sent.echo_options.threads, [&](std::size_t begin, std::size_t end) {
    std::array<double, block> sigma, xi_re, xi_im;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t m = scatterers.material[i];
      if (m >= surfaces.size())
        fail(ErrorKind::argument, "direct_echoes: material[", i, "] = ", m, ", but there are ", surfaces.size());
      const double cosine = scatterers.cos_incidence[i];
      sigma[i - begin] = cosine > 0 ? surfaces[m]->back(cosine) * scatterers.projected_area[i] : 0;
    }
    surface_amplitudes(sent.echo_options, materials, scatterers, begin, end, xi_re.data(), xi_im.data());
    builder.build(scatterers, begin, end, sigma.data(), xi_re.data(), xi_im.data(), echoes);
  });
  return echoes;
}

Echoes direct_echoes(const Scatterers& scatterers, std::span<const Material> materials, const Pulse& pulse,
                     const Medium& medium, const EchoOptions& options) {
  return direct_echoes(scatterers, materials, {pulse, medium, options});
}

Echoes target_echoes(const Scatterers& scatterers, std::span<const double> sigma,
                     std::span<const std::complex<double>> xi, const Pulse& pulse, const Medium& medium,
                     const EchoOptions& options) {
  require_valid(pulse, "target_echoes");
  require_valid(medium, "target_echoes");
  const std::size_t n = scatterers.size();
  if (sigma.size() != n || xi.size() != n)
    fail(ErrorKind::argument, "target_echoes: ", n, " ranges, but ", sigma.size(), " cross-sections and ", xi.size(),
         " amplitudes");
  Echoes echoes = room_for(n, options.threads);
  const EchoBuilder builder(pulse, medium, options);
  for (std::size_t i = 0; i < n; ++i)
    if (!(sigma[i] >= 0 && std::isfinite(sigma[i])))
      fail(ErrorKind::argument, "target_echoes: sigma[", i, "] = ", sigma[i], " m^2, must be finite and >= 0");
  parallel_blocks(n, block, options.threads, [&](std::size_t begin, std::size_t end) {
    std::array<double, block> re, im;
    for (std::size_t i = begin; i < end; ++i) re[i - begin] = xi[i].real(), im[i - begin] = xi[i].imag();
    builder.build(scatterers, begin, end, sigma.data() + begin, re.data(), im.data(), echoes);
  });
  return echoes;
}

}  // namespace insonify
