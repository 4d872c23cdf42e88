// SPDX-License-Identifier: BSD-3-Clause
#include "returns/detect_soundings.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "acoustics/echo_stream.hpp"
#include "core/parallel.hpp"
#include "core/require.hpp"
#include "core/units.hpp"
#include "returns/echo_place.hpp"
#include "returns/strongest_contributors_internal.hpp"

namespace insonify {
namespace {

constexpr const char* me = "detect_soundings";
constexpr Eigen::Index guard_cells = 2;                 // resolution cells on either side that are not background
constexpr Eigen::Index background_cells = 16;           // resolution cells of background on either side
constexpr double unit = 2 * micropascal * micropascal;  // |pressure|^2 at 0 dB re 1 uPa rms [Pa^2] (E6)
constexpr double nothing = 1e-20 * unit;                // -200 dB

/// A detected sample of one beam.
struct Cell {
  std::uint32_t bin;
  float level_db;
  float offset = 0;  ///< offset of the peak from the middle of the bin [bins]
};

float level_of(double intensity) { return static_cast<float>(db_from_power(std::max(intensity, nothing) / unit)); }

/// Returns a local maximum at the peak of the parabola through its level and those of its neighbours. (E72)
Cell peak_between(float before, Cell at, float after) {
  constexpr float steepest_fall = 24.1F;  // between bins, of a Gaussian as long as a bin; a steeper one is a null
  before = std::max(before, at.level_db - steepest_fall);
  after = std::max(after, at.level_db - steepest_fall);
  at.offset = 0.5F * (before - after) / (before - 2 * at.level_db + after);
  at.level_db -= 0.25F * (before - after) * at.offset;
  return at;
}

/// Finds the detections of one beam after another.
class Detector {
 public:
  Detector(const Ping& ping, const DetectionOptions& options)
      : ping_(ping),
        options_(options),
        cell_(
            static_cast<Eigen::Index>(std::max(1.0, std::ceil(options.range_resolution / ping.gate.bin_size - 1e-9)))),
        threshold_(std::max(nothing, unit * power_from_db(options.noise_floor_db + options.threshold_db))),
        strongest_(ping.gate.bins(), 0) {
    for (int cells = 0; cells <= 2 * background_cells; ++cells)
      factor_.push_back(cells > 0 ? background_factor(options.false_alarm_rate, cells) / cells : 0);
    if (!options.all_bins) find_strongest();
  }

  std::vector<Cell> detect(Eigen::Index b) const {
    std::vector<Cell> cells;
    const Eigen::ArrayXd row = ping_.pressure.row(b).cast<std::complex<double>>().abs2();
    for (Eigen::Index n = 0; n < row.size(); ++n) {
      const double here = row[n];
      if (options_.all_bins) {
        const float level = level_of(here);
        if (here > nothing && level >= static_cast<float>(options_.above_db)) cells.push_back({bin_of(n), level});
        continue;
      }
      if (!(here > threshold_ && here >= strongest_[static_cast<std::size_t>(n)])) continue;
      if (!is_maximum(row, n) || !exceeds_background(row, n)) continue;
      cells.push_back({bin_of(n), level_of(here)});
      if (n > 0 && n + 1 < row.size())
        cells.back() = peak_between(level_of(row[n - 1]), cells.back(), level_of(row[n + 1]));
    }
    return cells;
  }

 private:
  static std::uint32_t bin_of(Eigen::Index n) { return static_cast<std::uint32_t>(n); }

  /// Sets the intensity in each bin below which a sample is a side lobe of the strongest beam there. (E19)
  void find_strongest() {
    const double margin = power_from_db(-options_.side_lobe_margin_db);
    parallel_blocks(strongest_.size(), 1024, options_.threads, [&](std::size_t begin, std::size_t end) {
      const auto first = static_cast<Eigen::Index>(begin), count = static_cast<Eigen::Index>(end - begin);
      Eigen::Map<Eigen::Array<double, 1, Eigen::Dynamic>> most(strongest_.data() + begin, count);
      for (Eigen::Index b = 0; b < ping_.pressure.rows(); ++b)
        most = most.max(ping_.pressure.row(b).segment(first, count).cast<std::complex<double>>().abs2());
      most *= margin;
    });
    const auto reach = static_cast<std::size_t>(options_.side_lobe_reach / ping_.gate.bin_size);
    if (reach == 0) return;
    std::vector<double> about(strongest_.size());
    for (std::size_t n = 0; n < about.size(); ++n)
      about[n] = *std::max_element(
          strongest_.begin() + static_cast<std::ptrdiff_t>(n - std::min(n, reach)),
          strongest_.begin() + static_cast<std::ptrdiff_t>(std::min(strongest_.size(), n + reach + 1)));
    strongest_.swap(about);
  }
  bool is_maximum(const Eigen::ArrayXd& row, Eigen::Index n) const {
    for (Eigen::Index k = 1; k <= std::max<Eigen::Index>(1, cell_ - 1); ++k) {
      if (n >= k && !(row[n] > row[n - k])) return false;
      if (n + k < row.size() && !(row[n] >= row[n + k])) return false;
    }
    return true;
  }
  /// Returns true if a sample exceeds the mean of one sample of each cell around, so that these are independent. (E78)
  bool exceeds_background(const Eigen::ArrayXd& row, Eigen::Index n) const {
    double sum = 0;
    std::size_t count = 0;
    for (Eigen::Index k = guard_cells + 1; k <= guard_cells + background_cells; ++k)
      for (const Eigen::Index at : {n - k * cell_, n + k * cell_}) {
        if (at < 0 || at >= row.size()) continue;
        sum += row[at];
        ++count;
      }
    return row[n] > factor_[count] * sum;
  }

  const Ping& ping_;
  const DetectionOptions& options_;
  Eigen::Index cell_;  // length of a resolution cell [bins]
  double threshold_;   // [Pa^2]
  std::vector<double> strongest_;
  std::vector<double> factor_;  // threshold over the sum of so many cells
};

/// Returns the vector from the head at transmission to a sounding [m, world axes]. Beams are directed by the attitude
/// at reception, contributors by that at transmission.
Eigen::Vector3d way_of(const Ping& ping, double range, const Direction& direction, bool at_transmission) {
  const Eigen::Vector3d axis = unit_vector(direction);
  if (ping.motion.none()) return ping.world_from_head.linear() * (range * axis);
  if (!at_transmission) return way_of_echo(ping, axis, range, ping.sound_speed);
  return distance_of_echo(ping, axis, range, ping.sound_speed) * (ping.world_from_head.linear() * axis);
}

/// Appends the sounding of one detection, in the direction of its strongest contributor, otherwise of the beam.
void add_sounding(Soundings& s, const Ping& ping, std::size_t beam, Cell cell, const StrongestContributor& from) {
  const double range = ping.gate.centre(cell.bin) + static_cast<double>(cell.offset) * ping.gate.bin_size;
  const bool known = from.power > 0;
  const Direction axis{ping.fan.azimuth[beam], ping.fan.elevation[beam]};
  s.position.push_back(ping.world_from_head.translation() + way_of(ping, range, known ? from.direction : axis, known));
  s.level_db.push_back(cell.level_db);
  s.range.push_back(static_cast<float>(range));
  s.azimuth.push_back(static_cast<float>(axis.azimuth));
  s.elevation.push_back(static_cast<float>(axis.elevation));
  s.ping.push_back(static_cast<std::uint32_t>(ping.number));
  s.beam.push_back(static_cast<std::uint32_t>(beam));
  s.bin.push_back(cell.bin);
  s.true_elevation.push_back(known ? static_cast<float>(from.direction.elevation)
                                   : std::numeric_limits<float>::quiet_NaN());
  s.true_surfel.push_back(known ? from.surfel : Soundings::none);
  s.true_material.push_back(known ? from.material : Soundings::none);
}

}  // namespace

double background_factor(double false_alarm_rate, int cells) {
  return cells * std::expm1(-std::log(false_alarm_rate) / cells);  // (E78)
}

Soundings detect_soundings(const Ping& ping, const EchoStream& stream, const DetectionOptions& options) {
  const StoredEchoes none({}, {}, me);
  Soundings soundings = detect_soundings(ping, stream, none, options);
  soundings.true_order.clear();
  return soundings;
}

Soundings detect_soundings(const Ping& ping, const EchoStream& direct, const EchoStream& doubles,
                           const DetectionOptions& options) {
  require(options.false_alarm_rate > 0 && options.false_alarm_rate <= 1, me, "false_alarm_rate",
          options.false_alarm_rate, "", "above 0 and at most 1");
  require(options.range_resolution >= 0, me, "range_resolution", options.range_resolution, "m", ">= 0");
  require(options.side_lobe_reach >= 0, me, "side_lobe_reach", options.side_lobe_reach, "m", ">= 0");
  const Detector detector(ping, options);
  std::vector<std::vector<Cell>> of_beam(ping.fan.beams());
  parallel_for(of_beam.size(), options.threads,
               [&](std::size_t b) { of_beam[b] = detector.detect(static_cast<Eigen::Index>(b)); });

  std::vector<Pixel> pixels;
  for (std::size_t b = 0; b < of_beam.size(); ++b)
    for (const Cell cell : of_beam[b]) pixels.push_back({static_cast<std::uint32_t>(b), cell.bin});
  const auto by_one = strongest_contributors(pixels, direct, ping.fan, ping.gate, options);
  const auto by_two = strongest_contributors(pixels, doubles, ping.fan, ping.gate, options);
  Soundings all;
  std::size_t pixel = 0;
  for (std::size_t b = 0; b < of_beam.size(); ++b)
    for (const Cell cell : of_beam[b]) {
      const bool twice = is_stronger(by_two[pixel], by_one[pixel]);
      add_sounding(all, ping, b, cell, twice ? by_two[pixel] : by_one[pixel]);
      all.true_order.push_back(twice ? 2 : 1);
      ++pixel;
    }
  return all;
}

Soundings detect_soundings(const Ping& ping, const Scatterers& scatterers, const Echoes& echoes,
                           const DetectionOptions& options) {
  return detect_soundings(ping, StoredEchoes(scatterers, echoes, me), options);
}

}  // namespace insonify
