#include "beamforming/sonar_head.hpp"

#include <cmath>

#include "beamforming/shading.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {
constexpr std::size_t most_elements = 16384;
}

void require_valid(const SonarHead& head, const char* who) {
  require_valid(head.fan, who);
  require_valid(head.gate, who);
  require_valid(head.array, who);
  require_valid(head.pulse, who);
}

LineArray array_for_beam_width(double beam_width, double wavelength, double side_lobe_db) {
  if (!(beam_width > 0))
    fail(ErrorKind::argument, "array_for_beam_width: beam_width = ", degrees(beam_width), " deg, must be > 0");
  const auto with = [&](std::size_t n) {
    return LineArray{wavelength / 2, side_lobe_db < 0 ? taylor_shading(n, side_lobe_db) : uniform_shading(n)};
  };
  // More elements, narrower beam: bisect for the first array that is narrow enough, then take the nearer neighbour.
  std::size_t wide = 1, narrow = 2;
  if (array_beam_width(with(1), wavelength) <= beam_width) return with(1);
  while (array_beam_width(with(narrow), wavelength) > beam_width) {
    wide = narrow, narrow *= 2;
    if (narrow > most_elements)
      fail(ErrorKind::argument, "array_for_beam_width: beam_width = ", degrees(beam_width), " deg needs more than ",
           most_elements, " elements");
  }
  while (narrow - wide > 1) {
    const std::size_t middle = (wide + narrow) / 2;
    (array_beam_width(with(middle), wavelength) > beam_width ? wide : narrow) = middle;
  }
  const double too_wide = array_beam_width(with(wide), wavelength) - beam_width;
  const double too_narrow = beam_width - array_beam_width(with(narrow), wavelength);
  return with(too_wide < too_narrow ? wide : narrow);
}

double default_bin_size(const Pulse& pulse, double sound_speed) { return 0.44 * sound_speed / (2 * pulse.bandwidth); }

}  // namespace insonify
