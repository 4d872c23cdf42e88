// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/sound_speed_profile.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace insonify {

void require_valid(const SoundSpeedProfile& profile, const char* who) {
  const std::vector<double>&z = profile.depth, &c = profile.sound_speed;
  if (z.empty()) fail(ErrorKind::argument, who, ": sound speed profile has no entry, must have one at least");
  if (z.size() != c.size())
    fail(ErrorKind::argument, who, ": sound speed profile has ", z.size(), " depths, but ", c.size(), " sound speeds");
  for (std::size_t i = 0; i < z.size(); ++i) {
    if (!std::isfinite(z[i]))
      fail(ErrorKind::argument, who, ": sound speed profile: depth[", i, "] = ", z[i], " m, must be finite");
    if (i > 0 && !(z[i] > z[i - 1]))
      fail(ErrorKind::argument, who, ": sound speed profile: depth[", i, "] = ", z[i],
           " m, must be deeper than the entry before it, ", z[i - 1], " m");
    if (!(c[i] >= 1300 && c[i] <= 1700))
      fail(ErrorKind::argument, who, ": sound speed profile: sound_speed[", i, "] = ", c[i],
           " m/s, must be within 1300 and 1700 m/s");
  }
}

double sound_speed_at(const SoundSpeedProfile& profile, double depth) {
  const std::vector<double>&z = profile.depth, &c = profile.sound_speed;
  const auto below = static_cast<std::size_t>(std::upper_bound(z.begin(), z.end(), depth) - z.begin());
  if (below == 0) return c.front();
  if (below == z.size()) return c.back();
  const double share = (depth - z[below - 1]) / (z[below] - z[below - 1]);
  return c[below - 1] + share * (c[below] - c[below - 1]);  // (E42)
}

}  // namespace insonify
