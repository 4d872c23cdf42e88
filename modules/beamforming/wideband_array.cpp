#include <algorithm>
#include <utility>

#include "beamforming/wideband_array_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t pad = 16;  // silent rows to either side, at least as many as a filter is long
constexpr int steep_order = 4;   // from here on powers of S must not grow beside the directions in use
using kernels::lines_at_once;
using kernels::SpectrumChunk;

float inverse_factorial(int n) {
  float factor = 1;
  for (int j = 2; j <= n; ++j) factor /= static_cast<float>(j);
  return factor;
}

}  // namespace

WidebandArray::WidebandArray(const WidebandPlan& plan) : plan_(plan), phase_(lines_at_once), shift_(plan.rows()) {
  const std::size_t plane = (plan.rows() + 2 * pad) * lines_at_once;
  SpectrumChunk* chunks[] = {&echo_,   &received_, &beam_,   &echo_2_, &received_2_,
                             &beam_2_, &arriving_, &undone_, &spare_};
  room_.assign(2 * std::size(chunks) * plane, 0);
  float* next = room_.data() + pad * lines_at_once;
  for (SpectrumChunk* chunk : chunks) {
    *chunk = {next, next + plane};
    next += 2 * plane;
  }
}

void WidebandArray::apply(std::size_t part, double curvature, const WidebandEffort& effort, WidebandSpectrum& echoes,
                          WidebandSpectrum* excess) {
  response_ = plan_.response[part].data();
  tap_ = effort.order < steep_order ? &plan_.tap : &plan_.steep_tap;
  for (std::size_t r = 0; r < plan_.rows(); ++r) {
    const double k = static_cast<double>(r) - static_cast<double>(plan_.most);
    shift_[r] = static_cast<float>(pi * k / plan_.period * curvature * curvature);
  }
  const std::size_t top = plan_.top_line();
  for (std::size_t l = 0; l < plan_.fine; l += lines_at_once) {
    if (l > top && l + lines_at_once + top <= plan_.fine) continue;
    for (std::size_t c = 0; c < lines_at_once; ++c) phase_[c] = plan_.bend[l + c] * static_cast<float>(curvature);
    apply(l, effort, echoes, excess);
  }
}

void WidebandArray::apply(std::size_t first_line, const WidebandEffort& effort, WidebandSpectrum& echoes,
                          WidebandSpectrum* excess) {
  const int order = effort.order;
  const std::size_t plane = plan_.rows() * lines_at_once;
  line_ = first_line;
  read(echoes, echo_);
  copy(echo_, received_);
  clear(beam_);
  if (effort.cubic) begin_cubic();
  if (effort.cubic && order == 0) add_cubic(nullptr, arriving_, received_);
  form(order, order, received_, beam_);
  if (excess) {
    read(*excess, echo_2_);
    filter(plan_.whole_tap, echo_2_);
    copy(echo_, received_2_);
    clear(beam_2_);
    form(order, order - 1, received_2_, beam_2_);
  }
  for (int n = 1; n <= order; ++n) {
    filter(*tap_, echo_);
    bend(n, n, echo_, received_);
    if (excess) add_second_field(n, order);
    if (effort.cubic && n == order) add_cubic(nullptr, arriving_, received_);
    filter(*tap_, beam_);
    form(order - n, order - n, received_, beam_);
  }
  if (effort.cubic) {
    for (std::size_t k = 0; k < plane; ++k) beam_.re[k] -= undone_.re[k];
    for (std::size_t k = 0; k < plane; ++k) beam_.im[k] -= undone_.im[k];
  }
  write(beam_, echoes);
  if (!excess) return;
  filter(plan_.whole_tap, beam_2_);
  write(beam_2_, *excess);
}

void WidebandArray::add_second_field(int n, int order) {
  bend(n, n - 1, echo_2_, received_);
  bend(n, n, echo_, received_2_);
  if (n == order) return;
  filter(*tap_, echo_2_);
  filter(*tap_, beam_2_);
  form(order - n, order - n - 1, received_2_, beam_2_);
}

/// The third order of what arrives, and of what beams undo, each with nothing else.
void WidebandArray::begin_cubic() {
  const auto odd = [this](SpectrumChunk from, SpectrumChunk to) {
    kernels::filter_rows_odd(plan_.cubic_tap.data(), plan_.cubic_tap.size() - 1, plan_.rows(), from, to);
  };
  odd(echo_, arriving_);
  clear(spare_);
  add_cubic(response_ + line_, echo_, spare_);
  odd(spare_, undone_);
}

void WidebandArray::add_cubic(const float* weight, SpectrumChunk from, SpectrumChunk to) const {
  const kernels::BentLines bent{phase_.data(), plan_.squared_wavelength.data() + line_, plan_.place_end.data() + line_};
  kernels::add_cubic(shift_.data(), static_cast<float>(plan_.cubic), plan_.rows(), plan_.place.data(), bent, weight,
                     plan_.fine_row, from, to);
}

void WidebandArray::bend(int n, int factorial_of, SpectrumChunk from, SpectrumChunk to) const {
  const kernels::BentLines bent{phase_.data(), plan_.squared_wavelength.data() + line_, plan_.place_end.data() + line_};
  kernels::add_power(n, inverse_factorial(factorial_of), plan_.rows(), plan_.place.data(), bent, from, to);
}

void WidebandArray::form(int n, int factorial_of, SpectrumChunk from, SpectrumChunk to) const {
  const kernels::BentLines bent{phase_.data(), plan_.squared_wavelength.data() + line_, plan_.place_end.data() + line_};
  kernels::add_weighted_power(n, inverse_factorial(factorial_of), plan_.rows(), plan_.place.data(), bent,
                              response_ + line_, plan_.fine_row, from, to);
}

void WidebandArray::filter(const std::vector<float>& tap, SpectrumChunk& chunk) {
  kernels::filter_rows(tap.data(), tap.size() - 1, plan_.rows(), chunk, spare_);
  std::swap(chunk, spare_);
}

void WidebandArray::copy(SpectrumChunk from, SpectrumChunk to) const {
  std::copy_n(from.re, plan_.rows() * lines_at_once, to.re);
  std::copy_n(from.im, plan_.rows() * lines_at_once, to.im);
}

void WidebandArray::clear(SpectrumChunk chunk) const {
  std::fill_n(chunk.re, plan_.rows() * lines_at_once, 0.0F);
  std::fill_n(chunk.im, plan_.rows() * lines_at_once, 0.0F);
}

void WidebandArray::read(const WidebandSpectrum& spectrum, SpectrumChunk to) const {
  for (std::size_t r = 0; r < plan_.rows(); ++r)
    kernels::split_row(reinterpret_cast<const float*>(spectrum.data() + r * plan_.fine_row + line_),
                       plan_.row_factor[r], to.re + r * lines_at_once, to.im + r * lines_at_once);
}

void WidebandArray::write(SpectrumChunk from, WidebandSpectrum& spectrum) const {
  for (std::size_t r = 0; r < plan_.rows(); ++r)
    kernels::merge_row(from.re + r * lines_at_once, from.im + r * lines_at_once, plan_.row_factor[r],
                       reinterpret_cast<float*>(spectrum.data() + r * plan_.fine_row + line_));
}

}  // namespace insonify
