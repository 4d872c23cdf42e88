// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "acoustics/direct_echoes.hpp"
#include "acoustics/reverberation_cells_internal.hpp"
#include "core/error.hpp"
#include "core/require.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr double two_way_floor_db = -80;  // two-way
constexpr std::size_t steps = 1 << 14;    // of the elevation law
constexpr double most_cells = 1 << 27;

}  // namespace

double ReverberationCells::begin(std::size_t slice) const {
  return std::max(nearest, static_cast<double>(first + slice) * length);
}

ReverberationCells reverberation_cells(const BeamFan& fan, const RangeGate& gate, const Transmission& transmission,
                                       const ReverberationOptions& options, const char* who) {
  require_valid(fan, who);
  require_valid(gate, who);
  require_valid(transmission.pulse, who);
  require_valid(transmission.medium, who);
  require(options.cells_per_resolution > 0 && std::isfinite(options.cells_per_resolution), who,
          "options.cells_per_resolution", options.cells_per_resolution, "", "finite and > 0");
  require(options.azimuth_margin >= 0 && std::isfinite(options.azimuth_margin), who, "options.azimuth_margin",
          options.azimuth_margin, "", "finite and >= 0");
  const double c = transmission.medium.sound_speed;
  const double margin = 0.5 * c * pulse_half_length(transmission.pulse, pulse_floor);
  ReverberationCells cells;
  cells.length = range_resolution(transmission.pulse, c) / options.cells_per_resolution;
  cells.nearest = std::max(gate.min_range - margin, 0.5 * gate.min_range);
  const double first = std::floor(cells.nearest / cells.length);
  const double last = std::ceil((gate.max_range + margin) / cells.length);
  cells.sector = insonified_sector(fan, pi, options.azimuth_margin);
  cells.azimuths = 2 * pi * options.cells_per_resolution / fan.beam_width;
  if (!(last < 1e15)) fail(ErrorKind::argument, who, ": gate.max_range = ", gate.max_range, " m is too many cells");
  cells.first = static_cast<std::size_t>(first);
  cells.slices = static_cast<std::size_t>(last - first);
  return cells;
}

void require_few(double directions, const ReverberationCells& cells, const char* who) {
  const double count = directions * static_cast<double>(cells.slices);
  if (!(count <= most_cells))
    fail(ErrorKind::argument, who, ": ", cells.slices, " slices of range x ", directions, " directions make ", count,
         " cells, must be at most 2^27; lower cells_per_resolution or max_range");
}

std::complex<double> cell_amplitude(const EchoOptions& echo_options, RandomStage stage, const RandomCounter& counter) {
  if (echo_options.amplitude == SurfaceAmplitude::mean_power) return 1;
  return random_complex_normal(echo_options.seed, stage, counter);
}

ElevationLaw::ElevationLaw(const BeamFan& fan, const EchoOptions& echo_options) : low_(-pi / 2), high_(pi / 2) {
  if (echo_options.elevation_width > 0) {
    const double half =
        elevation_half_extent(echo_options.elevation_shape, echo_options.elevation_width, two_way_floor_db);
    low_ = std::max(low_, echo_options.elevation_centre - half);
    high_ = std::min(high_, echo_options.elevation_centre + half);
  } else {
    // The rows of the fan have their own patterns, to be applied later.
    const Sector sector = insonified_sector(fan, 3 * fan.elevation_width);
    low_ = sector.min_elevation;
    high_ = sector.max_elevation;
  }
  const double step = (high_ - low_) / steps;
  sum_.assign(steps + 1, 0);
  for (std::size_t i = 0; i < steps; ++i) {
    const double elevation = low_ + (static_cast<double>(i) + 0.5) * step;
    const double pattern = elevation_pattern(echo_options, elevation);
    sum_[i + 1] = sum_[i] + pattern * pattern * std::cos(elevation) * step;
  }
  integral_ = sum_.back();
}

double ElevationLaw::elevation_at(double share) const {
  const double wanted = share * integral_;
  const auto above = std::upper_bound(sum_.begin() + 1, sum_.end() - 1, wanted);
  const double below = *(above - 1), rise = *above - below;
  const double inside = rise > 0 ? std::clamp((wanted - below) / rise, 0.0, 1.0) : 0.5;
  return low_ + (static_cast<double>(above - sum_.begin() - 1) + inside) * (high_ - low_) / steps;
}

TwoUniform split_uniform(double uniform) {
  const double scaled = uniform * 0x1p26, whole = std::floor(scaled);
  return {(whole + 0.5) * 0x1p-26, scaled - whole};
}

}  // namespace insonify
