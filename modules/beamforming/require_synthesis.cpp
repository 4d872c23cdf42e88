#include <cmath>

#include "beamforming/require_synthesis_internal.hpp"
#include "core/error.hpp"

namespace insonify {

void require_synthesis(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                       const SynthesisOptions& options, const char* who) {
  require_valid(head, who);
  require_valid(medium, who);
  if (!(options.tolerance > 0 && options.tolerance < 1))
    fail(ErrorKind::argument, who, ": tolerance = ", options.tolerance, ", must be within 0 and 1");
  if (echoes.u.size() != echoes.size() || echoes.amplitude.size() != echoes.size())
    fail(ErrorKind::argument, who, ": echoes have ", echoes.size(), " delays, ", echoes.u.size(), " directions and ",
         echoes.amplitude.size(), " amplitudes; must be one of each per echo");
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const auto& a = echoes.amplitude[i];
    if (!std::isfinite(echoes.delay[i]) || !std::isfinite(echoes.u[i]) || !std::isfinite(a.real()) ||
        !std::isfinite(a.imag()))
      fail(ErrorKind::argument, who, ": echo ", i, " has delay ", echoes.delay[i], " s, u ", echoes.u[i],
           ", amplitude ", a, " Pa; all must be finite");
  }
}

std::vector<double> beam_cosines(const BeamFan& fan) {
  std::vector<double> u(fan.beams());
  for (std::size_t b = 0; b < u.size(); ++b) u[b] = std::cos(fan.elevation[b]) * std::sin(fan.azimuth[b]);
  return u;
}

}  // namespace insonify
