// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstddef>
#include <vector>

namespace insonify {

/// A line of hydrophones along the port-starboard axis.
struct LineArray {
  double spacing = 0;           ///< distance between neighbouring elements [m]
  std::vector<double> shading;  ///< one real weight per element, from starboard to port, sum = number of elements

  /// Returns the number of elements.
  std::size_t elements() const { return shading.size(); }
  bool operator==(const LineArray&) const = default;
};

/// Throws Error unless there is at least one element, spacing is > 0, and the shading is finite and adds up to the
/// number of elements within 1e-9.
void require_valid(const LineArray& array, const char* who);

/// Returns the position of element m along the array in units of the spacing, relative to the centre: m - (N-1)/2.
inline double element_position(std::size_t m, std::size_t elements) {
  return static_cast<double>(m) - 0.5 * (static_cast<double>(elements) - 1);
}

/// Returns the amplitude response of a beam steered to u_beam to a plane wave from u (E10), 1 when u = u_beam:
///   B(u) = (1/N) sum_m w_m exp(-2 pi i (d/lambda) (m - (N-1)/2) (u - u_beam)).
/// computed as a direct sum over the elements. Real to the last bit if the shading is symmetric to the last bit.
std::complex<double> array_response(const LineArray& array, double wavelength, double u, double u_beam);

/// Returns the offset |u - u_beam| at which the intensity response falls to one half, by bisection; `most` if it stays
/// above one half up to there.
double half_power_offset(const LineArray& array, double wavelength, double most);

/// Returns the full -3 dB width of the intensity response at broadside [rad], by bisection; pi if the response stays
/// above.
double array_beam_width(const LineArray& array, double wavelength);

/// Returns the directivity index [dB] of the beam steered to u_beam in isotropic noise (E34): 10 log10(2 / integral B^2
/// du over [-1, 1]).
double directivity_index_db(const LineArray& array, double wavelength, double u_beam = 0);

/// Returns the sums over pairs of elements `lag` apart of w_m w_(m + lag), lag = 0 .. N-1.
std::vector<double> lag_sums(const LineArray& array);
/// Returns the same in both orders, over N^2.
std::vector<double> lag_products(const LineArray& array);

}  // namespace insonify
