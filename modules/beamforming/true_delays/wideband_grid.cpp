#include <algorithm>
#include <array>
#include <cmath>

#include "beamforming/narrow_band/gridding_loops_internal.hpp"
#include "beamforming/pulses/pulse_loops_internal.hpp"
#include "beamforming/true_delays/wideband_block_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t wideband_batch = 256;  // echoes handed to the kernel at once

kernels::Pieces<float> wideband_pieces(const PolynomialPieces<float>& p) {
  return {p.coefficient.data(), p.degree, p.lanes};
}

}  // namespace

void WidebandRoom::begin(const WidebandBlock& block) {
  start_time_ = plan_.time_of(block.first - static_cast<double>(plan_.guard));
  unit_ = 0;
  std::fill(touched_.begin(), touched_.end(), false);
}

void WidebandRoom::add(const Echoes& echoes, List list) {
  if (unit_ == 0) {
    const double loss = plan_.medium.absorption.a0 * plan_.medium.sound_speed * std::max(0.0, start_time_);
    double most = 0;
    for (const std::uint32_t i : list) most = std::max(most, std::norm(echoes.amplitude[i]));
    most = std::sqrt(most) * std::exp(-loss);
    if (most == 0) return;
    unit_ = std::exp2(std::round(std::log2(most)));
  }
  const bool gaussian = plan_.head.pulse.shape == PulseShape::gaussian;
  const std::size_t at_once = gaussian ? wideband_batch : list.size();
  for (; !list.empty(); list = list.subspan(std::min(at_once, list.size()))) {
    const List some = list.first(std::min(at_once, list.size()));
    if (!gaussian)
      grid_sweeps(echoes, some);
    else if (plan_.one_shape && echoes.doppler.empty())
      grid_alike(echoes, some);
    else
      grid_gaussians(echoes, some);
  }
}

void WidebandRoom::grid_alike(const Echoes& echoes, List list) {
  const WidebandPlan& plan = plan_;
  std::array<std::uint32_t, wideband_batch> row, column;
  std::array<float, wideband_batch> row_offset, column_offset, re, im;
  const kernels::GridTargets<float> targets{row.data(),           column.data(), row_offset.data(),
                                            column_offset.data(), re.data(),     im.data()};
  const double half_width = 0.5 * static_cast<double>(plan.kernel.width()), c = plan.medium.sound_speed;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::uint32_t i = list[k];
    const double delay = echoes.delay[i];
    const double low_column = plan.column_of(echoes.u[i]) - half_width, column_0 = std::ceil(low_column);
    const double low_row = (delay - plan.half - start_time_) / plan.fine_step, row_0 = std::ceil(low_row);
    const double gain = std::exp(-plan.medium.absorption.a0 * c * delay) / unit_;
    column[k] = static_cast<std::uint32_t>(column_0);
    column_offset[k] = static_cast<float>(2 * (column_0 - low_column) - 1);
    row[k] = static_cast<std::uint32_t>(row_0);
    row_offset[k] = static_cast<float>(2 * (row_0 - low_row) - 1);
    re[k] = static_cast<float>(gain * echoes.amplitude[i].real());
    im[k] = static_cast<float>(gain * echoes.amplitude[i].imag());
    touch(row[k], plan.pulse_samples);
  }
  kernels::grid_pulses(targets, list.size(), wideband_pieces(plan.pulse), plan.pulse_samples,
                       wideband_pieces(plan.columns), scratch_.data(), re_.data(), im_.data(), plan.grid_stride);
}

void WidebandRoom::grid_gaussians(const Echoes& echoes, List list) {
  const WidebandPlan& plan = plan_;
  // Amplitudes and places, gathered; directions are counted from the beginning of the period.
  std::array<double, 12 * wideband_batch> numbers;
  const auto array = [&](std::size_t k) { return numbers.data() + k * wideband_batch; };
  double *delay = array(0), *u = array(1), *re = array(2), *im = array(3), *doppler = array(4);
  double latest = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::uint32_t i = list[k];
    delay[k] = echoes.delay[i];
    u[k] = echoes.u[i] + 0.5 * plan.period;
    re[k] = echoes.amplitude[i].real() / unit_;
    im[k] = echoes.amplitude[i].imag() / unit_;
    doppler[k] = echoes.doppler_of(i);
    latest = std::max(latest, delay[k]);
  }
  plan.shapes.of(latest);  // throws if absorption lets a pulse grow
  const Absorption& absorption = plan.medium.absorption;
  const kernels::GaussianGrid grid{start_time_,
                                   plan.fine_step,
                                   plan.reach,
                                   0,
                                   1 / plan.period,
                                   static_cast<double>(plan.grid),
                                   0.5 * static_cast<double>(plan.kernel.width()),
                                   0,
                                   false,
                                   plan.spectral_width2,
                                   0.5 * plan.medium.sound_speed,
                                   absorption.a0,
                                   absorption.a1,
                                   absorption.a2};
  std::array<std::uint32_t, wideband_batch> row, column;
  std::array<float, wideband_batch> column_offset;
  const kernels::GaussianPlaces<float> places{row.data(), column.data(), column_offset.data()};
  const kernels::GaussianState state{array(5), array(6), array(7), array(8), array(9), array(10), array(11)};
  kernels::place_gaussians({delay, u, re, im, doppler}, list.size(), grid, state, places);
  const auto rows = static_cast<std::size_t>(std::floor(2 * plan.reach / plan.fine_step)) + 1;
  for (std::size_t k = 0; k < list.size(); ++k) touch(row[k], rows);
  samples_.resize(2 * wideband_batch * rows);
  float *sample_re = samples_.data(), *sample_im = sample_re + wideband_batch * rows;
  kernels::sample_gaussians(state, list.size(), rows, sample_re, sample_im);
  kernels::grid_samples(places, list.size(), sample_re, sample_im, rows, wideband_pieces(plan.columns), re_.data(),
                        im_.data(), plan.grid_stride);
}

void WidebandRoom::touch(std::size_t row, std::size_t rows) {
  for (std::size_t tile = row / wideband_tile; tile <= (row + rows) / wideband_tile; ++tile) touched_[tile] = true;
}

void WidebandRoom::grid_sweeps(const Echoes& echoes, List list) {
  const WidebandPlan& plan = plan_;
  const double half_width = 0.5 * static_cast<double>(plan.kernel.width()), c = plan.medium.sound_speed;
  const PulseReach reach(plan.head.pulse, plan.medium.absorption, c, !echoes.doppler.empty(), plan.cut);
  for (const std::uint32_t i : list) {
    const double delay = echoes.delay[i];
    const double low_column = plan.column_of(echoes.u[i]) - half_width, column_0 = std::ceil(low_column);
    const double half = reach.at(delay);
    const EchoEnvelope envelope = plan.shapes.of(delay, echoes.doppler_of(i));
    const double first = std::max(0.0, std::ceil((delay - half - start_time_) / plan.fine_step));
    const double last =
        std::min(std::floor((delay + half - start_time_) / plan.fine_step), static_cast<double>(plan.fine) - 1);
    pulse_re_.clear();
    pulse_im_.clear();
    for (double n = first; n <= last; ++n) {
      const std::complex<double> g =
          1 / unit_ * echoes.amplitude[i] * envelope.at(start_time_ + n * plan.fine_step - delay);
      pulse_re_.push_back(g.real());
      pulse_im_.push_back(g.imag());
      touched_[static_cast<std::size_t>(n) / wideband_tile] = true;
    }
    const std::size_t at = static_cast<std::size_t>(first) * plan.grid_stride + static_cast<std::size_t>(column_0);
    kernels::grid_sampled_pulse(pulse_re_.data(), pulse_im_.data(), pulse_re_.size(),
                                static_cast<float>(2 * (column_0 - low_column) - 1), wideband_pieces(plan.columns),
                                re_.data() + at, im_.data() + at, plan.grid_stride);
  }
}

}  // namespace insonify
