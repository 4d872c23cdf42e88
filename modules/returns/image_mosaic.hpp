// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/grid.hpp"
#include "returns/bed_surface.hpp"
#include "returns/ping.hpp"
#include "sonar/elevation_pattern.hpp"

namespace insonify {

/// Which samples of the pings a cell of a mosaic shows: their mean intensity, or that of the ping whose beam is
/// narrowest there.
enum class MosaicRule { mean, best };

/// What turns the levels of a ping into backscattering strengths.
struct MosaicSource {
  double source_level_db = 0;      ///< dB re 1 uPa at 1 m
  double absorption_db_per_m = 0;  ///< at the centre frequency
  double range_resolution = 0;     ///< full width of the pulse's intensity at half its peak [m]
  /// Elevation pattern of the head (E14), which is taken out of the levels.
  ElevationShape elevation_shape = ElevationShape::gaussian;
  double elevation_width = 0, elevation_centre = 0;  ///< [rad]; width 0: none
};

/// A finished mosaic: columns along x, rows along y, cells aligned to multiples of their size.
struct MosaicMap {
  double x = 0, y = 0;      ///< corner of cell (0, 0) [m]
  double cell = 0;          ///< size [m]
  Grid<float> strength_db;  ///< backscattering strength [dB re 1 m^2 per m^2] (E96); NaN: no ping heard this cell
  Grid<float> samples;      ///< samples of pings that make it up
};

/// Images of pings laid on a bed, as mosaics of side-scans are made. Every cell of the grid asks each ping for what it
/// heard from there: the place of the cell on the bed has a range, a cone and a turn about the array's axis, and so
/// beams and bins; it is heard if the cone lies within half a beam width or half way to the next beam, and the turn
/// within the full elevation width (of a planar array the row width) of the beam. Samples that fall into the cell or,
/// in range, into the resolution cell about it are averaged, each as backscattering strength (E96):
///
///   level - source level + 40 log10 r + 2 a r - 10 log10(min(dr / sin(incidence), 2 sqrt(2 r dr)) r w)
///
/// less 20 log10 of the elevation pattern at the elevation of the cell (E14), if ranges tell elevations apart; samples
/// where it is below -20 dB do not count. Of a level bed, with the equivalent widths dr and w of pulse and beam, 1.064
/// times those at -3 dB, the latter over the cosine of the cone. What rises above the bed is drawn where the bed has
/// the same range.
class ImageMosaic {
 public:
  /// Throws Error(argument) unless cell > 0.
  ImageMosaic(double cell, MosaicRule rule);

  /// Adds a ping. `strip` is half the way to the neighbouring pings [m, world]: a place beside the way that the beams
  /// miss by no more than that counts as if the head were abeam of it. The result does not depend on `threads`, but in
  /// its last bits on the order of pings. Throws Error(argument) for an invalid fan or gate, or a resolution that is
  /// not > 0, Error(content) if the pings extend over more than 2^26 cells.
  void add(const Ping& ping, const MosaicSource& source, const Eigen::Vector3d& strip, const BedSurface& bed,
           int threads = 0);

  /// Throws Error(content) if no cell was heard.
  MosaicMap map() const;

 private:
  static constexpr int side = 64;
  struct Tile {
    std::vector<double> strength = std::vector<double>(side * side);  ///< sums, not in dB
    std::vector<float> samples = std::vector<float>(side * side);
    std::vector<float> width = std::vector<float>(side * side);  ///< of the beam [m], for MosaicRule::best
  };
  using Place = std::pair<std::int32_t, std::int32_t>;

  double cell_;
  MosaicRule rule_;
  std::map<Place, Tile> tiles_;  ///< only where pings were heard
};

}  // namespace insonify
