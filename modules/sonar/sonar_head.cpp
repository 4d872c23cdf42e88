// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/sonar_head.hpp"

#include <cmath>
#include <complex>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"

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

void require_valid_column(const LineArray& column, const char* who) {
  try {
    require_valid(column, who);
  } catch (const Error& error) {
    fail(error.kind(), error.what(), " (column)");
  }
}

/// Returns the sums over pairs of elements `lag` apart of w_i w_j / N^2, in both orders; lag = 0 .. N-1.
std::vector<double> lag_products(const LineArray& array) {
  const std::size_t n = array.elements();
  std::vector<double> products(n, 0);
  for (std::size_t lag = 0; lag < n; ++lag) {
    for (std::size_t m = 0; m + lag < n; ++m) products[lag] += array.shading[m] * array.shading[m + lag];
    products[lag] *= (lag == 0 ? 1 : 2) / (static_cast<double>(n) * static_cast<double>(n));
  }
  return products;
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
  if (!head.column && head.fan.row_width > 0)
    fail(ErrorKind::argument, who, ": fan.row_width = ", degrees(head.fan.row_width),
         " deg, must be 0 for a head without column");
  if (!head.column) return;
  require_valid_column(*head.column, who);
  if (!(head.fan.row_width > 0))
    fail(ErrorKind::argument, who, ": fan.row_width = 0, must be the width of the column's beam");
  if (head.column->elements() > max_numbers / head.array.elements())
    fail(ErrorKind::argument, who, ": ", head.array.elements(), " columns of ", head.column->elements(),
         " elements, must be at most 2^28 in all; ask for wider beams");
}

double directivity_index_db(const SonarHead& head, double wavelength) {
  if (!head.column) return directivity_index_db(head.array, wavelength);
  require_valid(head.array, "directivity_index_db");
  require_valid_column(*head.column, "directivity_index_db");
  const std::vector<double> across = lag_products(head.array), up = lag_products(*head.column);
  double sum = 0;
  for (std::size_t p = 0; p < across.size(); ++p)
    for (std::size_t q = 0; q < up.size(); ++q) {
      const double distance =
          std::hypot(static_cast<double>(p) * head.array.spacing, static_cast<double>(q) * head.column->spacing);
      const double x = 2 * pi * distance / wavelength;
      sum += across[p] * up[q] * (x > 0 ? std::sin(x) / x : 1);
    }
  return -db_from_power(sum);  // (E56)
}

double array_gain_db(const SonarHead& head) {
  const double gain = -db_from_power(lag_products(head.array)[0]);
  return head.column ? gain - db_from_power(lag_products(*head.column)[0]) : gain;
}

LineArray array_for_beam_width(double beam_width, double wavelength, Shading shading, double side_lobe_db) {
  if (!(beam_width > 0))
    fail(ErrorKind::argument, "array_for_beam_width: beam_width = ", degrees(beam_width), " deg, must be > 0");
  const auto with = [&](std::size_t n) { return LineArray{wavelength / 2, shading_weights(shading, n, side_lobe_db)}; };
  // The beam narrows with the number of elements: bisect for the first array that is narrow enough, then take the
  // closer of it and its predecessor.
  std::size_t wide = 1, narrow = 2;
  if (array_beam_width(with(1), wavelength) <= beam_width) return with(1);
  while (array_beam_width(with(narrow), wavelength) > beam_width) {
    wide = narrow, narrow *= 2;
    if (narrow > max_elements)
      fail(ErrorKind::argument, "array_for_beam_width: beam_width = ", degrees(beam_width), " deg needs more than ",
           max_elements, " elements");
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
