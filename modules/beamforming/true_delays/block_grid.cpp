// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "beamforming/gridded/gridding_loops_internal.hpp"
#include "beamforming/pulses/pulse_loops_internal.hpp"
#include "beamforming/true_delays/time_block_internal.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
void BlockWorkspace::begin(const TimeBlock& block) {
  start_time_ = plan_.axis.time_of(block.first - static_cast<double>(plan_.guard));
  unit_ = 0;
  std::fill(touched_.begin(), touched_.end(), false);
}

void BlockWorkspace::add(const Echoes& echoes, List list) {
  if (unit_ == 0) {
    const double loss = plan_.medium.absorption.a0 * plan_.medium.sound_speed * std::max(0.0, start_time_);
    double most = 0;
    for (const std::uint32_t i : list) most = std::max(most, std::norm(echoes.amplitude[i]));
    most = std::sqrt(most) * std::exp(-loss);
    if (most == 0) return;
    unit_ = std::exp2(std::round(std::log2(most)));
  }
  if (!is_gaussian(plan_.head.pulse)) return grid_sweeps(echoes, list);
  for (; !list.empty(); list = list.subspan(std::min(GaussianBatch<float>::most, list.size())))
    grid_gaussians(echoes, list.first(std::min(GaussianBatch<float>::most, list.size())));
}

void BlockWorkspace::grid_gaussians(const Echoes& echoes, List list) {
  const TrueDelayPlan& plan = plan_;
  const kernels::GaussianGrid grid{.start = start_time_,
                                   .step = plan.fine_step,
                                   .half = plan.reach,
                                   .first_row = 0,
                                   .first_u = -0.5 * plan.period,
                                   .cycles_per_u = 1 / plan.period,
                                   .grid = static_cast<double>(plan.grid),
                                   .half_width = 0.5 * static_cast<double>(plan.kernel.width()),
                                   .pad = 0,
                                   .half_positions = false};
  const auto rows = static_cast<std::size_t>(std::floor(2 * plan.reach / plan.fine_step)) + 1;
  pulses_.sample(grid, plan.shapes, plan.medium, echoes, list, unit_, rows);
  for (std::size_t k = 0; k < list.size(); ++k)
    for (std::size_t tile = pulses_.row[k] / time_tile; tile <= (pulses_.row[k] + rows) / time_tile; ++tile)
      touched_[tile] = true;
  kernels::grid_samples(pulses_.positions(), list.size(), pulses_.re.data(), pulses_.im.data(), rows, plan.columns,
                        re_.data(), im_.data(), plan.grid_stride);
}

void BlockWorkspace::grid_sweeps(const Echoes& echoes, List list) {
  const TrueDelayPlan& plan = plan_;
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
      pulse_re_.push_back(static_cast<float>(g.real()));
      pulse_im_.push_back(static_cast<float>(g.imag()));
      touched_[static_cast<std::size_t>(n) / time_tile] = true;
    }
    const std::size_t at = static_cast<std::size_t>(first) * plan.grid_stride + static_cast<std::size_t>(column_0);
    kernels::grid_sampled_pulse(pulse_re_.data(), pulse_im_.data(), pulse_re_.size(),
                                static_cast<float>(2 * (column_0 - low_column) - 1), plan.columns, re_.data() + at,
                                im_.data() + at, plan.grid_stride);
  }
}

}  // namespace insonify
