// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "core/error.hpp"
#include "core/require.hpp"

namespace insonify {

void require_synthesis(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                       const SynthesisOptions& options, const char* who) {
  require_valid(head, who);
  require_valid(medium, who);
  require(options.tolerance > 0 && options.tolerance < 1, who, "tolerance", options.tolerance, "", "within 0 and 1");
  if (echoes.u.size() != echoes.size() || echoes.amplitude.size() != echoes.size())
    fail(ErrorKind::argument, who, ": echoes have ", echoes.size(), " delays, ", echoes.u.size(), " directions and ",
         echoes.amplitude.size(), " amplitudes; must be one of each per echo");
  const auto fits = [&](const std::vector<double>& x) { return x.empty() || x.size() == echoes.size(); };
  if (!fits(echoes.v) || !fits(echoes.doppler))
    fail(ErrorKind::argument, who, ": ", echoes.size(), " echoes have ", echoes.v.size(), " values of v and ",
         echoes.doppler.size(), " of doppler; must be none, or one of each per echo");
  require_finite(echoes, who);
  if (echoes.v.empty() && echoes.size() > 0 && !has_line(head))
    fail(ErrorKind::argument, who, ": echoes have no directions upwards (v), must have them for a curved array");
}

void require_finite(const Echoes& echoes, const char* who) {
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const double v = echoes.v.empty() ? 0 : echoes.v[i];
    if (!std::isfinite(v) || !std::isfinite(echoes.doppler_of(i)))
      fail(ErrorKind::argument, who, ": echo ", i, " has v ", v, ", doppler ", echoes.doppler_of(i),
           " Hz; all must be finite");
    const auto& a = echoes.amplitude[i];
    if (!std::isfinite(echoes.delay[i]) || !std::isfinite(echoes.u[i]) || !std::isfinite(a.real()) ||
        !std::isfinite(a.imag()))
      fail(ErrorKind::argument, who, ": echo ", i, " has delay ", echoes.delay[i], " s, u ", echoes.u[i],
           ", amplitude ", a, " Pa; all must be finite");
  }
}

void require_one_row(const SonarHead& head, const char* who, bool of_line) {
  const std::size_t rows = fan_rows(head.fan).size();
  if (head.column || rows > 1)
    fail(ErrorKind::argument, who, ": head '", head.name, "' has ", rows, " rows of beams",
         head.column ? " and a column" : "", ", must be one row of a line array; use synthesize");
  if (of_line && !has_line(head))
    fail(ErrorKind::argument, who, ": head '", head.name, "' must have a line or plane of evenly spaced elements, or ",
         "method direct, element-exact or incoherent");
}

std::vector<double> beam_cosines(const BeamFan& fan) {
  std::vector<double> u(fan.beams());
  for (std::size_t b = 0; b < u.size(); ++b) u[b] = std::cos(fan.elevation[b]) * std::sin(fan.azimuth[b]);
  return u;
}

}  // namespace insonify
