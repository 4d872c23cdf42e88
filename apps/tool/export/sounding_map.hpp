// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "formats/geotiff_file.hpp"

namespace insonify::tool {

/// Number of the cell that holds a coordinate [m]: cell k reaches from k cell, which belongs to it, to (k + 1) cell,
/// which does not, as the cells of ImageMosaic. A coordinate up to a micrometre below an edge, the error of a
/// projection and of the division, stands on it.
std::int64_t cell_of(double coordinate, double cell);

/// A band of such a map.
struct BandMeaning {
  const char *name, *unit, *meaning;
};
/// The bands in the order of the file. All but the last two are of accepted soundings; the last two are written with
/// --keep-rejected.
inline constexpr BandMeaning sounding_bands[] = {
    {"height", "m", "mean height of the soundings, positive up"},
    {"level", "dB re 1 uPa at 1 m", "mean intensity, with a gain of 30 log r"},
    {"soundings", "", "number of soundings in the cell; 0: none"},
    {"deviation", "m", "standard deviation of the heights; NaN for fewer than two soundings"},
    {"lowest", "m", "least height"},
    {"highest", "m", "greatest height"},
    {"rejected", "", "with --keep-rejected: number of rejected soundings in the cell, which no band before counts"},
    {"rejected_height", "m", "with --keep-rejected: their mean height; NaN if there are none"}};
inline constexpr std::size_t rejected_bands = 2;  ///< how many of them are of rejected soundings

/// The columns of soundings as CSV, in the order of the file; the last four only with a position on the globe.
inline constexpr BandMeaning csv_columns[] = {
    {"ping", "", "number of the ping, from 0"},
    {"time_s", "s", "time since 1970 (UTC), or since the begin of the run"},
    {"beam", "", "number of the beam, from 0"},
    {"x_m", "m", "position in the world"},
    {"y_m", "m", "position in the world"},
    {"z_m", "m", "height in the world, positive up"},
    {"range_m", "m", "c t / 2 with the sound speed at the head"},
    {"deviation_m", "m", "predicted standard deviation of the range"},
    {"level_db", "dB re 1 uPa", "level of the strongest sample of the echo"},
    {"quality", "", "log10(range / deviation)"},
    {"method", "", "amplitude or phase"},
    {"reject", "", "0, or with --keep-rejected the bits of the reasons"},
    {"gsf_beam", "", "entry of the sounding in the arrays of GSF, from port, from 0"},
    {"latitude_deg", "deg", "latitude on WGS 84, positive north; only with a place on the globe"},
    {"longitude_deg", "deg", "longitude on WGS 84, positive east; only with a place on the globe"},
    {"easting_m", "m", "x of LAS: in the projected system of the world, else in UTM; only with a place on the globe"},
    {"northing_m", "m", "y of LAS; only with a place on the globe"}};
inline constexpr std::size_t placed_columns = 4;  ///< how many of them need a place on the globe

/// Soundings in cells of a grid.
class SoundingMap {
 public:
  /// `cell` is the size of cells [m], > 0.
  explicit SoundingMap(double cell) : cell_(cell) {}

  /// Adds a sounding at easting, northing and height [m], of an intensity [Pa^2 at 1 m].
  void add(const Eigen::Vector3d& position, double intensity);
  /// Adds a rejected sounding, which counts in bands of its own alone.
  void add_rejected(const Eigen::Vector3d& position);
  bool empty() const { return cells_.empty(); }

  /// The bands of a raster (sounding_bands), those of rejected soundings on request, and where it lies, without its
  /// zone. Throws Error(argument) for more than 2^26 cells.
  std::vector<GeoBand> bands(bool with_rejected = false) const;
  GeoGrid grid() const;

 private:
  struct Cell {
    double count = 0, intensity = 0;
    double mean = 0, squares = 0;  ///< mean of heights [m]; sum of squares of their differences from the mean [m^2]
    double least = 0, most = 0;
    double rejected = 0, rejected_mean = 0;
  };
  Cell& cell_at(const Eigen::Vector3d& position);
  struct Extent {
    std::int64_t west, south, columns, rows;
  };
  Extent extent() const;

  double cell_;
  std::map<std::pair<std::int64_t, std::int64_t>, Cell> cells_;  ///< cells by row and column
};

}  // namespace insonify::tool
