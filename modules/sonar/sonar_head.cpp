// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/sonar_head.hpp"

#include <cmath>
#include <complex>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"
#include "sonar/receive_array.hpp"

namespace insonify {
namespace {

constexpr std::size_t max_elements = 16384;
constexpr std::size_t max_numbers = std::size_t{1} << 28;  // complex numbers in one image or set of beam weights

void require_memory(std::size_t beams, std::size_t others, const char* what, const char* remedy, const char* who) {
  if (others <= max_numbers / beams) return;
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
  if (!(head.transmit_width >= 0 && std::isfinite(head.transmit_width)))
    fail(ErrorKind::argument, who, ": transmit_width = ", head.transmit_width, " rad, must be >= 0; 0: fills the fan");
  const ArrayKind& kind = array_kinds[static_cast<std::size_t>(head.array_shape)];
  if (kind.has_radius ? !(head.array_radius > 0 && std::isfinite(head.array_radius)) : head.array_radius != 0)
    fail(ErrorKind::argument, who, ": array_radius = ", head.array_radius, " m, must be ",
         kind.has_radius ? "> 0" : "0", " for a ", kind.name, " array");
  kind.make(head)->require_valid(head, who);
}

double directivity_index_db(const SonarHead& head, double wavelength) {
  return receive_array(head)->directivity_index_db(wavelength);
}

double array_gain_db(const SonarHead& head) {
  const double gain = -db_from_power(lag_products(head.array)[0]);
  return head.column ? gain - db_from_power(lag_products(*head.column)[0]) : gain;
}

LineArray array_for_beam_width(double beam_width, double wavelength, Shading shading, double side_lobe_db,
                               const SonarHead& head) {
  if (!(beam_width > 0))
    fail(ErrorKind::argument, "array_for_beam_width: beam_width = ", degrees(beam_width), " deg, must be > 0");
  const auto with = [&](std::size_t n) { return LineArray{wavelength / 2, shading_weights(shading, n, side_lobe_db)}; };
  SonarHead tried = head;
  const auto width = [&](std::size_t n) {
    tried.array = with(n);
    return receive_array(tried)->beam_width(wavelength);
  };
  // The beam narrows with the number of elements: bisect for the first array that is narrow enough, then take the
  // closer of it and its predecessor.
  std::size_t wide = 1, narrow = 2;
  if (width(1) <= beam_width) return with(1);
  while (width(narrow) > beam_width) {
    wide = narrow, narrow *= 2;
    if (narrow > max_elements)
      fail(ErrorKind::argument, "array_for_beam_width: beam_width = ", degrees(beam_width), " deg needs more than ",
           max_elements, " elements", head.array_radius > 0 ? "; use a larger array_radius" : "");
  }
  while (narrow - wide > 1) {
    const std::size_t middle = (wide + narrow) / 2;
    (width(middle) > beam_width ? wide : narrow) = middle;
  }
  const double too_wide = width(wide) - beam_width;
  const double too_narrow = beam_width - width(narrow);
  return with(too_wide < too_narrow ? wide : narrow);
}

double default_bin_size(const Pulse& pulse, double sound_speed) { return 0.44 * sound_speed / (2 * pulse.bandwidth); }

}  // namespace insonify
