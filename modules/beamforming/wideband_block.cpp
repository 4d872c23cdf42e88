#include <algorithm>
#include <array>
#include <cmath>

#include "beamforming/gridding_loops_internal.hpp"
#include "beamforming/wideband_block_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t batch = 256;  // echoes handed to the kernel at once

kernels::Pieces<float> pieces(const PolynomialPieces<float>& p) { return {p.coefficient.data(), p.degree, p.lanes}; }

/// What an echo weighs in a field.
double weight_of(const WidebandBlock& block, bool excess, double curvature) {
  return excess ? curvature / block.curvature - 1 : 1;
}

}  // namespace

WidebandTransforms::WidebandTransforms(const WidebandPlan& plan)
    : to_harmonics(plan.grid, 1, FFTW_FORWARD),
      to_directions(plan.grid, wideband_tile, wideband_tile_row, FFTW_BACKWARD),
      to_frequencies(plan.fine, 1, FFTW_FORWARD),
      to_bins(plan.cycle, 1, FFTW_BACKWARD),
      to_samples(plan.fine, 1, FFTW_BACKWARD) {}

WidebandRoom::WidebandRoom(const WidebandPlan& plan, const WidebandTransforms& transforms)
    : plan_(plan),
      transforms_(transforms),
      array_(plan),
      re_((plan.fine + wideband_tile) * plan.grid_stride),
      im_((plan.fine + wideband_tile) * plan.grid_stride),
      tile_(std::max(plan.grid, plan.grid_stride) * wideband_tile_row),
      spectrum_(plan.rows() * plan.fine_row),
      bins_(plan.rows() * ((plan.cycle + 15) / 8 * 8)),
      scratch_(std::max<std::size_t>(plan.pulse.lanes, 8)),
      excess_(plan.cycle),
      touched_(plan.fine / wideband_tile + 2),
      bins_row_((plan.cycle + 15) / 8 * 8) {}

void WidebandRoom::image(const SeenEchoes& seen, const WidebandBlock& block, std::size_t ends, ComplexGrid& pressure) {
  const bool two = block.effort.fields == 2;
  if (two && !excess_spectrum_) {
    excess_spectrum_ = std::make_unique<WidebandSpectrum>(plan_.rows() * plan_.fine_row);
    excess_bins_ = std::make_unique<WidebandSpectrum>(plan_.rows() * bins_row_);
  }
  if (plan_.parts.count() > 1 && !samples_) samples_ = std::make_unique<WidebandSpectrum>(plan_.grid * plan_.fine_row);
  if (plan_.parts.count() > 1 && two && !excess_samples_)
    excess_samples_ = std::make_unique<WidebandSpectrum>(plan_.grid * plan_.fine_row);
  grid_echoes(seen, block, false);
  to_frequencies(spectrum_);
  if (two) {
    grid_echoes(seen, block, true);
    to_frequencies(*excess_spectrum_);
  }
  array_.apply(block.part, block.curvature, block.effort, spectrum_, two ? excess_spectrum_.get() : nullptr);
  if (plan_.parts.count() > 1) return add_part(block, pressure);
  to_bins(spectrum_, bins_);
  if (two) {
    to_bins(*excess_spectrum_, *excess_bins_);
    add_excess(block);
  }
  to_beams(block, ends, pressure);
}

void WidebandRoom::grid_echoes(const SeenEchoes& seen, const WidebandBlock& block, bool excess) {
  re_.clear();
  im_.clear();
  std::fill(touched_.begin(), touched_.end(), false);
  if (plan_.one_shape && seen.echoes.doppler.empty())
    grid_alike(seen, block, excess);
  else
    grid_singly(seen, block, excess);
}

void WidebandRoom::grid_alike(const SeenEchoes& seen, const WidebandBlock& block, bool excess) {
  const WidebandPlan& plan = plan_;
  const Echoes& echoes = seen.echoes;
  std::array<std::uint32_t, batch> row, column;
  std::array<float, batch> row_offset, column_offset, re, im;
  const kernels::GridTargets<float> targets{row.data(),           column.data(), row_offset.data(),
                                            column_offset.data(), re.data(),     im.data()};
  const double half_width = 0.5 * static_cast<double>(plan.kernel.width()), c = plan.medium.sound_speed;
  const double start = plan.start_of(block.number);
  for (auto list = block.list; !list.empty(); list = list.subspan(std::min(batch, list.size()))) {
    const std::size_t count = std::min(batch, list.size());
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t i = list[k];
      const double delay = echoes.delay[i];
      const double low_column =
          plan.column_of(echoes.u[i], plan.moving_curvature(block.curvature, seen.curvature[i])) - half_width;
      const double column_0 = std::ceil(low_column);
      const double low_row = (delay - plan.half - start) / plan.fine_step, row_0 = std::ceil(low_row);
      const double weight = weight_of(block, excess, seen.curvature[i]);
      const double gain = weight * std::exp(-plan.medium.absorption.a0 * c * seen.path[i]) / block.unit;
      column[k] = static_cast<std::uint32_t>(column_0);
      column_offset[k] = static_cast<float>(2 * (column_0 - low_column) - 1);
      row[k] = static_cast<std::uint32_t>(row_0);
      row_offset[k] = static_cast<float>(2 * (row_0 - low_row) - 1);
      re[k] = static_cast<float>(gain * echoes.amplitude[i].real());
      im[k] = static_cast<float>(gain * echoes.amplitude[i].imag());
      touched_[row[k] / wideband_tile] = touched_[(row[k] + plan.pulse_samples) / wideband_tile] = true;
    }
    kernels::grid_pulses(targets, count, pieces(plan.pulse), plan.pulse_samples, pieces(plan.columns), scratch_.data(),
                         re_.data(), im_.data(), plan.grid_stride);
  }
}

void WidebandRoom::grid_singly(const SeenEchoes& seen, const WidebandBlock& block, bool excess) {
  const WidebandPlan& plan = plan_;
  const Echoes& echoes = seen.echoes;
  const double half_width = 0.5 * static_cast<double>(plan.kernel.width()), c = plan.medium.sound_speed;
  const double start = plan.start_of(block.number);
  const PulseReach reach(plan.head.pulse, plan.medium.absorption, c, !echoes.doppler.empty(), plan.cut);
  for (const std::uint32_t i : block.list) {
    const double delay = echoes.delay[i];
    const double low_column =
        plan.column_of(echoes.u[i], plan.moving_curvature(block.curvature, seen.curvature[i])) - half_width;
    const double column_0 = std::ceil(low_column), half = reach.at(seen.path[i]);
    const double weight = weight_of(block, excess, seen.curvature[i]);
    const EchoEnvelope envelope = plan.shapes.of(seen.path[i], echoes.doppler_of(i));
    const double first = std::max(0.0, std::ceil((delay - half - start) / plan.fine_step));
    const double last =
        std::min(std::floor((delay + half - start) / plan.fine_step), static_cast<double>(plan.fine) - 1);
    pulse_re_.clear();
    pulse_im_.clear();
    for (double n = first; n <= last; ++n) {
      const std::complex<double> g =
          weight / block.unit * echoes.amplitude[i] * envelope.at(start + n * plan.fine_step - delay);
      pulse_re_.push_back(g.real());
      pulse_im_.push_back(g.imag());
      touched_[static_cast<std::size_t>(n) / wideband_tile] = true;
    }
    const std::size_t at = static_cast<std::size_t>(first) * plan.grid_stride + static_cast<std::size_t>(column_0);
    kernels::grid_sampled_pulse(pulse_re_.data(), pulse_im_.data(), pulse_re_.size(),
                                static_cast<float>(2 * (column_0 - low_column) - 1), pieces(plan.columns),
                                re_.data() + at, im_.data() + at, plan.grid_stride);
  }
}

void WidebandRoom::to_frequencies(WidebandSpectrum& spectrum) {
  const WidebandPlan& plan = plan_;
  for (std::size_t n0 = 0; n0 < plan.fine; n0 += wideband_tile) {
    const std::size_t count = std::min(wideband_tile, plan.fine - n0);
    if (!touched_[n0 / wideband_tile]) {
      for (std::size_t r = 0; r < plan.rows(); ++r)
        std::fill_n(spectrum.data() + r * plan.fine_row + n0, count, Complex(0));
      continue;
    }
    for (std::size_t n = 0; n < count; ++n) {
      Complex* line = tile_.data() + n * plan.grid_stride;
      kernels::merge_planes(re_.data() + (n0 + n) * plan.grid_stride, im_.data() + (n0 + n) * plan.grid_stride,
                            plan.grid, reinterpret_cast<float*>(line));
      transforms_.to_harmonics.run(line);
    }
    // One row per harmonic now.
    for (std::size_t r = 0; r < plan.rows(); ++r) {
      const Complex* from = tile_.data() + (r + plan.grid - plan.most) % plan.grid;
      Complex* to = spectrum.data() + r * plan.fine_row + n0;
      for (std::size_t n = 0; n < count; ++n) to[n] = from[n * plan.grid_stride];
    }
  }
  for (std::size_t r = 0; r < plan.rows(); ++r) transforms_.to_frequencies.run(spectrum.data() + r * plan.fine_row);
}

void WidebandRoom::to_bins(WidebandSpectrum& spectrum, WidebandSpectrum& bins) {
  const WidebandPlan& plan = plan_;
  const std::size_t top = plan.top_line();
  for (std::size_t r = 0; r < plan.rows(); ++r) {
    const Complex* line = spectrum.data() + r * plan.fine_row;
    Complex* bin = bins.data() + r * bins_row_;
    // Frequencies beyond what bins can tell fold, as they do in any sampled image.
    std::fill_n(bin, plan.cycle, Complex(0));
    for (std::size_t l = 0, k = 0; l <= top; ++l, k = k + 1 == plan.cycle ? 0 : k + 1) bin[k] += line[l];
    for (std::size_t l = 1, k = plan.cycle - 1; l <= top; ++l, k = k == 0 ? plan.cycle - 1 : k - 1)
      bin[k] += line[plan.fine - l];
    transforms_.to_bins.run(bin);
  }
}

void WidebandRoom::add_excess(const WidebandBlock& block) {
  const double start = plan_.start_of(block.number), c = plan_.medium.sound_speed;
  for (std::size_t n = 0; n < plan_.cycle; ++n) {
    const double delay = start + static_cast<double>(n) * plan_.axis.step;
    const double excess = delay > 0 ? 2 / (c * delay * block.curvature) - 1 : 0;
    excess_[n] = static_cast<float>(std::min(excess, 1.0));
  }
  for (std::size_t r = 0; r < plan_.rows(); ++r) {
    Complex* bin = bins_.data() + r * bins_row_;
    const Complex* more = excess_bins_->data() + r * bins_row_;
    for (std::size_t n = 0; n < plan_.cycle; ++n) bin[n] += excess_[n] * more[n];
  }
}

void WidebandRoom::steer(double curvature) {
  beam_weight_.clear();
  beam_row_.clear();
  const std::size_t width = plan_.kernel.width();
  for (const double u : beam_cosines(plan_.head.fan)) {
    const double column = plan_.column_of(u, curvature);
    const double first = std::ceil(column - 0.5 * static_cast<double>(width));
    for (std::size_t k = 0; k < width; ++k) {
      beam_weight_.push_back(static_cast<float>(plan_.kernel.at(first + static_cast<double>(k) - column)));
      beam_row_.push_back(static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(k));
    }
  }
}

void WidebandRoom::to_beams(const WidebandBlock& block, std::size_t ends, ComplexGrid& pressure) {
  const WidebandPlan& plan = plan_;
  steer(block.curvature);
  const std::size_t width = plan.kernel.width(), skipped = 2 * plan.guard;
  const float* rows = reinterpret_cast<const float*>(tile_.data());
  for (std::size_t n0 = 0; n0 < plan.cycle; n0 += wideband_tile) {
    const std::size_t first = block.number * plan.block + n0, count = std::min(wideband_tile, plan.cycle - n0);
    if (first + count <= skipped || first >= plan.axis.bins + skipped) continue;
    std::fill_n(tile_.data() + (plan.most + 1) * wideband_tile_row, (plan.grid - plan.rows()) * wideband_tile_row,
                Complex(0));
    for (std::size_t r = 0; r < plan.rows(); ++r)
      std::copy_n(bins_.data() + r * bins_row_ + n0, count,
                  tile_.data() + (r + plan.grid - plan.most) % plan.grid * wideband_tile_row);
    transforms_.to_directions.run(tile_.data());
    // Bins of this tile that belong to the axis, and those of them that neighbours have written.
    const std::size_t from = std::max(skipped, first) - first,
                      to = std::min(first + count, plan.axis.bins + skipped) - first;
    const std::size_t own = std::clamp(ends, n0 + from, n0 + to) - n0;
    const std::size_t shared = std::max(own, std::clamp(plan.cycle - ends, n0 + from, n0 + to) - n0);
    for (Eigen::Index b = 0; b < pressure.rows(); ++b) {
      double* sum = reinterpret_cast<double*>(&pressure(b, 0)) + 2 * static_cast<std::ptrdiff_t>(first - skipped);
      const auto part = [&](std::size_t begin, std::size_t end, bool add) {
        if (begin < end)
          kernels::interpolate_scaled(beam_weight_.data() + b * width, beam_row_.data() + b * width, width,
                                      rows + 2 * begin, 2 * wideband_tile_row, 2 * (end - begin), block.unit, add,
                                      sum + 2 * begin);
      };
      part(from, own, true);
      part(own, shared, false);
      part(shared, to, true);
    }
  }
}

}  // namespace insonify
