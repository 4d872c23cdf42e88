#include "beamforming/wideband_block_internal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "beamforming/gridding_loops_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t batch = 256;        // echoes handed to the kernel at once
constexpr std::size_t chunk_planes = 10;  // of five chunks
constexpr std::size_t chunk_pad = 16;     // silent rows to either side

kernels::Pieces<float> pieces(const PolynomialPieces<float>& p) { return {p.coefficient.data(), p.degree, p.lanes}; }

}  // namespace

WidebandTransforms::WidebandTransforms(const WidebandPlan& plan)
    : to_harmonics(plan.grid, wideband_tile, wideband_tile_row, FFTW_FORWARD),
      to_directions(plan.grid, wideband_tile, wideband_tile_row, FFTW_BACKWARD),
      to_frequencies(plan.fine, 1, FFTW_FORWARD),
      to_bins(plan.cycle, 1, FFTW_BACKWARD) {}

WidebandRoom::WidebandRoom(const WidebandPlan& plan, const WidebandTransforms& transforms)
    : plan_(plan),
      transforms_(transforms),
      re_((plan.fine + wideband_tile) * plan.grid_stride),
      im_((plan.fine + wideband_tile) * plan.grid_stride),
      tile_(plan.grid * wideband_tile_row),
      spectrum_(plan.rows() * plan.fine_row),
      bins_(plan.rows() * ((plan.cycle + 15) / 8 * 8)),
      scratch_(std::max<std::size_t>(plan.pulse.lanes, 8)),
      chunks_(chunk_planes * (plan.rows() + 2 * chunk_pad) * kernels::lines_at_once),
      place_(plan.rows()),
      beam_(2 * wideband_tile),
      touched_(plan.fine / wideband_tile + 2),
      bins_row_((plan.cycle + 15) / 8 * 8) {}

void WidebandRoom::image(const Echoes& echoes, const WidebandBlock& block, std::size_t ends, ComplexGrid& pressure) {
  const int order = plan_.order(block.curvature);
  grid_echoes(echoes, block);
  to_harmonics();
  to_frequencies();
  apply_array(block.curvature, order);
  to_bins();
  to_beams(block, ends, pressure);
}

void WidebandRoom::grid_echoes(const Echoes& echoes, const WidebandBlock& block) {
  re_.clear();
  im_.clear();
  std::fill(touched_.begin(), touched_.end(), false);
  if (plan_.one_shape && echoes.doppler.empty())
    grid_alike(echoes, block);
  else
    grid_singly(echoes, block);
}

/// Where an echo lies on the grid: the linear part of the third order of its wavefront moves its direction.
static double column_of(const WidebandPlan& plan, double u, double curvature) {
  const double moved = u - 0.5 * plan.cubic * u * (1 - u * u) * curvature * curvature;
  return (moved / plan.period + 0.5) * static_cast<double>(plan.grid);
}

void WidebandRoom::grid_alike(const Echoes& echoes, const WidebandBlock& block) {
  const WidebandPlan& plan = plan_;
  std::array<std::uint32_t, batch> row, column;
  std::array<float, batch> row_offset, column_offset, re, im;
  const kernels::GridPlaces<float> places{row.data(),           column.data(), row_offset.data(),
                                          column_offset.data(), re.data(),     im.data()};
  const double half_width = 0.5 * static_cast<double>(plan.kernel.width()), c = plan.medium.sound_speed;
  const double start = plan.axis.start + (static_cast<double>(block.number * plan.block) -
                                          2 * static_cast<double>(plan.guard)) * plan.axis.step;
  for (auto list = block.list; !list.empty(); list = list.subspan(std::min(batch, list.size()))) {
    const std::size_t count = std::min(batch, list.size());
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t i = list[k];
      const double delay = echoes.delay[i];
      const double low_column = column_of(plan, echoes.u[i], 2 / (c * delay)) - half_width;
      const double column_0 = std::ceil(low_column);
      const double low_row = (delay - plan.half - start) / plan.fine_step, row_0 = std::ceil(low_row);
      const double gain = std::exp(-plan.medium.absorption.a0 * c * delay) / block.unit;
      column[k] = static_cast<std::uint32_t>(column_0);
      column_offset[k] = static_cast<float>(2 * (column_0 - low_column) - 1);
      row[k] = static_cast<std::uint32_t>(row_0);
      row_offset[k] = static_cast<float>(2 * (row_0 - low_row) - 1);
      re[k] = static_cast<float>(gain * echoes.amplitude[i].real());
      im[k] = static_cast<float>(gain * echoes.amplitude[i].imag());
      touched_[row[k] / wideband_tile] = touched_[(row[k] + plan.pulse_samples) / wideband_tile] = true;
    }
    kernels::grid(places, count, pieces(plan.pulse), plan.pulse_samples, pieces(plan.columns), scratch_.data(),
                  re_.data(), im_.data(), plan.grid_stride);
  }
}

void WidebandRoom::grid_singly(const Echoes& echoes, const WidebandBlock& block) {
  const WidebandPlan& plan = plan_;
  const double half_width = 0.5 * static_cast<double>(plan.kernel.width()), c = plan.medium.sound_speed;
  const double start = plan.axis.start + (static_cast<double>(block.number * plan.block) -
                                          2 * static_cast<double>(plan.guard)) * plan.axis.step;
  const PulseReach reach(plan.head.pulse, plan.medium.absorption, c, !echoes.doppler.empty(), plan.cut);
  for (const std::uint32_t i : block.list) {
    const double delay = echoes.delay[i];
    const double low_column = column_of(plan, echoes.u[i], 2 / (c * delay)) - half_width;
    const double column_0 = std::ceil(low_column), half = reach.at(delay);
    const EchoEnvelope envelope = plan.shapes.of(delay, echoes.doppler_of(i));
    const double first = std::max(0.0, std::ceil((delay - half - start) / plan.fine_step));
    const double last = std::min(std::floor((delay + half - start) / plan.fine_step), static_cast<double>(plan.fine) - 1);
    pulse_re_.clear();
    pulse_im_.clear();
    for (double n = first; n <= last; ++n) {
      const std::complex<double> g =
          echoes.amplitude[i] / block.unit * envelope.at(start + n * plan.fine_step - delay);
      pulse_re_.push_back(g.real());
      pulse_im_.push_back(g.imag());
      touched_[static_cast<std::size_t>(n) / wideband_tile] = true;
    }
    const std::size_t at = static_cast<std::size_t>(first) * plan.grid_stride + static_cast<std::size_t>(column_0);
    kernels::grid_pulse(pulse_re_.data(), pulse_im_.data(), pulse_re_.size(),
                        static_cast<float>(2 * (column_0 - low_column) - 1), pieces(plan.columns), re_.data() + at,
                        im_.data() + at, plan.grid_stride);
  }
}

void WidebandRoom::to_harmonics() {
  const WidebandPlan& plan = plan_;
  for (std::size_t r = 0; r < plan.rows(); ++r) std::fill_n(spectrum_.data() + r * plan.fine_row, plan.fine, Complex(0));
  for (std::size_t n0 = 0; n0 < plan.fine; n0 += wideband_tile) {
    if (!touched_[n0 / wideband_tile]) continue;
    for (std::size_t j0 = 0; j0 < plan.grid; j0 += 16)
      for (std::size_t n = 0; n < wideband_tile; ++n) {
        const std::size_t at = (n0 + n) * plan.grid_stride;
        for (std::size_t j = j0; j < std::min(j0 + 16, plan.grid); ++j)
          tile_[j * wideband_tile_row + n] = Complex(re_[at + j], im_[at + j]);
      }
    transforms_.to_harmonics.run(tile_.data());
    const std::size_t count = std::min(wideband_tile, plan.fine - n0);
    for (std::size_t r = 0; r < plan.rows(); ++r)
      std::copy_n(tile_.data() + (r + plan.grid - plan.most) % plan.grid * wideband_tile_row, count,
                  spectrum_.data() + r * plan.fine_row + n0);
  }
}

void WidebandRoom::to_frequencies() {
  for (std::size_t r = 0; r < plan_.rows(); ++r) transforms_.to_frequencies.run(spectrum_.data() + r * plan_.fine_row);
}

kernels::SpectrumChunk WidebandRoom::chunk(std::size_t which) {
  const std::size_t plane = (plan_.rows() + 2 * chunk_pad) * kernels::lines_at_once;
  float* first = chunks_.data() + chunk_pad * kernels::lines_at_once;
  return {first + 2 * which * plane, first + (2 * which + 1) * plane};
}

void WidebandRoom::apply_array(double curvature, int order) {
  for (std::size_t r = 0; r < plan_.rows(); ++r) place_[r] = plan_.place[r] * static_cast<float>(curvature);
  const auto top = static_cast<std::size_t>(std::floor(plan_.half_band * static_cast<double>(plan_.fine) * plan_.fine_step));
  for (std::size_t l = 0; l < plan_.fine; l += kernels::lines_at_once)
    if (l <= top || l + kernels::lines_at_once + top > plan_.fine) apply_array(l, plan_.bend.data() + l, order);
}

void WidebandRoom::apply_array(std::size_t first_line, const float* bend, int order) {
  using namespace kernels;
  const WidebandPlan& plan = plan_;
  const std::size_t rows = plan.rows(), plane = rows * lines_at_once, reach = plan.tap.size() - 1;
  SpectrumChunk v = chunk(0), spare = chunk(1), x = chunk(2), p = chunk(3), p_spare = chunk(4);
  for (std::size_t r = 0; r < rows; ++r) {
    const auto* row = reinterpret_cast<const float*>(spectrum_.data() + r * plan.fine_row + first_line);
    split_row(row, plan.row_factor[r], v.re + r * lines_at_once, v.im + r * lines_at_once);
  }
  std::copy_n(v.re, plane, x.re);
  std::copy_n(v.im, plane, x.im);
  std::fill_n(p.re, plane, 0.0F);
  std::fill_n(p.im, plane, 0.0F);
  const float* response = plan.response.data() + first_line;
  add_weighted_power(order, rows, place_.data(), bend, response, plan.fine_row, x, p);
  for (int n = 1; n <= order; ++n) {
    filter_rows(plan.tap.data(), reach, rows, v, spare);
    std::swap(v, spare);
    add_power(n, rows, place_.data(), bend, v, x);
    filter_rows(plan.tap.data(), reach, rows, p, p_spare);
    std::swap(p, p_spare);
    add_weighted_power(order - n, rows, place_.data(), bend, response, plan.fine_row, x, p);
  }
  for (std::size_t r = 0; r < rows; ++r) {
    auto* row = reinterpret_cast<float*>(spectrum_.data() + r * plan.fine_row + first_line);
    merge_row(p.re + r * lines_at_once, p.im + r * lines_at_once, plan.row_factor[r], row);
  }
}

void WidebandRoom::to_bins() {
  const WidebandPlan& plan = plan_;
  const auto top = static_cast<std::size_t>(std::floor(plan.half_band * static_cast<double>(plan.fine) * plan.fine_step));
  for (std::size_t r = 0; r < plan.rows(); ++r) {
    const Complex* line = spectrum_.data() + r * plan.fine_row;
    Complex* bin = bins_.data() + r * bins_row_;
    std::fill_n(bin, plan.cycle, Complex(0));
    for (std::size_t l = 0; l <= top; ++l) bin[l % plan.cycle] += line[l];
    for (std::size_t l = 1; l <= top; ++l) bin[(plan.cycle - l % plan.cycle) % plan.cycle] += line[plan.fine - l];
    transforms_.to_bins.run(bin);
  }
}

void WidebandRoom::steer(double curvature) {
  beam_weight_.clear();
  beam_row_.clear();
  const std::size_t width = plan_.kernel.width();
  for (const double u : beam_cosines(plan_.head.fan)) {
    const double column = column_of(plan_, u, curvature);
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
    std::fill_n(tile_.data(), plan.grid * wideband_tile_row, Complex(0));
    for (std::size_t r = 0; r < plan.rows(); ++r)
      std::copy_n(bins_.data() + r * bins_row_ + n0, count,
                  tile_.data() + (r + plan.grid - plan.most) % plan.grid * wideband_tile_row);
    transforms_.to_directions.run(tile_.data());
    for (Eigen::Index b = 0; b < pressure.rows(); ++b) {
      kernels::interpolate(beam_weight_.data() + b * width, beam_row_.data() + b * width, width, rows,
                           2 * wideband_tile_row, 2 * count, beam_.data());
      const auto* value = reinterpret_cast<const std::complex<double>*>(beam_.data());
      for (std::size_t n = 0; n < count; ++n) {
        if (first + n < skipped || first + n >= plan.axis.bins + skipped) continue;
        std::complex<double>& sum = pressure(b, static_cast<Eigen::Index>(first + n - skipped));
        const bool shared = n0 + n < ends || n0 + n + ends >= plan.cycle;
        sum = (shared ? sum : 0.0) + block.unit * value[n];
      }
    }
  }
}

}  // namespace insonify
