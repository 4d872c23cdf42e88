// SPDX-License-Identifier: BSD-3-Clause
#include "returns/image_mosaic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double most_mosaic_cells = 0x1p26;
// Equivalent width over full width at half maximum (E74), exact for a Gaussian, close for other pulses and main lobes.
const double equivalent = std::sqrt(pi / (4 * std::log(2)));
constexpr double resolved_cells = 4;
constexpr double faintest_gain = 0.01;                        // of the elevation pattern, -20 dB
constexpr double level_unit = 2 * micropascal * micropascal;  // intensity at 0 dB re 1 uPa rms

/// Samples that a ping received from one position.
struct Received {
  double strength = 0;  ///< sum of backscattering strengths, not in dB
  int samples = 0;
  double width = 0;  ///< width of the beam there [m]
};

/// A beam of a row by its cone, with the limits of the cones that it covers.
struct MosaicBeam {
  double cone, low, high;
  Eigen::Index beam;
};

/// Finds the samples that a ping received from positions on a bed.
class PingOnBed {
 public:
  PingOnBed(const Ping& ping, const MosaicSource& source, double cell)
      : ping_(ping), source_(source), cell_(cell), head_from_world_(ping.world_from_head.inverse()) {
    const double width = ping.fan.beam_width;
    turn_width_ = ping.fan.row_width > 0 ? ping.fan.row_width : ping.fan.elevation_width;
    for (const FanRow& row : fan_rows(ping.fan)) {
      Row& beams = rows_.emplace_back();
      for (const std::size_t b : row.beams) {
        const Vector3d axis = unit_vector({ping.fan.azimuth[b], ping.fan.elevation[b]});
        const double cone = cone_azimuth(axis);
        beams.turn = std::atan2(axis.z(), std::abs(axis.x()));
        const double half = width / 2 / std::max(0.1, std::abs(std::cos(cone)));
        beams.beams.push_back({cone, cone - half, cone + half, static_cast<Eigen::Index>(b)});
      }
      std::sort(beams.beams.begin(), beams.beams.end(), [](const auto& a, const auto& b) { return a.cone < b.cone; });
      for (std::size_t k = 1; k < beams.beams.size(); ++k) {
        const double middle = (beams.beams[k - 1].cone + beams.beams[k].cone) / 2;
        beams.beams[k - 1].high = std::max(beams.beams[k - 1].high, middle);
        beams.beams[k].low = std::min(beams.beams[k].low, middle);
      }
    }
  }

  /// Returns the samples from a position. Without samples, the head is assumed to be abeam of the position, up to
  /// `strip` further along its way.
  Received samples_from(const Vector3d& position, const Vector3d& strip) const {
    const Vector3d p = head_from_world_ * position;
    Received received = samples_from(p);
    const double half = strip.norm();
    if (received.samples > 0 || !(half > 0)) return received;
    const Vector3d along = head_from_world_.linear() * (strip / half);
    // Only heads that look athwart sweep a strip.
    if (std::abs(along.x()) > 0.5) return received;
    return samples_from(p - std::clamp(p.dot(along), -half, half) * along);
  }

  /// Returns a horizontal box of all positions that the ping may have received, enlarged by `margin`.
  Eigen::AlignedBox2d reach(double margin) const {
    const double range = ping_.gate.min_range + static_cast<double>(ping_.gate.bins()) * ping_.gate.bin_size;
    Eigen::AlignedBox2d box(Eigen::Vector2d(ping_.world_from_head.translation().head<2>()));
    constexpr int turns = 8;
    for (const Row& row : rows_)
      for (const MosaicBeam& beam : row.beams)
        for (const double cone : {beam.low, beam.cone, beam.high})
          for (int k = -turns; k <= turns; ++k) {
            const double turn = std::clamp(row.turn + turn_width_ * k / turns, -pi / 2, pi / 2);
            const Vector3d ahead = unit_vector(direction_in_cone(cone, turn));
            box.extend(Eigen::Vector2d((ping_.world_from_head * Vector3d(range * ahead)).head<2>()));
          }
    margin += range * (1 - std::cos(std::min(turn_width_, pi / 2) / turns));
    return {box.min().array() - margin, box.max().array() + margin};
  }

 private:
  struct Row {
    double turn = 0;
    std::vector<MosaicBeam> beams;  ///< sorted by cone
  };

  Received samples_from(const Vector3d& p) const {
    Received received;
    const double range = p.norm();
    const RangeGate& gate = ping_.gate;
    const double bin = (range - gate.min_range) / gate.bin_size;
    if (!(bin >= 0 && bin < static_cast<double>(ping_.pressure.cols()))) return received;
    const double cone = cone_azimuth(p), turn = std::atan2(p.z(), std::abs(p.x()));
    for (const Row& row : rows_) {
      if (std::abs(turn - row.turn) > turn_width_) continue;
      const MosaicBeam* beam = beam_at(row, cone);
      if (beam) add_samples(p, range, *beam, received);
    }
    return received;
  }

  static const MosaicBeam* beam_at(const Row& row, double cone) {
    auto at = std::lower_bound(row.beams.begin(), row.beams.end(), cone,
                               [](const MosaicBeam& beam, double c) { return beam.cone < c; });
    if (at == row.beams.end() || (at != row.beams.begin() && cone - at[-1].cone < at->cone - cone)) --at;
    return cone >= at->low && cone <= at->high ? &*at : nullptr;
  }

  /// Returns the two-way intensity response in elevation towards a position in head axes (E14). It applies where ranges
  /// distinguish elevations: where the range of a level bed changes by several resolution cells across the pattern.
  /// Otherwise, as for swaths, a sample contains the whole beam, and the response is 1.
  double elevation_gain(const Vector3d& p, double range) const {
    if (!(source_.elevation_width > 0)) return 1;
    const Vector3d ahead = p / range, up = head_from_world_.linear().col(2);
    const Vector3d rising = (Vector3d::UnitZ() - ahead.z() * ahead).normalized();
    const double change = range * std::abs(up.dot(rising)) * source_.elevation_width;  // times the cosine of incidence
    if (!(change > resolved_cells * source_.range_resolution * std::abs(up.dot(ahead)))) return 1;
    const double off = std::asin(std::clamp(ahead.z(), -1.0, 1.0)) - source_.elevation_centre;
    return std::pow(elevation_response(source_.elevation_shape, source_.elevation_width, off), 2);
  }

  /// Adds the samples of a beam within the cell, or within the resolution cell about its middle.
  void add_samples(const Vector3d& p, double range, const MosaicBeam& beam, Received& received) const {
    const Vector3d up = head_from_world_.linear().col(2);
    const double cosine = std::min(1.0, std::abs(up.dot(p)) / range), sine = std::sqrt(1 - cosine * cosine);
    const double pattern = elevation_gain(p, range);
    if (pattern < faintest_gain) return;
    const double half = std::max(source_.range_resolution, cell_ * sine) / 2;
    const RangeGate& gate = ping_.gate;
    const double first = (range - half - gate.min_range) / gate.bin_size, last = first + 2 * half / gate.bin_size;
    const auto begin = static_cast<Eigen::Index>(std::max(0.0, std::floor(first)));
    const auto end = std::min(ping_.pressure.cols(), static_cast<Eigen::Index>(std::floor(last)) + 1);
    const double width = equivalent * ping_.fan.beam_width / std::max(0.1, std::abs(std::cos(beam.cone)));
    const double dr = equivalent * source_.range_resolution;
    const double area = std::min(dr / std::max(sine, 1e-9), 2 * std::sqrt(2 * range * dr)) * range * width;  // (E96)
    const double gain = std::pow(range, 4) *
                        power_from_db(2 * source_.absorption_db_per_m * range - source_.source_level_db) /
                        (level_unit * area * pattern);
    for (Eigen::Index n = begin; n < end; ++n, ++received.samples) received.strength += gain * intensity(beam.beam, n);
    received.width = range * width;
  }

  double intensity(Eigen::Index b, Eigen::Index n) const {
    if (ping_.intensity.size() > 0) return static_cast<double>(ping_.intensity(b, n));
    return std::norm(std::complex<double>(ping_.pressure(b, n)));
  }

  const Ping& ping_;
  const MosaicSource& source_;
  double cell_, turn_width_ = 0;
  Pose head_from_world_;
  std::vector<Row> rows_;
};

}  // namespace

ImageMosaic::ImageMosaic(double cell, MosaicRule rule) : cell_(cell), rule_(rule) {
  if (!(cell > 0 && std::isfinite(cell)))
    fail(ErrorKind::argument, "ImageMosaic: cell = ", cell, " m, must be finite and > 0");
}

void ImageMosaic::add(const Ping& ping, const MosaicSource& source, const Vector3d& strip, const BedSurface& bed,
                      int threads) {
  require_valid(ping.fan, "ImageMosaic");
  require_valid(ping.gate, "ImageMosaic");
  if (!(source.range_resolution > 0))
    fail(ErrorKind::argument, "ImageMosaic: range_resolution = ", source.range_resolution, " m, must be > 0");
  const PingOnBed on_bed(ping, source, cell_);
  const Eigen::AlignedBox2d box = on_bed.reach(strip.norm() + cell_);
  const double tile = side * cell_;
  const Eigen::Array2d low = (box.min().array() / tile).floor(), high = (box.max().array() / tile).floor();
  if (!((high - low + 1).prod() * side * side <= most_mosaic_cells && low.abs().maxCoeff() < 0x1p30))
    fail(ErrorKind::content, "ImageMosaic: cell = ", cell_, " m makes more than 2^26 cells for ping ", ping.number,
         "; make the cells larger");
  std::vector<std::pair<Position, Tile*>> touched;
  for (auto i = static_cast<std::int32_t>(low.x()); i <= static_cast<std::int32_t>(high.x()); ++i)
    for (auto j = static_cast<std::int32_t>(low.y()); j <= static_cast<std::int32_t>(high.y()); ++j)
      touched.emplace_back(Position{i, j}, &tiles_[{i, j}]);

  parallel_for(touched.size(), threads, [&](std::size_t t) {
    const auto& [position, into] = touched[t];
    for (int k = 0; k < side * side; ++k) {
      const double x = (static_cast<double>(position.first) * side + k % side + 0.5) * cell_;
      const double y = (static_cast<double>(position.second) * side + k / side + 0.5) * cell_;
      const Received received = on_bed.samples_from({x, y, bed.at(x, y)}, strip);
      if (received.samples == 0) continue;
      const auto at = static_cast<std::size_t>(k);
      if (rule_ == MosaicRule::best) {
        if (into->samples[at] > 0 && into->width[at] <= static_cast<float>(received.width)) continue;
        into->strength[at] = into->samples[at] = 0;
        into->width[at] = static_cast<float>(received.width);
      }
      into->strength[at] += received.strength;
      into->samples[at] += static_cast<float>(received.samples);
    }
  });
  for (const auto& [position, into] : touched)
    if (std::all_of(into->samples.begin(), into->samples.end(), [](float n) { return n == 0; })) tiles_.erase(position);
}

MosaicMap ImageMosaic::map() const {
  if (tiles_.empty()) fail(ErrorKind::content, "ImageMosaic: no ping hears the bed");
  Eigen::AlignedBox<std::int64_t, 2> box;  // box of the cells with samples
  const auto each_cell = [&](const auto& use) {
    for (const auto& [position, tile] : tiles_)
      for (std::size_t k = 0; k < tile.samples.size(); ++k) {
        const auto in_tile = static_cast<std::int64_t>(k);
        const Eigen::Vector<std::int64_t, 2> at(std::int64_t{position.first} * side + in_tile % side,
                                                std::int64_t{position.second} * side + in_tile / side);
        if (tile.samples[k] > 0) use(at, tile, k);
      }
  };
  each_cell([&](const auto& at, const Tile&, std::size_t) { box.extend(at); });
  const Eigen::Array<std::int64_t, 2, 1> size = (box.max() - box.min()).array() + 1;
  if (!(size.cast<double>().prod() <= most_mosaic_cells))
    fail(ErrorKind::content, "ImageMosaic: cell = ", cell_, " m makes ", size.x(), " x ", size.y(),
         " cells, must be at most 2^26; make the cells larger");
  MosaicMap map{static_cast<double>(box.min().x()) * cell_, static_cast<double>(box.min().y()) * cell_, cell_, {}, {}};
  map.strength_db.setConstant(size.x(), size.y(), std::numeric_limits<float>::quiet_NaN());
  map.samples.setZero(size.x(), size.y());
  each_cell([&](const auto& at, const Tile& tile, std::size_t k) {
    const auto i = at.x() - box.min().x(), j = at.y() - box.min().y();
    map.samples(i, j) = tile.samples[k];
    map.strength_db(i, j) = static_cast<float>(db_from_power(tile.strength[k] / static_cast<double>(tile.samples[k])));
  });
  return map;
}

}  // namespace insonify
