#include "acoustics/direct_echoes.hpp"

#include <cmath>

#include "acoustics/collect_echoes_internal.hpp"
#include "acoustics/scattering.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t block = 4096;

/// What every echo of one ping has in common.
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

  /// Sets echo i: of a target with cross-section `sigma` [m^2] and amplitude `xi`.
  void build(const Scatterers& s, std::size_t i, double sigma, std::complex<double> xi, Echoes& echoes) const {
    const double r = s.range[i];
    if (!(r > 0) || !std::isfinite(r))
      fail(ErrorKind::argument, "direct_echoes: range[", i, "] = ", r, " m, must be > 0");
    const double pattern = elevation_pattern(options, s.elevation[i]) * transmit_pattern(options, s.azimuth[i]);
    const double phase = 2 * pi * reduced_cycles(cycles_per_m * r);
    echoes.delay[i] = 2 * r / sound_speed;
    echoes.u[i] = std::cos(s.elevation[i]) * std::sin(s.azimuth[i]);
    echoes.v[i] = std::sin(s.elevation[i]);
    echoes.amplitude[i] = xi * std::polar(source * std::sqrt(sigma) * pattern / (r * r), phase);  // (E7)
  }
};

Echoes room_for(std::size_t n) {
  Echoes echoes;
  echoes.delay.resize(n);
  echoes.u.resize(n);
  echoes.v.resize(n);
  echoes.amplitude.resize(n);
  return echoes;
}

}  // namespace

std::complex<double> surface_amplitude(const EchoOptions& options, double coherent_fraction, std::uint64_t id) {
  const bool mean_power = options.amplitude == SurfaceAmplitude::mean_power;
  if (options.amplitude == SurfaceAmplitude::coherent || mean_power) return 1;
  auto xi = random_complex_normal(options.seed, RandomStage::surface_amplitude, {id, 0, 0});  // (E9)
  if (options.amplitude == SurfaceAmplitude::random_phase) xi /= std::abs(xi);
  if (coherent_fraction == 0) return xi;
  return std::sqrt(coherent_fraction) + std::sqrt(1 - coherent_fraction) * xi;  // (E53)
}

double elevation_pattern(const EchoOptions& options, double elevation) {
  if (!(options.elevation_width > 0)) return 1;
  return elevation_response(options.elevation_shape, options.elevation_width, elevation - options.elevation_centre);
}

double transmit_pattern(const EchoOptions& options, double azimuth) {
  if (!(options.transmit_width > 0)) return 1;
  return gaussian_lobe(options.transmit_width, std::remainder(azimuth, 2 * pi));  // (E57)
}

Echoes direct_echoes(const Scatterers& scatterers, std::span<const Material> materials, const Pulse& pulse,
                     const Medium& medium, const EchoOptions& options) {
  require_valid(pulse, "direct_echoes");
  require_valid(medium, "direct_echoes");
  for (const Material& material : materials) require_valid(material, "direct_echoes");
  Echoes echoes = room_for(scatterers.size());
  const EchoBuilder builder(pulse, medium, options);
  parallel_blocks(scatterers.size(), block, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t m = scatterers.material[i];
      if (m >= materials.size())
        fail(ErrorKind::argument, "direct_echoes: material[", i, "] = ", m, ", but there are ", materials.size());
      const double cosine = scatterers.cos_incidence[i];
      const double sigma =
          cross_section(materials[m], {cosine, cosine, scatterers.projected_area[i]}, pulse.centre_frequency);
      builder.build(scatterers, i, sigma, surface_amplitude(options, materials[m].coherent_fraction, scatterers.id[i]),
                    echoes);
    }
  });
  return echoes;
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
  Echoes echoes = room_for(n);
  const EchoBuilder builder(pulse, medium, options);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(sigma[i] >= 0 && std::isfinite(sigma[i])))
      fail(ErrorKind::argument, "target_echoes: sigma[", i, "] = ", sigma[i], " m^2, must be finite and >= 0");
    builder.build(scatterers, i, sigma[i], xi[i], echoes);
  }
  return echoes;
}

}  // namespace insonify
