#include <algorithm>
#include <array>
#include <cmath>

#include "beamforming/wideband_block_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t batch = 256;  // places handed to the kernel at once

/// Range from the array's centre, in direction `u`, of what a part at `y` receives after a path of `path` in all [m].
double range_of(double path, double y, double u) { return 0.5 * (path * path - y * y) / (path - y * u); }

}  // namespace

ArrayParts::ArrayParts(const LineArray& array, std::size_t count) {
  const std::size_t n = array.elements();
  for (std::size_t p = 0; p < count; ++p) {
    const std::size_t from = p * n / count, to = (p + 1) * n / count;
    first.push_back(from);
    centre.push_back(0.5 * array.spacing * (element_place(from, n) + element_place(to - 1, n)));
    aperture = std::max(aperture, array.spacing * static_cast<double>(to - 1 - from));
  }
  first.push_back(n);
}

SeenEchoes seen_by(const Echoes& echoes, const WidebandPlan& plan, std::size_t part) {
  const double c = plan.medium.sound_speed, y = plan.parts.centre[part];
  SeenEchoes seen{echoes, echoes.delay, {}};
  seen.curvature.resize(echoes.size());
  std::array<double, batch> range, extra, there, cosine, sine;
  for (std::size_t first = 0; first < echoes.size(); first += batch) {
    const std::size_t count = std::min(batch, echoes.size() - first);
    for (std::size_t k = 0; k < count; ++k)
      range[k] = 0.5 * c * std::max(echoes.delay[first + k], 1e-3 * plan.axis.step);
    kernels::see_from(y, plan.head.pulse.centre_frequency / c, count, range.data(), echoes.u.data() + first,
                      extra.data(), there.data(), seen.echoes.u.data() + first, cosine.data(), sine.data());
    for (std::size_t k = 0; k < count; ++k) {
      seen.curvature[first + k] = 1 / there[k];
      seen.echoes.delay[first + k] += extra[k] / c;
      seen.echoes.amplitude[first + k] *= std::complex<double>(cosine[k], sine[k]);
    }
  }
  return seen;
}

void WidebandRoom::to_samples(WidebandSpectrum& spectrum, WidebandSpectrum& samples) {
  const WidebandPlan& plan = plan_;
  const std::size_t top = plan.top_line();
  for (std::size_t r = 0; r < plan.rows(); ++r) {
    Complex* line = spectrum.data() + r * plan.fine_row;
    if (2 * top + 1 < plan.fine) std::fill(line + top + 1, line + plan.fine - top, Complex(0));
    transforms_.to_samples.run(line);
  }
  for (std::size_t n0 = 0; n0 < plan.fine; n0 += wideband_tile) {
    const std::size_t count = std::min(wideband_tile, plan.fine - n0);
    std::fill_n(tile_.data() + (plan.most + 1) * wideband_tile_row, (plan.grid - plan.rows()) * wideband_tile_row,
                Complex(0));
    for (std::size_t r = 0; r < plan.rows(); ++r)
      std::copy_n(spectrum.data() + r * plan.fine_row + n0, count,
                  tile_.data() + (r + plan.grid - plan.most) % plan.grid * wideband_tile_row);
    transforms_.to_directions.run(tile_.data());
    for (std::size_t g = 0; g < plan.grid; ++g)
      std::copy_n(tile_.data() + g * wideband_tile_row, count, samples.data() + g * plan.fine_row + n0);
  }
}

void WidebandRoom::add_part(const WidebandBlock& block, ComplexGrid& pressure) {
  const WidebandPlan& plan = plan_;
  const bool two = block.effort.fields == 2;
  const double c = plan.medium.sound_speed, y = plan.parts.centre[block.part], start = plan.start_of(block.number);
  const double waves = plan.head.pulse.centre_frequency / c,
               half_width = 0.5 * static_cast<double>(plan.kernel.width());
  to_samples(spectrum_, *samples_);
  if (two) to_samples(*excess_spectrum_, *excess_samples_);
  const float *field = reinterpret_cast<const float*>(samples_->data()),
              *second = two ? reinterpret_cast<const float*>(excess_samples_->data()) : nullptr;

  // Bins of a beam that the part hears within the cycle.
  const auto bin_at = [&](double fine_sample, double u) {
    const double path = std::max(c * (start + fine_sample * plan.fine_step), 1.001 * std::abs(y));
    return (2 * range_of(path, y, u) / c - plan.beam_axis.start) / plan.beam_axis.step;
  };
  const std::vector<double> u_beam = beam_cosines(plan.head.fan);
  std::array<double, batch> range, u, extra, there, u_there, cosine, sine, row, column;
  std::array<float, batch> excess, re, im;
  for (std::size_t b = 0; b < u_beam.size(); ++b) {
    const auto bins = static_cast<double>(plan.beam_axis.bins);
    const double from = std::ceil(bin_at(half_width, u_beam[b])),
                 to = std::floor(bin_at(static_cast<double>(plan.fine) - half_width - 1, u_beam[b]));
    const auto first = static_cast<std::size_t>(std::clamp(from, 0.0, bins)),
               last = static_cast<std::size_t>(std::clamp(to + 1, 0.0, bins));
    for (std::size_t n0 = first; n0 < last; n0 += batch) {
      const std::size_t count = std::min(batch, last - n0);
      for (std::size_t k = 0; k < count; ++k) {
        range[k] = 0.5 * c * (plan.beam_axis.start + static_cast<double>(n0 + k) * plan.beam_axis.step);
        u[k] = u_beam[b];
      }
      kernels::see_from(y, waves, count, range.data(), u.data(), extra.data(), there.data(), u_there.data(),
                        cosine.data(), sine.data());
      for (std::size_t k = 0; k < count; ++k) {
        column[k] = ((2 * range[k] + extra[k]) / c - start) / plan.fine_step;
        row[k] = plan.column_of(u_there[k], plan.moving_curvature(block.curvature, 1 / there[k]));
        excess[k] = static_cast<float>(std::min(1.0, 1 / (there[k] * block.curvature) - 1));
      }
      kernels::interpolate_points({row.data(), column.data(), excess.data()}, count, plan.columns.coefficient.data(),
                                  plan.columns.degree, field, second, plan.fine_row, re.data(), im.data());
      for (std::size_t k = 0; k < count; ++k)
        pressure(b, n0 + k) +=
            block.unit * std::complex<double>(re[k], im[k]) * std::complex<double>(cosine[k], -sine[k]);
    }
  }
}

}  // namespace insonify
