// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "returns/surfel_arrivals_internal.hpp"
#include "sonar/pulse.hpp"

namespace insonify {

DelayBins::DelayBins(const SonarHead& head, const Medium& medium, double floor_db, double doppler)
    : start(2 * head.gate.centre(0) / medium.sound_speed),
      step(2 * head.gate.bin_size / medium.sound_speed),
      half(pulse_half_length(head.pulse, amplitude_from_db(floor_db))),
      bins(head.gate.bins()) {
  // The Doppler shift displaces the peak of a sweep's echo.
  half += std::max(std::abs(doppler_delay(head.pulse, doppler)), std::abs(doppler_delay(head.pulse, -doppler)));
  length = static_cast<std::size_t>(std::min(2 * half / step + 1, static_cast<double>(bins)));
}

void require_arrivals(const SceneCloud& scene, const SurfelEchoes& block, const char* who) {
  const std::size_t n = block.echoes.size();
  if (block.surfel.size() != n || block.echoes.v.size() != n || !(block.legs.empty() || block.legs.size() == n) ||
      !(block.before.empty() || block.before.size() == n))
    fail(ErrorKind::argument, who, ": ", n, " echoes, but ", block.surfel.size(), " surfels, ", block.echoes.v.size(),
         " directions upwards, ", block.legs.size(), " pairs of legs and ", block.before.size(),
         " surfels before; give one of each (no legs: all direct; none before: all by one surface)");
  for (std::size_t i = 0; i < n; ++i) {
    if (block.surfel[i] >= scene.size())
      fail(ErrorKind::argument, who, ": surfel[", i, "] = ", block.surfel[i], ", but the scene has ", scene.size());
    const Echoes& e = block.echoes;
    if (!std::isfinite(e.delay[i] + e.u[i] + e.v[i] + std::norm(e.amplitude[i]) + e.doppler_of(i)))
      fail(ErrorKind::argument, who, ": echo ", i, " is not finite (delay ", e.delay[i], " s, amplitude ",
           std::abs(e.amplitude[i]), " Pa)");
  }
}

std::vector<Arrival> sorted_arrivals(std::span<const SurfelEchoes> blocks, const DelayBins& axis) {
  std::vector<Arrival> arrivals;
  std::size_t total = 0;
  for (const SurfelEchoes& h : blocks) total += h.echoes.size();
  arrivals.reserve(total);
  for (const SurfelEchoes& h : blocks)
    for (std::size_t i = 0; i < h.echoes.size(); ++i) {
      const Echoes& e = h.echoes;
      if (!axis.reaches(e.delay[i])) continue;
      arrivals.push_back({e.delay[i], e.u[i], e.v[i], std::norm(e.amplitude[i]), e.doppler_of(i), h.surfel[i],
                          h.legs.empty() ? LegPair{} : h.legs[i], h.before.empty() ? Contributors::none : h.before[i]});
    }
  const auto before = [](const Arrival& a, const Arrival& b) { return a.key() < b.key(); };
  if (!std::is_sorted(arrivals.begin(), arrivals.end(), before))
    std::stable_sort(arrivals.begin(), arrivals.end(), before);
  return arrivals;
}

std::vector<Group> groups_of(const std::vector<Arrival>& arrivals) {
  std::vector<Group> groups;
  double strongest = 0;
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    const Arrival& a = arrivals[i];
    const bool is_new = i == 0 || arrivals[i - 1].key() != a.key();
    if (is_new) groups.push_back({a.surfel, a.legs, 0, i, i, a.u, a.u}), strongest = -1;
    Group& group = groups.back();
    group.last = i + 1;
    group.u_low = std::min(group.u_low, a.u);
    group.u_high = std::max(group.u_high, a.u);
    if (a.power > strongest) {
      strongest = a.power;
      group.before = a.before;
      group.elevation = static_cast<float>(std::asin(std::clamp(a.v, -1.0, 1.0)));
    }
  }
  return groups;
}

}  // namespace insonify
