// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "beamforming/gridded/grid_tile_internal.hpp"
#include "beamforming/gridded/gridding_loops_internal.hpp"

namespace insonify {
namespace {

/// Columns of the grid that an echo reaches: the first, and t of the kernel's polynomials.
template <typename Real>
struct SweepColumns {
  std::size_t first;
  Real offset;
  double sign;

  SweepColumns(const GriddingPlan<Real>& plan, double u) {
    const auto position = plan.position_of(u);
    const double low = position.step - 0.5 * static_cast<double>(plan.kernel.width()), column = std::ceil(low);
    first = static_cast<std::size_t>(column + static_cast<double>(grid_pad));
    offset = static_cast<Real>(2 * (column - low) - 1);
    sign = position.sign;
  }
};

}  // namespace

template <typename Real>
void GridTile<Real>::add_planned_sweeps(const Echoes& echoes, List list, std::size_t first_bin) {
  const GriddingPlan<Real>& plan = plan_;
  const auto all_pieces = static_cast<double>(plan.sweep_re.pieces), from = static_cast<double>(first_bin),
             to = static_cast<double>(std::min(first_bin + plan.tile_bins, plan.axis.bins));
  const EchoEnvelope envelope = echo_envelope(plan.head.pulse, {}, 0);
  Real *pulse_re = scratch_.data(), *pulse_im = scratch_.data() + scratch_.size() / 2;
  for (const std::uint32_t i : list) {
    Brick& brick = flushed(brick_at(0, 0));
    ++brick.since_flush;
    const double delay = echoes.delay[i];
    const SweepColumns<Real> columns(plan, echoes.u[i]);
    const double low_row = (delay - plan.half - plan.axis.start) / plan.axis.step, row_0 = std::ceil(low_row);
    const double piece_0 = std::max(0.0, from - row_0), piece_1 = std::min(all_pieces, to - row_0);
    if (!(piece_0 < piece_1)) continue;
    const std::complex<double> a = columns.sign / unit_ *
                                   std::exp(-plan.medium.absorption.a0 * plan.medium.sound_speed * delay) *
                                   echoes.amplitude[i];
    const auto add = [&](double piece, std::size_t rows) {
      Real* at = brick.sum.data() + static_cast<std::size_t>(row_0 + piece - from) * stride_ + columns.first;
      kernels::grid_sampled_pulse(pulse_re, pulse_im, rows, columns.offset, plan.columns, at, at + plane_, stride_);
    };
    const auto first = static_cast<std::size_t>(piece_0), rows = static_cast<std::size_t>(piece_1 - piece_0);
    const auto a_re = static_cast<Real>(a.real()), a_im = static_cast<Real>(a.imag()),
               row_offset = static_cast<Real>(2 * (row_0 - low_row) - 1);
    kernels::evaluate_pieces(plan.sweep_re, first, rows, row_offset, pulse_re);
    kernels::evaluate_pieces(plan.sweep_im, first, rows, row_offset, pulse_im);
    for (std::size_t n = 0; n < rows; ++n) {
      const Real re = pulse_re[n], im = pulse_im[n];
      pulse_re[n] = a_re * re - a_im * im;
      pulse_im[n] = a_re * im + a_im * re;
    }
    add(piece_0, rows);
    energy_ += plan.pulse_energy * std::norm(a) * (piece_1 - piece_0) / all_pieces;
    if (!plan.sweep_ends) continue;
    for (const double end : {0.0, all_pieces - 1}) {
      if (end < piece_0 || end >= piece_1) continue;
      const double t = plan.axis.start + (row_0 + end) * plan.axis.step - delay;
      const double level = std::copysign(plan.half - plan.axis.step, t);
      const std::complex<double> g = a * (envelope.at(t) - envelope.at(level));  // (E13)
      pulse_re[0] = static_cast<Real>(g.real());
      pulse_im[0] = static_cast<Real>(g.imag());
      add(end, 1);
    }
  }
}

template <typename Real>
void GridTile<Real>::add_sampled_sweeps(const Echoes& echoes, const PulseReach& reach, List list,
                                        std::size_t first_bin) {
  const GriddingPlan<Real>& plan = plan_;
  const std::size_t last_bin = std::min(first_bin + plan.tile_bins, plan.axis.bins);
  std::vector<Real> pulse_re, pulse_im;
  for (const std::uint32_t i : list) {
    Brick& brick = flushed(brick_at(0, 0));
    ++brick.since_flush;
    const double delay = echoes.delay[i];
    const SweepColumns<Real> columns(plan, echoes.u[i]);
    const EchoEnvelope envelope = plan.shapes.of(delay, echoes.doppler_of(i));
    const auto [first, last] = plan.axis.around(delay, reach.at(delay));
    const std::size_t from = std::max(first, first_bin), to = std::min(last, last_bin);
    pulse_re.clear();
    pulse_im.clear();
    for (std::size_t n = from; n < to; ++n) {
      const std::complex<double> g = columns.sign / unit_ * echoes.amplitude[i] *
                                     envelope.at(plan.axis.time_of(static_cast<double>(n)) - delay);  // (E13)
      pulse_re.push_back(static_cast<Real>(g.real()));
      pulse_im.push_back(static_cast<Real>(g.imag()));
      energy_ += std::norm(g);
    }
    Real* at = brick.sum.data() + (from - first_bin) * stride_ + columns.first;
    kernels::grid_sampled_pulse(pulse_re.data(), pulse_im.data(), pulse_re.size(), columns.offset, plan.columns, at,
                                at + plane_, stride_);
  }
}

template void GridTile<float>::add_planned_sweeps(const Echoes&, List, std::size_t);
template void GridTile<double>::add_planned_sweeps(const Echoes&, List, std::size_t);
template void GridTile<float>::add_sampled_sweeps(const Echoes&, const PulseReach&, List, std::size_t);
template void GridTile<double>::add_sampled_sweeps(const Echoes&, const PulseReach&, List, std::size_t);

}  // namespace insonify
