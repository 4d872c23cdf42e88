#pragma once
#include <cstddef>
#include <vector>

namespace insonify {

/// Hydrophones in a row along the port-starboard axis, listening as one.
struct LineArray {
  double spacing = 0;           ///< between neighbouring elements [m]
  std::vector<double> shading;  ///< one real weight per element, symmetric, sum = number of elements

  std::size_t elements() const { return shading.size(); }
};

/// Throws Error unless there is an element, spacing > 0, and the shading is finite and adds up to the number of
/// elements within 1e-9.
void require_valid(const LineArray& array, const char* who);

/// Place of element m along the array in units of the spacing, centred: m - (N-1)/2.
inline double element_place(std::size_t m, std::size_t elements) {
  return static_cast<double>(m) - 0.5 * (static_cast<double>(elements) - 1);
}

/// Response of a beam steered to u_beam to a plane wave from u (E10), amplitude, 1 when u = u_beam:
///   B(u) = (1/N) sum_m w_m exp(2 pi i (d/lambda) (m - (N-1)/2) (u - u_beam)), real for symmetric shading.
/// Direct sum over the elements.
double array_response(const LineArray& array, double wavelength, double u, double u_beam);

/// Distance |u - u_beam| at which the array's intensity response falls to half, found by bisection; `most` if it
/// stays above up to there.
double half_power_offset(const LineArray& array, double wavelength, double most);

/// Full -3 dB width at broadside [rad] of the array's intensity response, found numerically; pi if it has none.
double array_beam_width(const LineArray& array, double wavelength);

/// Directivity index of the beam steered to u_beam [dB] for isotropic noise (E34):
/// 10 log10(2 / integral B^2 du over [-1, 1]).
double directivity_index_db(const LineArray& array, double wavelength, double u_beam = 0);

}  // namespace insonify
