// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "beamforming/gridded/beam_transform_internal.hpp"

namespace insonify {

template <typename Real>
BeamTransform<Real>::BeamTransform(const GriddingPlan<Real>& plan)
    : plan_(plan),
      to_elements_({plan.grid, plan.tile_bins, plan.grid_row, 1}, FFTW_BACKWARD),
      to_beams_({plan.grid, plan.tile_bins, plan.grid_row, 1}, FFTW_FORWARD) {}

template <typename Real>
void BeamTransform<Real>::wrap_and_transpose(GridPlanes<Real> planes, std::complex<Real>* grid) const {
  // The grid is periodic: columns beyond either end are added at the other end.
  const Real sign = plan_.element_offset != 0 ? Real(-1) : Real(1);
  for (std::size_t n = 0; n < plan_.tile_bins; ++n)
    for (Real* row : {planes.re + n * planes.stride, planes.im + n * planes.stride})
      for (std::size_t j = 0; j < grid_pad; ++j) {
        row[plan_.grid + j] += sign * row[j];
        row[grid_pad + j] += sign * row[grid_pad + plan_.grid + j];
      }
  // Transpose to one row per grid step, so transforms and sums run along time.
  constexpr std::size_t square = 16;
  for (std::size_t n0 = 0; n0 < plan_.tile_bins; n0 += square)
    for (std::size_t j = 0; j < plan_.grid; ++j)
      for (std::size_t n = n0; n < n0 + square; ++n) {
        const std::size_t at = n * planes.stride + grid_pad + j;
        const Real a = planes.re[at], b = planes.im[at], c = plan_.offset_phase[j].real(),
                   d = plan_.offset_phase[j].imag();
        grid[j * plan_.grid_row + n] = std::complex<Real>(a * c - b * d, a * d + b * c);
      }
}

template <typename Real>
double BeamTransform<Real>::run(GridPlanes<Real> planes, std::complex<Real>* grid, std::span<const std::size_t> beams,
                                double unit, std::size_t first, std::size_t last, ComplexGrid& pressure) const {
  wrap_and_transpose(planes, grid);
  to_elements_.run(grid);
  for (std::size_t j = 0; j < plan_.grid; ++j)
    for (std::size_t n = 0; n < plan_.tile_bins; ++n) grid[j * plan_.grid_row + n] *= plan_.element[j].real();
  to_beams_.run(grid);
  for (std::size_t j = 0; j < plan_.grid; ++j) {
    const Real c = plan_.offset_phase[j].real(), d = -plan_.offset_phase[j].imag();
    for (std::size_t n = 0; n < plan_.tile_bins; ++n) {
      std::complex<Real>& x = grid[j * plan_.grid_row + n];
      x = {x.real() * c - x.imag() * d, x.real() * d + x.imag() * c};
    }
  }
  const std::size_t width = plan_.kernel.width();
  const Real* rows = reinterpret_cast<const Real*>(grid);
  double energy = 0;
  for (const std::size_t b : beams) {
    kernels::interpolate(plan_.beam_weight.data() + b * width, plan_.beam_row.data() + b * width, width, rows,
                         2 * plan_.grid_row, 2 * (last - first), reinterpret_cast<double*>(&pressure(b, first)));
    auto bins = pressure.row(static_cast<Eigen::Index>(b)).segment(first, last - first);
    energy += bins.abs2().sum();
    bins *= unit;
  }
  return energy;
}

template class BeamTransform<float>;
template class BeamTransform<double>;

}  // namespace insonify
