#include <algorithm>
#include <cmath>

#include "acoustics/refraction_table_internal.hpp"

namespace insonify {
namespace {

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
  const auto place = std::lower_bound(depth_.begin(), depth_.end(), head_depth) - depth_.begin();
  const auto head = static_cast<std::size_t>(place);
  if (head == depth_.size() || depth_[head] != head_depth) {
    depth_.insert(depth_.begin() + place, head_depth);
    speed_.insert(speed_.begin() + place, head_speed_);
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

SeenPoint FirstOrderRays::see(double depth, double horizontal) const {
  const double height = depth - head_depth_, distance = std::hypot(height, horizontal);
  if (distance == 0) return {0, 1, 0};

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
  return {head_speed_ * distance * slowness, across / norm, -down / norm};
}

}  // namespace insonify
