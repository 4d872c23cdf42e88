#include "acoustics/hear_scatterers.hpp"

#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t block = 4096;

std::complex<double> surface_amplitude(SurfaceAmplitude law, std::uint64_t seed, std::uint64_t id) {
  if (law == SurfaceAmplitude::coherent) return 1;
  const auto xi = random_complex_normal(seed, RandomStage::surface_amplitude, {id, 0, 0});  // (E9)
  return law == SurfaceAmplitude::random_phase ? xi / std::abs(xi) : xi;
}

/// What every echo of one ping has in common.
struct Hearing {
  double source;        ///< sqrt2 p0 [Pa]
  double cycles_per_m;  ///< two-way carrier cycles per metre of range
  double sound_speed;
  const HearingOptions& options;

  Hearing(const Pulse& pulse, const Medium& medium, const HearingOptions& options_in)
      : source(source_pressure(pulse)),
        cycles_per_m(2 * pulse.centre_frequency / medium.sound_speed),
        sound_speed(medium.sound_speed),
        options(options_in) {}

  /// Echo i of a target with cross-section `sigma` and amplitude `xi`.
  void hear(const Scatterers& s, std::size_t i, double sigma, std::complex<double> xi, Echoes& echoes) const {
    const double r = s.range[i];
    if (!(r > 0) || !std::isfinite(r))
      fail(ErrorKind::argument, "hear_scatterers: range[", i, "] = ", r, " m, must be > 0");
    const double pattern = options.elevation_width > 0
                               ? elevation_response(options.elevation_shape, options.elevation_width,
                                                    s.elevation[i] - options.elevation_centre)
                               : 1;
    const double phase = 2 * pi * reduced_cycles(cycles_per_m * r);
    echoes.delay[i] = 2 * r / sound_speed;
    echoes.u[i] = std::cos(s.elevation[i]) * std::sin(s.azimuth[i]);
    echoes.amplitude[i] = xi * std::polar(source * std::sqrt(sigma) * pattern / (r * r), phase);  // (E7)
  }
};

Echoes room_for(std::size_t n) {
  Echoes echoes;
  echoes.delay.resize(n);
  echoes.u.resize(n);
  echoes.amplitude.resize(n);
  return echoes;
}

}  // namespace

double lambert_cross_section(double lambert_mu, double cos_incidence, double projected_area) {
  return lambert_mu * cos_incidence * projected_area;  // (E4)
}

Echoes hear_scatterers(const Scatterers& scatterers, std::span<const Material> materials, const Pulse& pulse,
                       const Medium& medium, const HearingOptions& options) {
  require_valid(pulse, "hear_scatterers");
  require_valid(medium, "hear_scatterers");
  for (const Material& material : materials)
    if (!(material.lambert_mu >= 0 && std::isfinite(material.lambert_mu)))
      fail(ErrorKind::argument, "hear_scatterers: lambert_mu of material '", material.name, "' = ", material.lambert_mu,
           " 1/sr, must be finite and >= 0");
  Echoes echoes = room_for(scatterers.size());
  const Hearing hearing(pulse, medium, options);
  parallel_blocks(scatterers.size(), block, options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t m = scatterers.material[i];
      if (m >= materials.size())
        fail(ErrorKind::argument, "hear_scatterers: material[", i, "] = ", m, ", but there are ", materials.size());
      const double sigma =
          lambert_cross_section(materials[m].lambert_mu, scatterers.cos_incidence[i], scatterers.projected_area[i]);
      hearing.hear(scatterers, i, sigma, surface_amplitude(options.amplitude, options.seed, scatterers.id[i]), echoes);
    }
  });
  return echoes;
}

Echoes hear_targets(const Scatterers& scatterers, std::span<const double> sigma,
                    std::span<const std::complex<double>> xi, const Pulse& pulse, const Medium& medium,
                    const HearingOptions& options) {
  require_valid(pulse, "hear_targets");
  require_valid(medium, "hear_targets");
  const std::size_t n = scatterers.size();
  if (sigma.size() != n || xi.size() != n)
    fail(ErrorKind::argument, "hear_targets: ", n, " ranges, but ", sigma.size(), " cross-sections and ", xi.size(),
         " amplitudes");
  Echoes echoes = room_for(n);
  const Hearing hearing(pulse, medium, options);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(sigma[i] >= 0 && std::isfinite(sigma[i])))
      fail(ErrorKind::argument, "hear_targets: sigma[", i, "] = ", sigma[i], " m^2, must be finite and >= 0");
    hearing.hear(scatterers, i, sigma[i], xi[i], echoes);
  }
  return echoes;
}

}  // namespace insonify
