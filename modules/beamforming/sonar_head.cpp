#include "beamforming/sonar_head.hpp"

#include <cmath>
#include <complex>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t most_elements = 16384;
constexpr std::size_t most_numbers = std::size_t{1} << 28;  // complex ones in one image, or one set of beam weights

void require_memory(std::size_t beams, std::size_t others, const char* what, const char* remedy, const char* who) {
  if (others <= most_numbers / beams) return;
  const double gib = static_cast<double>(beams) * static_cast<double>(others) * sizeof(std::complex<double>) / 0x1p30;
  fail(ErrorKind::argument, who, ": ", beams, " beams x ", others, " ", what, " need ", gib,
       " GiB, must be at most 2^28 numbers (4 GiB); ", remedy);
}

}  // namespace

void require_valid(const SonarHead& head, const char* who) {
  require_valid(head.fan, who);
  require_valid(head.gate, who);
  require_valid(head.array, who);
  require_valid(head.pulse, who);
  require_memory(head.fan.beams(), head.gate.bins(), "bins", "shorten the range gate or ask for fewer beams", who);
  require_memory(head.fan.beams(), head.array.elements(), "elements", "ask for wider or fewer beams", who);
}

LineArray array_for_beam_width(double beam_width, double wavelength, Shading shading, double side_lobe_db) {
  if (!(beam_width > 0))
    fail(ErrorKind::argument, "array_for_beam_width: beam_width = ", degrees(beam_width), " deg, must be > 0");
  const auto with = [&](std::size_t n) { return LineArray{wavelength / 2, shading_weights(shading, n, side_lobe_db)}; };
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
