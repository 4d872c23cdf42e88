#include "beamforming/shading.hpp"

#include <cmath>
#include <numeric>

#include "beamforming/line_array.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

/// Fourier coefficient m of the Taylor distribution over the aperture (E11; Taylor 1955, eq. for F_m).
double taylor_coefficient(int m, int nbar, double a2, double sigma2) {
  double up = 1, down = 1;
  for (int n = 1; n < nbar; ++n) {
    up *= 1 - m * m / (sigma2 * (a2 + (n - 0.5) * (n - 0.5)));
    if (n != m) down *= 1 - static_cast<double>(m * m) / (n * n);
  }
  return (m % 2 == 1 ? 0.5 : -0.5) * up / down;
}

}  // namespace

std::vector<double> uniform_shading(std::size_t elements) { return std::vector<double>(elements, 1.0); }

std::vector<double> taylor_shading(std::size_t elements, double side_lobe_db, int nbar) {
  if (elements < 1) fail(ErrorKind::argument, "taylor_shading: elements = 0, must be at least 1");
  if (!(side_lobe_db >= -80 && side_lobe_db < -13.3))
    fail(ErrorKind::argument, "taylor_shading: side_lobe_db = ", side_lobe_db, " dB, must be within -80 and -13.3");
  if (nbar < 2) fail(ErrorKind::argument, "taylor_shading: nbar = ", nbar, ", must be at least 2");

  const double a = std::acosh(amplitude_from_db(-side_lobe_db)) / pi;
  const double sigma2 = nbar * nbar / (a * a + (nbar - 0.5) * (nbar - 0.5));
  std::vector<double> weights(elements, 1.0);
  for (std::size_t e = 0; e < elements; ++e) {
    const double x = element_place(e, elements) / static_cast<double>(elements);
    for (int m = 1; m < nbar; ++m)
      weights[e] += 2 * taylor_coefficient(m, nbar, a * a, sigma2) * std::cos(2 * pi * m * x);  // (E11)
  }
  const double scale = static_cast<double>(elements) / std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& w : weights) w *= scale;
  return weights;
}

}  // namespace insonify
