// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "acoustics/multipath_echoes.hpp"
#include "beamforming/engine.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "simulate/cell_sum_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t patches_at_once = 4096;
constexpr double least_cosine = 1e-3;
constexpr double spread_of_disc = 0.866;  // half width of the box with the variance of a disc, in its radius

}  // namespace

void CellSum::add_direct(const Scatterers& patches, const Echoes& echoes) {
  report_.push_back({"direct", echoes.size()});
  const std::size_t before = all_.id.size();
  append(all_.echoes, echoes);
  all_.id.insert(all_.id.end(), patches.id.begin(), patches.id.end());
  all_.power.resize(all_.id.size(), 0), all_.depth.resize(all_.id.size(), 0), all_.width.resize(all_.id.size(), 0);
  parallel_blocks(patches.size(), patches_at_once, ping_.options.threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      // The first patch of a surfel, which is its middle, has the energy of all.
      const std::uint32_t surfel = patches.surfel[i];
      if (i > 0 && patches.surfel[i - 1] == surfel) continue;
      double power = 0, area = 0;
      for (std::size_t k = i; k < patches.size() && patches.surfel[k] == surfel; ++k)
        power += std::norm(echoes.amplitude[k]), area += static_cast<double>(patches.projected_area[k]);
      const double cosine = std::max(static_cast<double>(patches.cos_incidence[i]), least_cosine);
      const double radius = std::sqrt(area / cosine / pi), sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
      all_.power[before + i] = power;
      all_.depth[before + i] = static_cast<float>(spread_of_disc * radius * sine);
      all_.width[before + i] = static_cast<float>(spread_of_disc * radius / patches.range[i]);
    }
  });
}

void CellSum::add_reverberation(const std::string& name, Echoes echoes, std::size_t number) {
  report_.push_back({name, echoes.size()});
  // Numbers of their own, far from those of surfels.
  const std::uint64_t first = (0xffff0000 + number) << 32;
  for (std::size_t i = 0; i < echoes.size(); ++i)
    all_.id.push_back((first + i) ^ (static_cast<std::uint64_t>(ping_.event.number) * 0x9e3779b97f4a7c15));
  for (const std::complex<double>& amplitude : echoes.amplitude) all_.power.push_back(std::norm(amplitude));
  append(all_.echoes, echoes);
  all_.depth.resize(all_.id.size(), 0), all_.width.resize(all_.id.size(), 0);
}

void CellSum::finish(SimulatedPing& result) {
  const SimulationOptions& o = ping_.options;
  CellOptions options;
  options.seed = o.seed, options.ping = ping_.event.number, options.threads = o.threads;
  options.speckle = !gives_power(o.synthesis.method);
  if (o.effects.noise) {
    options.element_noise_db = ping_.element_noise_db;
    report_.push_back({"noise", 0});
  }
  const Grid<double> cells = synthesizers_.cells_of(ping_.head, ping_.sent.medium)->cells(all_, {}, options);
  result.ping =
      ping_of(ping_, ping_.head.gate, stored_pressure(cells.sqrt().cast<std::complex<double>>(), "PingSimulator"));
  result.ping.expected_level = !options.speckle;
  result.ping.display_cells = true;
  result.report.layers = std::move(report_);
}

}  // namespace insonify
