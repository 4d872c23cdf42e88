// SPDX-License-Identifier: BSD-3-Clause
#include <numbers>

#include "beamforming/display/cell_edges_internal.hpp"
#include "beamforming/display/display_plan_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr double steps_per_deviation = 64;  // lines between them are within 1e-5
constexpr double most_entries = 65536;
constexpr double least_period = 0.125;    // deviations between samples from which on these differ from an integral
constexpr double least_deviation = 1e-9;  // smallest deviation of a pulse [m]

double density(double x) { return std::abs(x) < reach_of_pulse ? std::exp(-0.5 * x * x) / std::sqrt(2 * pi) : 0; }
double below(double x) {
  if (std::abs(x) >= reach_of_pulse) return x > 0;
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

}  // namespace

CellEdges::CellEdges(double deviation, double first_range, double sample_length) : first_range_(first_range) {
  const double unit = std::max(deviation, least_deviation);
  per_deviation_ = 1 / unit;
  sample_length_ = sample_length > least_period * unit ? sample_length : 0;
  period_ = sample_length_ > 0 ? sample_length_ / unit : 1;
  per_period_ = 1 / period_;
  reach_ = reach_of_pulse * unit + 0.5 * sample_length_;
  low_ = -reach_of_pulse, high_ = reach_of_pulse + period_;
  const auto steps = static_cast<std::size_t>(std::min(most_entries, std::ceil((high_ - low_) * steps_per_deviation)));
  per_step_ = static_cast<double>(steps) / (high_ - low_);
  for (std::size_t n = 0; n <= steps; ++n) {
    const double x = low_ + static_cast<double>(n) / per_step_;
    Entry share, sum;  // (E227)
    if (sample_length_ == 0) {
      share.before = below(x), sum.before = x * below(x) + density(x);
    } else {
      share.here = period_ * density(x), sum.here = period_ * below(x);
      for (double y = x - period_; y > -reach_of_pulse; y -= period_)
        share.before += period_ * density(y), sum.before += period_ * below(y);
    }
    share_.push_back(share), sum_.push_back(sum);
  }
}

double CellEdges::between(const std::vector<Entry>& table, double x, double part) const {
  const double position = (x - low_) * per_step_;
  const auto left = std::min(static_cast<std::size_t>(position), table.size() - 2);
  const Entry &a = table[left], &b = table[left + 1];
  const double from = a.before + part * a.here, to = b.before + part * b.here;
  return from + (position - static_cast<double>(left)) * (to - from);
}

double CellEdges::share_at(double x, double part) const {
  if (!(x > low_)) return 0;
  return between(share_, x > high_ ? x - std::ceil((x - high_) * per_period_) * period_ : x, part);
}

double CellEdges::sum_at(double x, double part) const {
  if (!(x > low_)) return 0;
  const double beyond = x > high_ ? std::ceil((x - high_) * per_period_) * period_ : 0;
  return between(sum_, x - beyond, part) + beyond;
}

std::size_t CellEdges::parts_between(const Edge& near, const Edge& far, double range, double half_depth,
                                     double per_metre, std::array<Part, most_parts>& parts) const {
  const double begin = near.range - range, end = far.range - range;
  const double low = std::clamp(begin - reach_, -half_depth, half_depth),
               high = std::clamp(end + reach_, -half_depth, half_depth);
  parts[0] = {0.5 * (low + high), 0.5 * (high - low), 1};
  if (begin + reach_ < -half_depth && half_depth < end - reach_) return 1;
  const double wanted = std::clamp(std::ceil((high - low) * per_metre), 1.0, static_cast<double>(most_parts));
  const auto count = static_cast<std::size_t>(wanted);
  const double half = 0.5 * (high - low) / wanted;
  std::array<double, most_parts> heard;
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double middle = low + static_cast<double>(2 * k + 1) * half;
    heard[k] =
        share_at((end - middle) * per_deviation_, far.part) - share_at((begin - middle) * per_deviation_, near.part);
    sum += heard[k];
  }
  if (!(sum > 0)) return 1;
  for (std::size_t k = 0; k < count; ++k)
    parts[k] = {low + static_cast<double>(2 * k + 1) * half, half, heard[k] / sum};
  return count;
}

}  // namespace insonify
