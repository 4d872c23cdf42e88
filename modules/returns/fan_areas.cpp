// SPDX-License-Identifier: BSD-3-Clause
#include "returns/fan_areas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "returns/ping.hpp"

namespace insonify {
namespace {

// Samples of one beam: cumulative energy, and the bins where class or object change.
struct BeamEnergy {
  struct Run {
    std::size_t first;  // first bin
    std::uint8_t category;
    std::uint16_t instance;
  };
  std::vector<double> before;  // integral of intensity x range over range, up to each bin
  std::vector<Run> runs;
};

BeamEnergy energy_of_beam(const FanSamples& samples, Eigen::Index beam, const RangeGate& gate) {
  BeamEnergy of;
  const auto bins = static_cast<std::size_t>(samples.level_db.cols());
  of.before.assign(bins + 1, 0);
  for (std::size_t n = 0; n < bins; ++n) {
    const auto at = static_cast<Eigen::Index>(n);
    const double intensity =
        static_cast<double>(std::exp(samples.level_db(beam, at) * std::numbers::ln10_v<float> / 10));
    of.before[n + 1] = of.before[n] + intensity * gate.centre(n) * gate.bin_size;
    const std::uint8_t category = samples.category(beam, at);
    const std::uint16_t instance = samples.instance(beam, at);
    if (of.runs.empty() || of.runs.back().category != category || of.runs.back().instance != instance)
      of.runs.push_back({n, category, instance});
  }
  return of;
}

// Energy and area of one class and object in a pixel.
struct Held {
  std::uint8_t category;
  std::uint16_t instance;
  double energy, area;
};

// The square of a pixel [m], ahead of the head and to starboard.
struct Square {
  double behind, ahead, port, starboard;

  bool holds_head() const { return behind <= 0 && ahead >= 0 && port <= 0 && starboard >= 0; }
};

// The middle of a slice of a beam, thinner than a pixel. Along a ray one pixel ends where the next one begins, so that
// every piece of a sample is in exactly one pixel.
struct Ray {
  double bearing, cosine, sine, wide;  // wide: width of its slice [rad]
  std::size_t beam;                    // index from port

  // Returns the ranges at which the ray enters and leaves a square. There is no chord if the second is smaller.
  std::pair<double, double> chord(const Square& square) const {
    const auto [ahead_in, ahead_out] = std::minmax({square.behind / cosine, square.ahead / cosine});
    const auto [side_in, side_out] = std::minmax({square.port / sine, square.starboard / sine});
    return {std::max(ahead_in, side_in), std::min(ahead_out, side_out)};
  }
};

double apart_from_zero(double x) { return std::abs(x) < 1e-12 ? 1e-12 : x; }

class FanAreas {
 public:
  FanAreas(const FanSamples& samples, const BeamFan& fan, const RangeGate& gate, const FanRaster& raster, int threads)
      : gate_(gate), raster_(raster), far_(gate.min_range + static_cast<double>(gate.bins()) * gate.bin_size) {
    const std::vector<Eigen::Index> beams = columns_from_port(fan);
    const auto bearing = [&](std::size_t k) { return -fan.azimuth[static_cast<std::size_t>(beams[k])]; };
    constexpr double rays_per_pixel = 4;  // at the far end
    const double step = raster.metres_per_pixel / (rays_per_pixel * far_);
    const std::size_t last = beams.size() - 1;
    for (std::size_t k = 0; k <= last; ++k) {
      const double low = k == 0 ? bearing(0) - raster.margin : 0.5 * (bearing(k - 1) + bearing(k));
      const double high = k == last ? bearing(last) + raster.margin : 0.5 * (bearing(k) + bearing(k + 1));
      const double count = std::max(1.0, std::ceil((high - low) / step));
      for (double slice = 0; slice < count; ++slice) {
        const double at = low + (slice + 0.5) * (high - low) / count;
        rays_.push_back({at, apart_from_zero(std::cos(at)), apart_from_zero(std::sin(at)), (high - low) / count, k});
      }
    }
    beam_.resize(beams.size());
    parallel_for(beams.size(), threads, [&](std::size_t k) { beam_[k] = energy_of_beam(samples, beams[k], gate); });
  }

  // Lists the classes and objects in a pixel.
  void hold(Eigen::Index row, Eigen::Index column, std::vector<Held>& held) const {
    const double m = raster_.metres_per_pixel, ahead = (raster_.head_row - static_cast<double>(row)) * m,
                 port = (static_cast<double>(column) - raster_.head_column) * m;
    const Square square{ahead - m, ahead, port, port + m};
    held.clear();
    double first = -pi, last = pi;
    if (!square.holds_head()) {
      if (square.behind < 0 && square.port < 0 && square.starboard > 0) return;  // astern, outside all beams
      const auto [least, most] =
          std::minmax({std::atan2(square.port, square.behind), std::atan2(square.port, square.ahead),
                       std::atan2(square.starboard, square.behind), std::atan2(square.starboard, square.ahead)});
      first = least, last = most;
    }
    auto ray = std::ranges::lower_bound(rays_, first, {}, &Ray::bearing);
    for (; ray != rays_.end() && ray->bearing < last; ++ray) {
      const auto [in, out] = ray->chord(square);
      add(beam_[ray->beam], std::max(in, gate_.min_range), std::min(out, far_), ray->wide, held);
    }
  }

 private:
  // Returns the energy of a beam up to a range, in proportion to the area within a bin.
  double energy_before(const BeamEnergy& beam, double range) const {
    const double position = (range - gate_.min_range) / gate_.bin_size;
    const auto n = static_cast<std::size_t>(std::clamp(position, 0.0, static_cast<double>(beam.before.size() - 2)));
    const double near = gate_.min_range + static_cast<double>(n) * gate_.bin_size, end = near + gate_.bin_size;
    const double share = (range * range - near * near) / (end * end - near * near);
    return beam.before[n] + (beam.before[n + 1] - beam.before[n]) * share;
  }

  // Adds a slice of a beam between two ranges; `wide` is its width in bearing [rad].
  void add(const BeamEnergy& beam, double in, double out, double wide, std::vector<Held>& held) const {
    if (!(out > in)) return;
    const auto bin = static_cast<std::size_t>(std::max(0.0, std::floor((in - gate_.min_range) / gate_.bin_size)));
    auto run = std::upper_bound(beam.runs.begin(), beam.runs.end(), bin,
                                [](std::size_t at, const BeamEnergy::Run& r) { return at < r.first; }) -
               1;
    for (double from = in; from < out && run != beam.runs.end(); ++run) {
      const auto next = run + 1;
      const double end =
          next == beam.runs.end() ? far_ : gate_.min_range + static_cast<double>(next->first) * gate_.bin_size;
      const double to = std::min(out, end);
      if (!(to > from)) continue;
      const double area = 0.5 * (to * to - from * from) * wide;
      const double energy = (energy_before(beam, to) - energy_before(beam, from)) * wide;  // (E168)
      auto at = std::ranges::find_if(
          held, [&](const Held& h) { return h.category == run->category && h.instance == run->instance; });
      if (at == held.end()) at = held.insert(held.end(), {run->category, run->instance, 0, 0});
      at->energy += energy, at->area += area;
      from = to;
    }
  }

  const RangeGate& gate_;
  const FanRaster& raster_;
  double far_;
  std::vector<Ray> rays_;         // from port
  std::vector<BeamEnergy> beam_;  // from port
};

// Returns the object with most energy among those of the class with most energy.
const Held& strongest_of(const std::vector<Held>& held) {
  double total = 0;
  for (const Held& h : held) total += h.energy;
  const auto weight = [&](const Held& h) { return total > 0 ? h.energy : h.area; };
  std::map<std::uint8_t, double> of_class;
  for (const Held& h : held) of_class[h.category] += weight(h);
  const auto most = std::ranges::max_element(of_class, {}, [](const auto& c) { return c.second; });
  const Held* best = nullptr;
  for (const Held& h : held)
    if (h.category == most->first && (!best || weight(h) > weight(*best))) best = &h;
  return *best;
}

// Returns the pixels of fan_pixels with the level `outside` beside the fan.
FanPixels pixels_of(const FanSamples& samples, const BeamFan& fan, const RangeGate& gate, const FanRaster& raster,
                    float outside, int threads) {
  const FanAreas areas(samples, fan, gate, raster, threads);
  const Eigen::Index rows = raster.beam.rows(), columns = raster.beam.cols();
  FanPixels pixels{Grid<float>::Constant(rows, columns, outside), Grid<std::uint8_t>::Zero(rows, columns),
                   Grid<std::uint16_t>::Zero(rows, columns)};
  parallel_for(static_cast<std::size_t>(rows), threads, [&](std::size_t r) {
    const auto row = static_cast<Eigen::Index>(r);
    std::vector<Held> held;
    for (Eigen::Index column = 0; column < columns; ++column) {
      areas.hold(row, column, held);
      if (held.empty()) continue;
      double energy = 0, area = 0;
      for (const Held& h : held) energy += h.energy, area += h.area;
      const Held& most = strongest_of(held);
      pixels.category(row, column) = most.category, pixels.instance(row, column) = most.instance;
      pixels.level_db(row, column) =
          static_cast<float>(energy > 0 ? std::max(silence_db, 10 * std::log10(energy / area)) : silence_db);
    }
  });
  return pixels;
}

void require_samples(const FanSamples& samples, const BeamFan& fan, const RangeGate& gate, const char* who) {
  const auto require_size = [&](Eigen::Index beams, Eigen::Index bins, const char* what) {
    if (beams != static_cast<Eigen::Index>(fan.beams()) || bins != static_cast<Eigen::Index>(gate.bins()))
      fail(ErrorKind::argument, who, ": ", what, " of ", beams, " x ", bins, " samples, must be of ", fan.beams(),
           " beams x ", gate.bins(), " bins");
  };
  require_size(samples.level_db.rows(), samples.level_db.cols(), "levels");
  require_size(samples.category.rows(), samples.category.cols(), "classes");
  require_size(samples.instance.rows(), samples.instance.cols(), "objects");
  for (Eigen::Index bin = 0; bin < samples.level_db.cols(); ++bin)
    for (Eigen::Index beam = 0; beam < samples.level_db.rows(); ++beam)
      if (std::isnan(samples.level_db(beam, bin)))
        fail(ErrorKind::content, who, ": level(", beam, ", ", bin, ") is not a number");
}

}  // namespace

FanPixels fan_pixels(const FanSamples& samples, const BeamFan& fan, const RangeGate& gate, const FanRaster& raster,
                     int threads) {
  require_samples(samples, fan, gate, "fan_pixels");
  return pixels_of(samples, fan, gate, raster, static_cast<float>(silence_db), threads);
}

Grid<float> fan_levels(const Grid<float>& level_db, const BeamFan& fan, const RangeGate& gate, const FanRaster& raster,
                       int threads) {
  const Grid<std::uint8_t> no_class = Grid<std::uint8_t>::Zero(level_db.rows(), level_db.cols());
  const Grid<std::uint16_t> no_object = Grid<std::uint16_t>::Zero(level_db.rows(), level_db.cols());
  const FanSamples samples{level_db, no_class, no_object};
  require_samples(samples, fan, gate, "fan_levels");
  return pixels_of(samples, fan, gate, raster, -std::numeric_limits<float>::infinity(), threads).level_db;
}

}  // namespace insonify
