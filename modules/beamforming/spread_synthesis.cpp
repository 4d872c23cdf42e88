#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "beamforming/flush_denormals_internal.hpp"
#include "beamforming/require_synthesis_internal.hpp"
#include "beamforming/spread_kernels_internal.hpp"
#include "beamforming/spread_synthesis_internal.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t pad = 16;              // columns before the grid's first and after its last
constexpr std::size_t batch = 256;           // echoes handed to the kernel at once
constexpr std::size_t terms_at_once = 2048;  // echoes added up before the sum is put aside

/// The smallest even number from `least` on with no prime factor above 5: FFTW's fast lengths.
std::size_t fast_length(std::size_t least) {
  for (std::size_t n = least + least % 2;; n += 2) {
    std::size_t rest = n;
    for (const std::size_t factor : {2, 3, 5})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return n;
  }
}

/// The largest amplitude after absorption, so that no number leaves the reach of single precision; 1 if all are silent.
double largest(const Echoes& echoes, const Medium& medium) {
  double most = 0;
  for (std::size_t i = 0; i < echoes.size(); ++i)
    most = std::max(
        most, std::abs(echoes.amplitude[i]) * std::exp(-medium.absorption.a0 * medium.sound_speed * echoes.delay[i]));
  return most > std::numeric_limits<double>::min() ? most : 1;
}

template <typename Real>
kernels::Pieces<Real> pieces(const PolynomialPieces<Real>& p) {
  return {p.coefficient.data(), p.degree, p.lanes};
}

}  // namespace

/// The room of one tile of bins: planes for stamping (a margin of rows to either side takes what belongs to
/// neighbours) and the grid that the transforms work on.
template <typename Real>
struct SpreadSynthesis<Real>::Tile {
  AlignedArray<Real, Real> re, im;
  AlignedArray<Complex, Real> grid;
  std::vector<Real> scratch, whole_re, whole_im;  // of what was stamped before
  std::vector<double> pulse_re, pulse_im;

  Tile(std::size_t plane, std::size_t grid_size, std::size_t lanes)
      : re(plane), im(plane), grid(grid_size), scratch(lanes) {}

  /// Puts aside what was stamped so far, so that no sum has too many terms of like sign for its precision.
  void put_aside(std::size_t plane) {
    if (whole_re.empty()) whole_re.assign(plane, 0), whole_im.assign(plane, 0);
    for (std::size_t k = 0; k < plane; ++k) whole_re[k] += re[k];
    for (std::size_t k = 0; k < plane; ++k) whole_im[k] += im[k];
    re.clear();
    im.clear();
  }
  void take_back() {
    for (std::size_t k = 0; k < whole_re.size(); ++k) re[k] += whole_re[k];
    for (std::size_t k = 0; k < whole_im.size(); ++k) im[k] += whole_im[k];
  }
};

template <typename Real>
SpreadSynthesis<Real>::SpreadSynthesis(const SonarHead& head, const Medium& medium, const SynthesisOptions& options,
                                       double kernel_tolerance)
    : head_(head),
      medium_(medium),
      threads_(options.threads),
      axis_(head.gate, medium.sound_speed),
      cut_(options.tolerance / 4),
      shapes_(head.pulse, medium),
      one_shape_(medium.absorption.a1 == 0 && medium.absorption.a2 == 0),
      kernel_(kernel_tolerance),
      grid_(fast_length(std::max(2 * head.array.elements(), 2 * kernel_.width()))),
      stride_(grid_ + 2 * pad),
      tile_bins_(grid_ <= 2048 ? 64 : 32),
      cycles_per_u_(head.array.spacing * head.pulse.centre_frequency / medium.sound_speed),
      half_place_(head.array.elements() % 2 == 0 ? 0.5 : 0.0),
      to_elements_(grid_, tile_bins_, FFTW_BACKWARD),
      to_beams_(grid_, tile_bins_, FFTW_FORWARD) {
  plan_time(options, kernel_tolerance);
  plan_elements();
  plan_beams();
  choice_.single_precision = sizeof(Real) == 4;
  choice_.kernel_width = kernel_.width();
  choice_.grid = grid_;
  choice_.bytes_per_thread = static_cast<double>((2 * tile_rows_ * stride_ + 2 * tile_bins_ * grid_) * sizeof(Real));
}

template <typename Real>
void SpreadSynthesis<Real>::plan_time(const SynthesisOptions& options, double kernel_tolerance) {
  const double half_width = 0.5 * static_cast<double>(kernel_.width());
  columns_ = PolynomialPieces<Real>::fit([this](double x) { return kernel_.at(x); }, -half_width, kernel_.width(),
                                         0.1 * kernel_tolerance);
  const double reach = PulseReach(head_.pulse, medium_.absorption, medium_.sound_speed, false, cut_).half;
  sweep_ = one_shape_ && head_.pulse.shape == PulseShape::linear_fm;
  half_ = sweep_ ? std::ceil(reach / axis_.step) * axis_.step : reach;  // a sweep's middle stands between two pieces
  sweep_ends_ = sweep_ && half_ > head_.pulse.duration - axis_.step;
  choice_.pulse_half_length = reach;
  choice_.pulse_samples = static_cast<std::size_t>(std::floor(2 * half_ / axis_.step + 1e-9)) + (sweep_ ? 0 : 1);
  margin_ = one_shape_ && !sweep_ ? choice_.pulse_samples - 1 : 0;
  tile_rows_ = tile_bins_ + 2 * margin_;
  if (!one_shape_) return;
  const EchoEnvelope envelope = echo_envelope(head_.pulse, {}, 0);
  const double first = -half_ / axis_.step, last_piece = -first - 1;
  // The ends of a sweep are corners, which no polynomial follows: their pieces are level, and stamp_sweeps adds the rest.
  const auto value = [&](double x) {
    return envelope.at((sweep_ends_ ? std::clamp(x, first + 1, last_piece) : x) * axis_.step);
  };
  for (std::size_t k = 0; k < choice_.pulse_samples; ++k)
    pulse_energy_ += std::norm(envelope.at((static_cast<double>(k) + 0.5) * axis_.step - half_));
  const double error = 0.1 * options.tolerance / (sweep_ ? std::sqrt(static_cast<double>(choice_.pulse_samples)) : 1);
  rows_ = PolynomialPieces<Real>::fit([&](double x) { return value(x).real(); }, first, choice_.pulse_samples, error);
  if (sweep_)
    rows_im_ =
        PolynomialPieces<Real>::fit([&](double x) { return value(x).imag(); }, first, choice_.pulse_samples, error);
}

template <typename Real>
void SpreadSynthesis<Real>::plan_elements() {
  const std::size_t n = head_.array.elements();
  const auto steps = static_cast<double>(grid_);
  element_.assign(grid_, Complex(0));
  for (std::size_t m = 0; m < n; ++m) {
    const double place = element_place(m, n), spread = kernel_.transform(place / steps);
    const auto frequency = static_cast<std::ptrdiff_t>(std::floor(place));
    element_[static_cast<std::size_t>(frequency < 0 ? frequency + static_cast<std::ptrdiff_t>(grid_) : frequency)] =
        static_cast<Real>(head_.array.shading[m] / (static_cast<double>(n) * spread * spread));
  }
  half_turn_.resize(grid_);
  for (std::size_t j = 0; j < grid_; ++j)
    half_turn_[j] = Complex(std::polar(1.0, 2 * pi * half_place_ * static_cast<double>(j) / steps));
}

template <typename Real>
void SpreadSynthesis<Real>::plan_beams() {
  const std::size_t width = kernel_.width();
  for (const double u : beam_cosines(head_.fan)) {
    const Place place = place_of(u);
    const double low = place.step - 0.5 * static_cast<double>(width), first = std::ceil(low);
    for (std::size_t k = 0; k < width; ++k) {
      const double j = first + static_cast<double>(k), wraps = std::floor(j / static_cast<double>(grid_));
      const double sign = wraps != 0 && half_place_ != 0 ? -place.sign : place.sign;
      beam_weight_.push_back(static_cast<Real>(sign * kernel_.at(j - place.step)));
      beam_row_.push_back(static_cast<std::uint32_t>(j - wraps * static_cast<double>(grid_)));
    }
  }
}

template <typename Real>
typename SpreadSynthesis<Real>::Place SpreadSynthesis<Real>::place_of(double u) const {
  const double cycles = cycles_per_u_ * u, whole = std::floor(cycles);
  const bool turned = half_place_ != 0 && std::fmod(whole, 2) != 0;
  return {(cycles - whole) * static_cast<double>(grid_), turned ? -1.0 : 1.0};
}

template <typename Real>
SpreadImage SpreadSynthesis<Real>::image(const Echoes& echoes) const {
  const bool moving = !echoes.doppler.empty();
  const Ping ping{echoes,
                  {head_.pulse, medium_.absorption, medium_.sound_speed, moving, cut_},
                  one_shape_ && !moving,
                  largest(echoes, medium_)};
  PulseReach reach = ping.reach;
  if (ping.planned) reach.half = half_;
  const TileLists lists(echoes, axis_, reach, tile_bins_);
  ComplexGrid pressure(head_.fan.beams(), axis_.bins);
  std::vector<double> stamped(lists.tiles()), heard(lists.tiles());
  // Each tile of bins belongs to one thread, which stamps its echoes in their order and forms its beams.
  parallel_for(lists.tiles(), threads_, [&](std::size_t t) {
    const std::size_t first = t * tile_bins_, last = std::min(first + tile_bins_, axis_.bins);
    const std::span<const std::uint32_t> list(lists.echo.data() + lists.begin[t], lists.begin[t + 1] - lists.begin[t]);
    if (list.empty()) {
      pressure.middleCols(first, last - first).setZero();
      return;
    }
    const FlushDenormals flush;
    Tile tile(tile_rows_ * stride_, tile_bins_ * grid_,
              sweep_ ? 2 * (tile_bins_ + 16) : std::max<std::size_t>(rows_.lanes, 8));
    for (std::span<const std::uint32_t> rest = list; !rest.empty();) {
      const auto some = rest.first(std::min(terms_at_once, rest.size()));
      stamped[t] += !ping.planned ? stamp_singly(ping, some, first, tile)
                    : sweep_      ? stamp_sweeps(ping, some, first, tile)
                                  : stamp(ping, some, first, tile);
      rest = rest.subspan(some.size());
      if (!rest.empty()) tile.put_aside(tile_rows_ * stride_);
    }
    tile.take_back();
    form_beams(tile, first, last, pressure);
    pressure.middleCols(first, last - first) *= ping.unit;
    heard[t] = (pressure.middleCols(first, last - first) / ping.unit).abs2().sum();
  });
  const double all = std::accumulate(stamped.begin(), stamped.end(), 0.0) * static_cast<double>(head_.fan.beams());
  const double share = all > 0 ? std::sqrt(std::accumulate(heard.begin(), heard.end(), 0.0) / all) : 1;
  return {std::move(pressure), share};
}

template <typename Real>
double SpreadSynthesis<Real>::stamp(const Ping& ping, std::span<const std::uint32_t> list, std::size_t first_bin,
                                    Tile& tile) const {
  std::array<std::uint32_t, batch> row, column;
  std::array<Real, batch> row_offset, column_offset, re, im;
  const kernels::Stamps<Real> stamps{row.data(),           column.data(), row_offset.data(),
                                     column_offset.data(), re.data(),     im.data()};
  const double half_width = 0.5 * static_cast<double>(kernel_.width());
  const double first_row = static_cast<double>(first_bin) - static_cast<double>(margin_);
  double power = 0;
  for (; !list.empty(); list = list.subspan(std::min(batch, list.size()))) {
    const std::size_t count = std::min(batch, list.size());
    for (std::size_t k = 0; k < count; ++k) {
      // Where the echo lies between grid steps and between bins, and what is left of it on its way.
      const std::uint32_t i = list[k];
      const double delay = ping.echoes.delay[i];
      const Place place = place_of(ping.echoes.u[i]);
      const double low_column = place.step - half_width, column_0 = std::ceil(low_column);
      const double low_row = (delay - half_ - axis_.start) / axis_.step, row_0 = std::ceil(low_row);
      const double gain = place.sign / ping.unit * std::exp(-medium_.absorption.a0 * medium_.sound_speed * delay);
      column[k] = static_cast<std::uint32_t>(column_0 + pad);
      column_offset[k] = static_cast<Real>(2 * (column_0 - low_column) - 1);
      row[k] = static_cast<std::uint32_t>(row_0 - first_row);
      row_offset[k] = static_cast<Real>(2 * (row_0 - low_row) - 1);
      re[k] = static_cast<Real>(gain * ping.echoes.amplitude[i].real());  // (E13)
      im[k] = static_cast<Real>(gain * ping.echoes.amplitude[i].imag());
      power += std::norm(gain * ping.echoes.amplitude[i]);
    }
    kernels::stamp(stamps, count, pieces(rows_), choice_.pulse_samples, pieces(columns_), tile.scratch.data(),
                   tile.re.data(), tile.im.data(), stride_);
  }
  return power * pulse_energy_;
}

template <typename Real>
double SpreadSynthesis<Real>::stamp_sweeps(const Ping& ping, std::span<const std::uint32_t> list, std::size_t first_bin,
                                           Tile& tile) const {
  const double half_width = 0.5 * static_cast<double>(kernel_.width()),
               pieces_in_all = static_cast<double>(rows_.pieces);
  const auto from = static_cast<double>(first_bin),
             to = static_cast<double>(std::min(first_bin + tile_bins_, axis_.bins));
  const EchoEnvelope envelope = echo_envelope(head_.pulse, {}, 0);
  double power = 0;
  for (const std::uint32_t i : list) {
    const double delay = ping.echoes.delay[i];
    const Place place = place_of(ping.echoes.u[i]);
    const double low_column = place.step - half_width, column_0 = std::ceil(low_column);
    const double low_row = (delay - half_ - axis_.start) / axis_.step, row_0 = std::ceil(low_row);
    const double piece_0 = std::max(0.0, from - row_0), piece_1 = std::min(pieces_in_all, to - row_0);
    if (!(piece_0 < piece_1)) continue;
    const std::complex<double> a = place.sign / ping.unit *
                                   std::exp(-medium_.absorption.a0 * medium_.sound_speed * delay) *
                                   ping.echoes.amplitude[i];
    const auto column_offset = static_cast<Real>(2 * (column_0 - low_column) - 1);
    const auto at = [&](double piece) {
      return static_cast<std::size_t>(row_0 + piece - from) * stride_ + static_cast<std::size_t>(column_0 + pad);
    };
    kernels::stamp_rows(static_cast<Real>(a.real()), static_cast<Real>(a.imag()),
                        static_cast<Real>(2 * (row_0 - low_row) - 1), column_offset, pieces(rows_), pieces(rows_im_),
                        static_cast<std::size_t>(piece_0), static_cast<std::size_t>(piece_1 - piece_0),
                        pieces(columns_), tile.scratch.data(), tile.re.data() + at(piece_0),
                        tile.im.data() + at(piece_0), stride_);
    power += std::norm(a) * (piece_1 - piece_0) / pieces_in_all;
    if (!sweep_ends_) continue;
    for (const double end : {0.0, pieces_in_all - 1}) {
      if (end < piece_0 || end >= piece_1) continue;
      const double t = axis_.start + (row_0 + end) * axis_.step - delay;
      const double level = std::copysign(half_ - axis_.step, t);
      const std::complex<double> g = a * (envelope.at(t) - envelope.at(level));  // (E13)
      const double g_re = g.real(), g_im = g.imag();
      kernels::stamp_pulse(&g_re, &g_im, 1, column_offset, pieces(columns_), tile.re.data() + at(end),
                           tile.im.data() + at(end), stride_);
    }
  }
  return power * pulse_energy_;
}

template <typename Real>
double SpreadSynthesis<Real>::stamp_singly(const Ping& ping, std::span<const std::uint32_t> list, std::size_t first_bin,
                                           Tile& tile) const {
  const double half_width = 0.5 * static_cast<double>(kernel_.width());
  const std::size_t last_bin = std::min(first_bin + tile_bins_, axis_.bins);
  double energy = 0;
  for (const std::uint32_t i : list) {
    const double delay = ping.echoes.delay[i];
    const Place place = place_of(ping.echoes.u[i]);
    const double low_column = place.step - half_width, column_0 = std::ceil(low_column);
    const EchoEnvelope envelope = shapes_.of(delay, ping.echoes.doppler_of(i));
    const auto [first, last] = axis_.around(delay, ping.reach.at(delay));
    const std::size_t from = std::max(first, first_bin), to = std::min(last, last_bin);
    tile.pulse_re.clear();
    tile.pulse_im.clear();
    for (std::size_t n = from; n < to; ++n) {
      const double t = axis_.start + static_cast<double>(n) * axis_.step - delay;
      const std::complex<double> g = place.sign / ping.unit * ping.echoes.amplitude[i] * envelope.at(t);  // (E13)
      tile.pulse_re.push_back(g.real());
      tile.pulse_im.push_back(g.imag());
      energy += std::norm(g);
    }
    const std::size_t start = (from - first_bin + margin_) * stride_ + static_cast<std::size_t>(column_0 + pad);
    kernels::stamp_pulse(tile.pulse_re.data(), tile.pulse_im.data(), tile.pulse_re.size(),
                         static_cast<Real>(2 * (column_0 - low_column) - 1), pieces(columns_), tile.re.data() + start,
                         tile.im.data() + start, stride_);
  }
  return energy;
}

template <typename Real>
void SpreadSynthesis<Real>::unfold(Tile& tile) const {
  // What was stamped beyond either end of the cycle belongs to the other end.
  const Real sign = half_place_ != 0 ? Real(-1) : Real(1);
  for (std::size_t n = margin_; n < margin_ + tile_bins_; ++n)
    for (Real* plane : {tile.re.data() + n * stride_, tile.im.data() + n * stride_})
      for (std::size_t j = 0; j < pad; ++j) {
        plane[grid_ + j] += sign * plane[j];
        plane[pad + j] += sign * plane[pad + grid_ + j];
      }
  // One row per grid step now, so that transforms and sums run along time.
  constexpr std::size_t square = 16;
  for (std::size_t n0 = 0; n0 < tile_bins_; n0 += square)
    for (std::size_t j = 0; j < grid_; ++j)
      for (std::size_t n = n0; n < n0 + square; ++n) {
        const std::size_t at = (margin_ + n) * stride_ + pad + j;
        const Real a = tile.re[at], b = tile.im[at], c = half_turn_[j].real(), d = half_turn_[j].imag();
        tile.grid[j * tile_bins_ + n] = Complex(a * c - b * d, a * d + b * c);
      }
}

template <typename Real>
void SpreadSynthesis<Real>::form_beams(Tile& tile, std::size_t first, std::size_t last, ComplexGrid& pressure) const {
  unfold(tile);
  to_elements_.run(tile.grid.data());
  for (std::size_t j = 0; j < grid_; ++j)
    for (std::size_t n = 0; n < tile_bins_; ++n) tile.grid[j * tile_bins_ + n] *= element_[j].real();
  to_beams_.run(tile.grid.data());
  for (std::size_t j = 0; j < grid_; ++j) {
    const Real c = half_turn_[j].real(), d = -half_turn_[j].imag();
    for (std::size_t n = 0; n < tile_bins_; ++n) {
      Complex& x = tile.grid[j * tile_bins_ + n];
      x = Complex(x.real() * c - x.imag() * d, x.real() * d + x.imag() * c);
    }
  }
  const std::size_t width = kernel_.width();
  const Real* rows = reinterpret_cast<const Real*>(tile.grid.data());
  for (Eigen::Index b = 0; b < pressure.rows(); ++b)
    kernels::interpolate(beam_weight_.data() + b * width, beam_row_.data() + b * width, width, rows, 2 * tile_bins_,
                         2 * (last - first), reinterpret_cast<double*>(&pressure(b, first)));
}

template class SpreadSynthesis<float>;
template class SpreadSynthesis<double>;

}  // namespace insonify
