#include <algorithm>
#include <array>
#include <cmath>

#include "beamforming/narrow_band/grid_echoes_internal.hpp"
#include "beamforming/narrow_band/gridding_loops_internal.hpp"
#include "beamforming/pulses/pulse_loops_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t batch = echo_batch;     // echoes per call of the inner loop
constexpr std::size_t flush_interval = 2048;  // echoes added to a tile before partial sums are flushed

template <typename Real>
kernels::Pieces<Real> pieces(const PolynomialPieces<Real>& p) {
  return {p.coefficient.data(), p.degree, p.lanes};
}

/// Grids at most `batch` echoes that all have the planned pulse.
template <typename Real>
double grid_planned_pulses(const GriddingPlan<Real>& plan, const GriddingInput& input,
                           std::span<const std::uint32_t> list, std::size_t first_bin, GridTile<Real>& tile) {
  std::array<std::uint32_t, batch> row, column;
  std::array<Real, batch> row_offset, column_offset, re, im;
  const kernels::GridTargets<Real> targets{row.data(),           column.data(), row_offset.data(),
                                           column_offset.data(), re.data(),     im.data()};
  const double half_width = 0.5 * static_cast<double>(plan.kernel.width());
  const double first_row = static_cast<double>(first_bin) - static_cast<double>(plan.margin);
  double power = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    // Position of the echo between grid steps and between bins, and its amplitude after absorption.
    const std::uint32_t i = list[k];
    const double delay = input.echoes.delay[i];
    const auto place = plan.place_of(input.echoes.u[i]);
    const double low_column = place.step - half_width, column_0 = std::ceil(low_column);
    const double low_row = (delay - plan.half - plan.axis.start) / plan.axis.step, row_0 = std::ceil(low_row);
    const double gain =
        place.sign / input.unit * std::exp(-plan.medium.absorption.a0 * plan.medium.sound_speed * delay);
    column[k] = static_cast<std::uint32_t>(column_0 + grid_pad);
    column_offset[k] = static_cast<Real>(2 * (column_0 - low_column) - 1);
    row[k] = static_cast<std::uint32_t>(row_0 - first_row);
    row_offset[k] = static_cast<Real>(2 * (row_0 - low_row) - 1);
    re[k] = static_cast<Real>(gain * input.echoes.amplitude[i].real());  // (E13)
    im[k] = static_cast<Real>(gain * input.echoes.amplitude[i].imag());
    power += std::norm(gain * input.echoes.amplitude[i]);
  }
  kernels::grid_pulses(targets, list.size(), pieces(plan.rows), plan.choice.pulse_samples, pieces(plan.columns),
                       tile.scratch.data(), tile.re.data(), tile.im.data(), plan.stride);
  return power * plan.pulse_energy;
}

/// Grids sweeps; of each only the samples on this tile.
template <typename Real>
double grid_sweeps(const GriddingPlan<Real>& plan, const GriddingInput& input, std::span<const std::uint32_t> list,
                   std::size_t first_bin, GridTile<Real>& tile) {
  const double half_width = 0.5 * static_cast<double>(plan.kernel.width()),
               all_pieces = static_cast<double>(plan.rows.pieces);
  const auto from = static_cast<double>(first_bin),
             to = static_cast<double>(std::min(first_bin + plan.tile_bins, plan.axis.bins));
  const EchoEnvelope envelope = echo_envelope(plan.head.pulse, {}, 0);
  double power = 0;
  for (const std::uint32_t i : list) {
    const double delay = input.echoes.delay[i];
    const auto place = plan.place_of(input.echoes.u[i]);
    const double low_column = place.step - half_width, column_0 = std::ceil(low_column);
    const double low_row = (delay - plan.half - plan.axis.start) / plan.axis.step, row_0 = std::ceil(low_row);
    const double piece_0 = std::max(0.0, from - row_0), piece_1 = std::min(all_pieces, to - row_0);
    if (!(piece_0 < piece_1)) continue;
    const std::complex<double> a = place.sign / input.unit *
                                   std::exp(-plan.medium.absorption.a0 * plan.medium.sound_speed * delay) *
                                   input.echoes.amplitude[i];
    const auto column_offset = static_cast<Real>(2 * (column_0 - low_column) - 1);
    const auto at = [&](double piece) {
      return static_cast<std::size_t>(row_0 + piece - from) * plan.stride +
             static_cast<std::size_t>(column_0 + grid_pad);
    };
    kernels::grid_pulse_rows(static_cast<Real>(a.real()), static_cast<Real>(a.imag()),
                             static_cast<Real>(2 * (row_0 - low_row) - 1), column_offset, pieces(plan.rows),
                             pieces(plan.rows_im), static_cast<std::size_t>(piece_0),
                             static_cast<std::size_t>(piece_1 - piece_0), pieces(plan.columns), tile.scratch.data(),
                             tile.re.data() + at(piece_0), tile.im.data() + at(piece_0), plan.stride);
    power += std::norm(a) * (piece_1 - piece_0) / all_pieces;
    if (!plan.sweep_ends) continue;
    for (const double end : {0.0, all_pieces - 1}) {
      if (end < piece_0 || end >= piece_1) continue;
      const double t = plan.axis.start + (row_0 + end) * plan.axis.step - delay;
      const double level = std::copysign(plan.half - plan.axis.step, t);
      const std::complex<double> g = a * (envelope.at(t) - envelope.at(level));  // (E13)
      const double g_re = g.real(), g_im = g.imag();
      kernels::grid_sampled_pulse(&g_re, &g_im, 1, column_offset, pieces(plan.columns), tile.re.data() + at(end),
                                  tile.im.data() + at(end), plan.stride);
    }
  }
  return power * plan.pulse_energy;
}

/// Grids at most `batch` echoes whose Gaussian pulses differ by absorption and Doppler shift.
template <typename Real>
double grid_gaussian_pulses(const GriddingPlan<Real>& plan, const GriddingInput& input,
                            std::span<const std::uint32_t> list, std::size_t first_bin, GridTile<Real>& tile) {
  GaussianBatch<Real>& pulses = tile.pulses;
  const double energy = pulses.sample(plan, input, list, first_bin);
  kernels::grid_samples({pulses.row.data(), pulses.column.data(), pulses.column_offset.data()}, list.size(),
                        pulses.re.data(), pulses.im.data(), plan.longest_rows, pieces(plan.columns), tile.re.data(),
                        tile.im.data(), plan.stride);
  return energy;
}

/// Grids sweeps of different shape, sample by sample.
template <typename Real>
double grid_sampled_sweeps(const GriddingPlan<Real>& plan, const GriddingInput& input,
                           std::span<const std::uint32_t> list, std::size_t first_bin, GridTile<Real>& tile) {
  const double half_width = 0.5 * static_cast<double>(plan.kernel.width());
  const std::size_t last_bin = std::min(first_bin + plan.tile_bins, plan.axis.bins);
  double energy = 0;
  std::vector<double> pulse_re, pulse_im;
  for (const std::uint32_t i : list) {
    const double delay = input.echoes.delay[i];
    const auto place = plan.place_of(input.echoes.u[i]);
    const double low_column = place.step - half_width, column_0 = std::ceil(low_column);
    const EchoEnvelope envelope = plan.shapes.of(delay, input.echoes.doppler_of(i));
    const auto [first, last] = plan.axis.around(delay, input.reach.at(delay));
    const std::size_t from = std::max(first, first_bin), to = std::min(last, last_bin);
    pulse_re.clear();
    pulse_im.clear();
    for (std::size_t n = from; n < to; ++n) {
      const double t = plan.axis.start + static_cast<double>(n) * plan.axis.step - delay;
      const std::complex<double> g = place.sign / input.unit * input.echoes.amplitude[i] * envelope.at(t);  // (E13)
      pulse_re.push_back(g.real());
      pulse_im.push_back(g.imag());
      energy += std::norm(g);
    }
    const std::size_t start =
        (from - first_bin + plan.margin) * plan.stride + static_cast<std::size_t>(column_0 + grid_pad);
    kernels::grid_sampled_pulse(pulse_re.data(), pulse_im.data(), pulse_re.size(),
                                static_cast<Real>(2 * (column_0 - low_column) - 1), pieces(plan.columns),
                                tile.re.data() + start, tile.im.data() + start, plan.stride);
  }
  return energy;
}

}  // namespace

template <typename Real>
double GaussianBatch<Real>::sample(const GriddingPlan<Real>& plan, const GriddingInput& input,
                                   std::span<const std::uint32_t> list, std::size_t first_bin) {
  // Amplitudes and places, gathered; their arrays lie side by side.
  std::array<double, 12 * echo_batch> numbers;
  const auto array = [&](std::size_t k) { return numbers.data() + k * echo_batch; };
  double *delay = array(0), *u = array(1), *amplitude_re = array(2), *amplitude_im = array(3), *doppler = array(4);
  double power = 0, latest = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::uint32_t i = list[k];
    delay[k] = input.echoes.delay[i];
    u[k] = input.echoes.u[i];
    amplitude_re[k] = input.echoes.amplitude[i].real() / input.unit;
    amplitude_im[k] = input.echoes.amplitude[i].imag() / input.unit;
    doppler[k] = input.echoes.doppler_of(i);
    latest = std::max(latest, delay[k]);
  }
  plan.shapes.of(latest);  // throws if absorption lets a pulse grow
  const Absorption& absorption = plan.medium.absorption;
  const kernels::GaussianGrid grid{plan.axis.start,
                                   plan.axis.step,
                                   plan.longest_half,
                                   static_cast<double>(first_bin) - static_cast<double>(plan.margin),
                                   plan.cycles_per_u,
                                   static_cast<double>(plan.grid),
                                   0.5 * static_cast<double>(plan.kernel.width()),
                                   static_cast<double>(grid_pad),
                                   plan.element_offset != 0,
                                   plan.shapes.of(0).a,
                                   0.5 * plan.medium.sound_speed,
                                   absorption.a0,
                                   absorption.a1,
                                   absorption.a2};
  const kernels::GaussianState state{array(5), array(6), array(7), array(8), array(9), array(10), array(11)};
  kernels::place_gaussians({delay, u, amplitude_re, amplitude_im, doppler}, list.size(), grid, state,
                           kernels::GaussianPlaces<Real>{row.data(), column.data(), column_offset.data()});
  for (std::size_t k = 0; k < list.size(); ++k) power += state.power[k];
  re.resize(echo_batch * plan.longest_rows);
  im.resize(echo_batch * plan.longest_rows);
  kernels::sample_gaussians(state, list.size(), plan.longest_rows, re.data(), im.data());
  return power * plan.pulse_energy;
}

template <typename Real>
GridTile<Real>::GridTile(const GriddingPlan<Real>& plan)
    : re(plan.tile_rows * plan.stride),
      im(plan.tile_rows * plan.stride),
      grid(plan.grid_row * plan.grid),
      scratch(plan.sweep ? 2 * (plan.tile_bins + 16) : std::max<std::size_t>(plan.rows.lanes, 8)),
      plan_(&plan),
      plane_(plan.tile_rows * plan.stride) {}

template <typename Real>
void GridTile<Real>::flush_partial_sums() {
  if (flushed_re.empty()) flushed_re.assign(plane_, 0), flushed_im.assign(plane_, 0);
  for (std::size_t k = 0; k < plane_; ++k) flushed_re[k] += re[k];
  for (std::size_t k = 0; k < plane_; ++k) flushed_im[k] += im[k];
  re.clear();
  im.clear();
  since_flush = 0;
}

template <typename Real>
void GridTile<Real>::restore_flushed_sums() {
  for (std::size_t k = 0; k < flushed_re.size(); ++k) re[k] += flushed_re[k];
  for (std::size_t k = 0; k < flushed_im.size(); ++k) im[k] += flushed_im[k];
}

template <typename Real>
void GridTile<Real>::clear() {
  re.clear();
  im.clear();
  flushed_re.clear();
  flushed_im.clear();
  since_flush = 0;
}

template <typename Real>
double GridTile<Real>::add(const GriddingInput& input, std::span<const std::uint32_t> list, std::size_t first_bin) {
  const auto add_some = plan_->longest_rows == 0
                            ? (input.planned ? &grid_sweeps<Real> : &grid_sampled_sweeps<Real>)
                            : (input.planned ? &grid_planned_pulses<Real> : &grid_gaussian_pulses<Real>);
  double energy = 0;
  while (!list.empty()) {
    if (since_flush == flush_interval) flush_partial_sums();
    const auto some = list.first(std::min({batch, list.size(), flush_interval - since_flush}));
    energy += add_some(*plan_, input, some, first_bin, *this);
    since_flush += some.size();
    list = list.subspan(some.size());
  }
  return energy;
}

template struct GaussianBatch<float>;
template struct GaussianBatch<double>;
template struct GridTile<float>;
template struct GridTile<double>;

}  // namespace insonify
