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

/// Value of a mosaic's cell: the mean intensity of all pings, or the intensity of the ping with the narrowest beam
/// there.
enum class MosaicRule { mean, best };

/// Numbers that convert the levels of a ping to backscattering strengths.
struct MosaicSource {
  double source_level_db = 0;      ///< dB re 1 uPa at 1 m
  double absorption_db_per_m = 0;  ///< at the centre frequency
  double range_resolution = 0;     ///< full width of the pulse's intensity at half its peak [m]
  /// Elevation pattern of the head (E14), which the mosaic removes from the levels.
  ElevationShape elevation_shape = ElevationShape::gaussian;
  double elevation_width = 0, elevation_centre = 0;  ///< [rad]; width 0: none
};

/// A finished mosaic: columns along x, rows along y, cells aligned to multiples of their size.
struct MosaicMap {
  double x = 0, y = 0;      ///< corner of cell (0, 0) [m]
  double cell = 0;          ///< size [m]
  Grid<float> strength_db;  ///< backscattering strength [dB re 1 m^2 per m^2] (E96); NaN: no ping received this cell
  Grid<float> samples;      ///< number of samples in each cell
};

/// Mosaic of the images of pings on a bed, as mosaics of side-scans are made. For each ping, every cell of the grid
/// finds the samples that were received from it. The position of the cell on the bed gives a range, a cone and a turn
/// about the array's axis, and so beams and bins. A beam receives the cell if two conditions hold: the cone lies within
/// half a beam width or half the distance to the next beam, and the turn lies within the full elevation width of the
/// beam (for a planar array the row width). The mosaic averages samples that fall into the cell or, in range, into the
/// resolution cell around it. Each sample counts as a backscattering strength (E96):
///
///   level - source level + 40 log10 r + 2 a r - 10 log10(min(dr / sin(incidence), 2 sqrt(2 r dr)) r w)
///
/// less 20 log10 of the elevation pattern at the elevation of the cell (E14), if ranges distinguish elevations. Samples
/// where the pattern is below -20 dB are ignored. The strength is that of a level bed. dr and w are the equivalent
/// widths of pulse and beam, 1.064 times the -3 dB widths, w divided by the cosine of the cone. An object above the bed
/// is drawn where the bed has the same range.
class ImageMosaic {
 public:
  /// Throws Error(argument) unless cell > 0.
  ImageMosaic(double cell, MosaicRule rule);

  /// Adds a ping. `strip` is half the vector to the neighbouring pings [m, world]: cells between two pings are sampled
  /// as if the head were abeam of them, up to this distance. The result does not depend on `threads`; its last bits
  /// depend on the order of pings. Throws Error(argument) for an invalid fan or gate, or a resolution that is not > 0,
  /// and Error(content) if the pings extend over more than 2^26 cells.
  void add(const Ping& ping, const MosaicSource& source, const Eigen::Vector3d& strip, const BedSurface& bed,
           int threads = 0);

  /// Returns the mosaic. Throws Error(content) if no ping received any cell.
  MosaicMap map() const;

 private:
  static constexpr int side = 64;
  struct Tile {
    std::vector<double> strength = std::vector<double>(side * side);  ///< sums, not in dB
    std::vector<float> samples = std::vector<float>(side * side);
    std::vector<float> width = std::vector<float>(side * side);  ///< width of the beam [m], for MosaicRule::best
  };
  using Position = std::pair<std::int32_t, std::int32_t>;

  double cell_;
  MosaicRule rule_;
  std::map<Position, Tile> tiles_;  ///< only tiles with samples
};

}  // namespace insonify
