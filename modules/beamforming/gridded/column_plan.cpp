// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <complex>

#include "beamforming/gridded/column_plan_internal.hpp"
#include "beamforming/numerics/fft_internal.hpp"
#include "core/units.hpp"

namespace insonify {

/// The weight of a line at v in a row at v_b is the response of a column with deconvolved shading to v - v_b.
template <typename Real>
ColumnPlan<Real>::ColumnPlan(const SonarHead& head, const Medium& medium, const std::vector<FanRow>& rows,
                             double kernel_tolerance)
    : kernel(kernel_tolerance),
      pieces(kernel.pieces<Real>(0.1 * kernel_tolerance)),
      cycle(fft_length(std::max(2 * head.column->elements(), 2 * kernel.width()))),
      lines(cycle + 2 * grid_pad),
      cycles_per_v(head.column->spacing * head.pulse.centre_frequency / medium.sound_speed),
      element_offset(head.column->elements() % 2 == 0 ? 0.5 : 0.0) {
  const LineArray& column = *head.column;
  const std::size_t n = column.elements();
  const auto steps = static_cast<double>(cycle);
  Aligned<std::complex<double>> response(cycle * rows.size());  // cycle x rows
  for (std::size_t m = 0; m < n; ++m) {
    const double position = element_position(m, n);
    const auto frequency = static_cast<std::ptrdiff_t>(std::floor(position)), wrap = static_cast<std::ptrdiff_t>(cycle);
    const auto at = static_cast<std::size_t>(frequency < 0 ? frequency + wrap : frequency);
    const double factor = column.shading[m] / (static_cast<double>(n) * kernel.transform(position / steps));
    for (std::size_t r = 0; r < rows.size(); ++r)
      response[at * rows.size() + r] =
          std::polar(factor, -2 * pi * position * cycles_per_v * std::sin(rows[r].elevation));
  }
  Fft<double>({cycle, rows.size(), rows.size(), 1}, FFTW_BACKWARD).run(response.data());
  weight.resize(rows.size() * lines);
  for (std::size_t l = 0; l < lines; ++l) {
    const double step = static_cast<double>(l) - static_cast<double>(grid_pad), wraps = std::floor(step / steps);
    const std::complex<double> offset = std::polar(1.0, 2 * pi * element_offset * step / steps);
    const auto at = static_cast<std::size_t>(step - wraps * steps);
    for (std::size_t r = 0; r < rows.size(); ++r)
      weight[r * lines + l] = static_cast<Real>((offset * response[at * rows.size() + r]).real());
  }
}

template struct ColumnPlan<float>;
template struct ColumnPlan<double>;

}  // namespace insonify
