#include <cmath>
#include <numeric>
#include <vector>

#include "beamforming/element_kernels_internal.hpp"
#include "beamforming/element_tile_internal.hpp"
#include "beamforming/require_synthesis_internal.hpp"
#include "core/units.hpp"

namespace insonify {

BeamSums::BeamSums(const SonarHead& head, double wavelength) {
  const std::vector<double> u_beam = beam_cosines(head.fan);
  const std::size_t n = head.array.elements();
  re_.resize(u_beam.size(), n);
  im_.resize(u_beam.size(), n);
  for (std::size_t b = 0; b < u_beam.size(); ++b)
    for (std::size_t m = 0; m < n; ++m) {
      const double phase = -2 * pi * head.array.spacing / wavelength * element_place(m, n) * u_beam[b];
      const double w = head.array.shading[m] / static_cast<double>(n);
      re_(b, m) = w * std::cos(phase);
      im_(b, m) = w * std::sin(phase);
    }
}

void BeamSums::form_beams(const ElementTile& series, std::size_t first, std::size_t last, ComplexGrid& pressure) const {
  std::vector<std::size_t> all(re_.rows());
  std::iota(all.begin(), all.end(), std::size_t{0});
  form_beams(series, first, last, all, pressure);
}

void BeamSums::form_beams(const ElementTile& series, std::size_t first, std::size_t last,
                          std::span<const std::size_t> beams, ComplexGrid& pressure) const {
  // Transpose to one row per element, so the sums run along time.
  const Grid<double> re = series.re.transpose(), im = series.im.transpose();
  double beam_re[tile_bins], beam_im[tile_bins];
  for (const std::size_t b : beams) {
    kernels::sum_elements(re_.row(b).data(), im_.row(b).data(), re_.cols(), re.data(), im.data(), tile_bins,
                          last - first, beam_re, beam_im);
    for (std::size_t n = first; n < last; ++n) pressure(b, n) = {beam_re[n - first], beam_im[n - first]};
  }
}

}  // namespace insonify
