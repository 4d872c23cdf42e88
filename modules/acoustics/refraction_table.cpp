// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "acoustics/ray_families_internal.hpp"
#include "acoustics/refraction_table_internal.hpp"
#include "acoustics/shoot_ray.hpp"
#include "core/parallel.hpp"

namespace insonify {
namespace {

constexpr std::size_t columns = 32;  ///< columns of patches over distance; about as many rows over depth
/// Errors tolerated in the middle of a patch's quarters: a quarter of what is promised, since other points may be
/// worse.
constexpr double tolerated_range = 0.25e-6, tolerated_angle = 2.5e-6, tolerated_gain = 1.5e-3, tolerated_arrival = 1e-3;
/// Largest number of profile entries to which rows are fitted; finer layers are smooth enough.
constexpr std::size_t most_fitted_entries = 150;
/// A patch is worth quartering if so many points fall in it.
constexpr std::size_t points_to_quarter = 100;
constexpr int most_levels = 4;
/// Edges of rows about the head's depth [m]: flat rays bend through thin layers there.
constexpr double head_rows[] = {1e-6, 0.01, 0.1};

constexpr double quarter_down[] = {0.25, 0.25, 0.75, 0.75}, quarter_out[] = {0.25, 0.75, 0.25, 0.75};

std::array<double, 3> parabolas(double x) { return {(1 - x) * (1 - 2 * x), 4 * x * (1 - x), x * (2 * x - 1)}; }

// Rows end at the profile's entries: inside a patch the rest is smooth unless a ray comes to turn there. First order
// jumps at the head's depth if the gradient does: the innermost row holds that.
std::vector<double> rows_of(const DepthBox& box, double head_depth, const std::vector<double>& entries) {
  std::vector<double> stations{box.min_depth, box.max_depth};
  const auto first = std::upper_bound(entries.begin(), entries.end(), box.min_depth);
  const auto last = std::max(first, std::lower_bound(entries.begin(), entries.end(), box.max_depth));
  if (static_cast<std::size_t>(last - first) <= most_fitted_entries) stations.insert(stations.end(), first, last);
  for (const double half : head_rows)
    for (const double edge : {head_depth - half, head_depth + half})
      if (edge > box.min_depth && edge < box.max_depth) stations.push_back(edge);
  std::sort(stations.begin(), stations.end());

  std::vector<double> rows{box.min_depth};
  const double largest = (box.max_depth - box.min_depth) / static_cast<double>(columns);
  for (std::size_t i = 1; i < stations.size(); ++i) {
    if (i + 1 < stations.size() && stations[i] == rows.back()) continue;
    const double height = stations[i] - stations[i - 1];
    const double shares = largest > 0 ? std::max(1.0, std::ceil(height / largest - 1e-9)) : 1;
    for (double share = 1; share < shares; ++share) rows.push_back(stations[i - 1] + height * share / shares);
    rows.push_back(stations[i]);
  }
  return rows;
}

// 1 - log(1 + x) / x.
double log_lag(double x) {
  if (std::abs(x) > 0.01) return 1 - std::log1p(x) / x;
  double sum = 0;
  for (int n = 8; n >= 2; --n) sum = x * ((n % 2 == 0 ? 1.0 : -1.0) / n + sum);
  return sum;
}

}  // namespace

FirstOrderRays::FirstOrderRays(const SoundSpeedProfile& profile, double head_depth)
    : head_depth_(head_depth),
      head_speed_(sound_speed_at(profile, head_depth)),
      depth_(profile.depth),
      speed_(profile.sound_speed) {
  const auto above = std::lower_bound(depth_.begin(), depth_.end(), head_depth) - depth_.begin();
  const auto head = static_cast<std::size_t>(above);
  if (head == depth_.size() || depth_[head] != head_depth) {
    depth_.insert(depth_.begin() + above, head_depth);
    speed_.insert(speed_.begin() + above, head_speed_);
  }

  // Outwards from the head, so that nothing cancels close to it.
  lead_.resize(depth_.size());
  const auto step = [&](std::size_t from, std::size_t to) {
    const double height = depth_[to] - depth_[from];
    lead_[to] = lead_[from] + lead(height, speed_[from], (speed_[to] - speed_[from]) / height);
  };
  for (std::size_t i = head + 1; i < depth_.size(); ++i) step(i - 1, i);
  for (std::size_t i = head; i > 0; --i) step(i, i - 1);
}

// Integral of 1/c_head - 1/c over `height` (signed) from where sound speed is `speed`.
double FirstOrderRays::lead(double height, double speed, double gradient) const {
  return height / speed * ((speed - head_speed_) / head_speed_ + log_lag(gradient * height / speed));
}

ApparentPosition FirstOrderRays::apparent(double depth, double horizontal) const {
  const double height = depth - head_depth_, distance = std::hypot(height, horizontal);
  if (distance == 0) return {0, 1, 0, 0, 0};

  // Reckoned from the end of the layer that is nearer to the head.
  const std::size_t last = depth_.size() - 1;
  const auto below = static_cast<std::size_t>(std::upper_bound(depth_.begin(), depth_.end(), depth) - depth_.begin());
  const bool outside = below == 0 || below > last;
  const std::size_t from = below == 0 ? 0 : below > last ? last : height > 0 ? below - 1 : below;
  const double gradient = outside ? 0 : (speed_[below] - speed_[below - 1]) / (depth_[below] - depth_[below - 1]);
  const double lead_here = lead_[from] + lead(depth - depth_[from], speed_[from], gradient);

  // Delay = distance x mean slowness; its gradient at the head is the slowness vector there. (E43)
  const double tilt = height != 0 ? lead_here / height / height : 0.5 * gradient / (head_speed_ * head_speed_);
  const double slowness = 1 / head_speed_ - tilt * height;
  const double across = horizontal / distance * slowness, down = height / distance * slowness + distance * tilt;
  const double norm = std::hypot(across, down);
  return {head_speed_ * distance * slowness, across / norm, -down / norm, 0, std::atan2(-height, horizontal)};
}

RefractionTable::Frame RefractionTable::Frame::quarter(std::size_t q) const {
  const double h = 0.5 * height, w = 0.5 * width;
  return {q / 2 == 0 ? depth : depth + h, q % 2 == 0 ? horizontal : horizontal + w, h, w};
}

RefractionTable::RefractionTable(const SoundSpeedProfile& profile, double head_depth, const DepthBox& box, int threads)
    : profile_(profile),
      head_depth_(head_depth),
      head_speed_(sound_speed_at(profile, head_depth)),
      first_order_(profile, head_depth) {
  // A table pays only if it needs far fewer rays than there are points.
  if (box.points >= 8 * columns * columns) fill(box, threads);
}

void RefractionTable::fill(const DepthBox& box, int threads) {
  rows_ = rows_of(box, head_depth_, profile_.depth);
  min_horizontal_ = box.min_horizontal;
  width_ = (box.max_horizontal - box.min_horizontal) / static_cast<double>(columns);
  const std::size_t rows = rows_.size() - 1, across = 2 * columns + 1;
  int levels = 0;
  for (std::size_t points = box.points / (rows * columns); points >= points_to_quarter && levels < most_levels;
       points /= 4)
    ++levels;

  // Neighbouring patches share the rests along their edge.
  const auto frame = [&](std::size_t row, std::size_t column) {
    return Frame{rows_[row], min_horizontal_ + static_cast<double>(column) * width_, rows_[row + 1] - rows_[row],
                 width_};
  };
  std::vector<Rest> rests((2 * rows + 1) * across);
  parallel_for(2 * rows + 1, threads, [&](std::size_t i) {
    const std::size_t row = std::min(i / 2, rows - 1);
    for (std::size_t j = 0; j < across; ++j)
      rests[i * across + j] = rest(frame(row, 0), 0.5 * static_cast<double>(i - 2 * row), 0.5 * static_cast<double>(j));
  });
  patches_.resize(rows * columns);
  parallel_for(patches_.size(), threads, [&](std::size_t p) {
    const std::size_t row = p / columns, column = p % columns;
    for (std::size_t i = 0; i < 9; ++i) patches_[p].rest[i] = rests[(2 * row + i / 3) * across + 2 * column + i % 3];
    decide(patches_[p], frame(row, column), levels);
  });
}

std::optional<ApparentPosition> RefractionTable::solve(double depth, double horizontal) const {
  const auto ray = eigenray_between(profile_, head_depth_, depth, horizontal);
  if (!ray) return std::nullopt;
  const double range = head_speed_ * ray->travel_time;
  const RayTube tube = shoot_tube(profile_, head_depth_, ray->elevation, ray->travel_time);
  const double focusing = range > 0 ? range * range * tube.spreading(head_speed_, sound_speed_at(profile_, depth)) : 1;
  return ApparentPosition{range, std::cos(ray->elevation), std::sin(ray->elevation),
                          std::log(std::min(focusing, most_focusing)), tube.end.elevation};
}

RefractionTable::Rest RefractionTable::rest(const Frame& frame, double down, double out) const {
  const double depth = frame.depth + down * frame.height, horizontal = frame.horizontal + out * frame.width;
  const auto seen = solve(depth, horizontal);
  if (!seen) return {};
  const ApparentPosition guess = first_order_.apparent(depth, horizontal);
  const double sine = seen->up * guess.horizontal - seen->horizontal * guess.up;
  const double cosine = seen->horizontal * guess.horizontal + seen->up * guess.up;
  return {seen->range - guess.range, std::atan2(sine, cosine), seen->gain, seen->arrival - guess.arrival, true};
}

RefractionTable::Rest RefractionTable::between(const Patch& patch, double down, double out) {
  const auto over_rows = parabolas(down), over_columns = parabolas(out);
  Rest sum{0, 0, 0, 0, true};
  for (std::size_t i = 0; i < 9; ++i) {
    const double weight = over_rows[i / 3] * over_columns[i % 3];
    sum.range += weight * patch.rest[i].range;
    sum.angle += weight * patch.rest[i].angle;
    sum.gain += weight * patch.rest[i].gain;
    sum.arrival += weight * patch.rest[i].arrival;
    sum.reachable = sum.reachable && patch.rest[i].reachable;
  }
  return sum;
}

void RefractionTable::decide(Patch& patch, const Frame& frame, int levels) const {
  bool any_reachable = false, all_close = true;
  for (const Rest& r : patch.rest) any_reachable = any_reachable || r.reachable;
  std::array<Rest, 4> middles;
  for (std::size_t q = 0; q < 4; ++q) {
    middles[q] = rest(frame, quarter_down[q], quarter_out[q]);
    const Rest guess = between(patch, quarter_down[q], quarter_out[q]);
    any_reachable = any_reachable || middles[q].reachable;
    all_close = all_close && middles[q].reachable && guess.reachable &&
                std::abs(guess.range - middles[q].range) <= tolerated_range &&
                std::abs(guess.angle - middles[q].angle) <= tolerated_angle &&
                std::abs(guess.gain - middles[q].gain) <= tolerated_gain &&
                std::abs(guess.arrival - middles[q].arrival) <= tolerated_arrival;
  }
  patch.use = !any_reachable ? Use::shadow : all_close ? Use::interpolate : levels > 0 ? Use::quarter : Use::solve;
  if (patch.use == Use::quarter) quarter(patch, frame, middles, levels - 1);
}

void RefractionTable::quarter(Patch& patch, const Frame& frame, const std::array<Rest, 4>& middles, int levels) const {
  patch.quarters = std::make_unique<std::array<Patch, 4>>();
  for (std::size_t q = 0; q < 4; ++q) {
    Patch& share = (*patch.quarters)[q];
    const Frame part_frame = frame.quarter(q);
    // Corners and middle are known, the middles of the edges are new.
    for (std::size_t i = 0; i < 9; ++i) {
      const std::size_t row = i / 3, column = i % 3;
      share.rest[i] = i == 4 ? middles[q]
                      : i % 2 == 0
                          ? patch.rest[3 * (q / 2 + row / 2) + q % 2 + column / 2]
                          : rest(part_frame, 0.5 * static_cast<double>(row), 0.5 * static_cast<double>(column));
    }
    decide(share, part_frame, levels);
  }
}

std::optional<ApparentPosition> RefractionTable::apparent(double depth, double horizontal) const {
  if (rows_.empty()) return solve(depth, horizontal);
  const auto below = static_cast<std::size_t>(std::upper_bound(rows_.begin(), rows_.end(), depth) - rows_.begin());
  const std::size_t row = std::clamp<std::size_t>(below, 1, rows_.size() - 1) - 1;
  const double height = rows_[row + 1] - rows_[row];
  const double across = width_ > 0 ? std::max((horizontal - min_horizontal_) / width_, 0.0) : 0;
  const std::size_t column = std::min(static_cast<std::size_t>(across), columns - 1);
  double down = height > 0 ? (depth - rows_[row]) / height : 0, out = across - static_cast<double>(column);

  const Patch* patch = &patches_[row * columns + column];
  while (patch->use == Use::quarter) {
    const std::size_t lower = down >= 0.5, farther = out >= 0.5;
    down = 2 * down - static_cast<double>(lower);
    out = 2 * out - static_cast<double>(farther);
    patch = &(*patch->quarters)[2 * lower + farther];
  }
  if (patch->use == Use::shadow) return std::nullopt;
  if (patch->use == Use::solve) return solve(depth, horizontal);
  const Rest rest = between(*patch, down, out);
  const ApparentPosition guess = first_order_.apparent(depth, horizontal);
  const double c = std::cos(rest.angle), s = std::sin(rest.angle);
  return ApparentPosition{guess.range + rest.range, c * guess.horizontal - s * guess.up,
                          c * guess.up + s * guess.horizontal, rest.gain, guess.arrival + rest.arrival};
}

}  // namespace insonify
