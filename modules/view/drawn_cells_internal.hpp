// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "view/picture.hpp"

namespace insonify {

/// Throws Error(argument) unless width and height are 240 to 8192 pixels.
void require_picture_size(const PictureOptions& options, const char* who);

/// Throws Error(argument) unless fan and gate are valid, level_db is beams x bins, and width and height are 240 to 8192
/// pixels.
void require_drawable(const LevelImage& image, const PictureOptions& options, const char* who);

/// The beams of an image ordered by bearing, as adjacent cells. A bearing is -azimuth [rad], positive to starboard. The
/// circle is cut at its widest gap, so that fans across the stern and full scans stay in one piece; bearings then
/// ascend and may lie outside [-pi, pi]. Beam b fills [edges[b], edges[b+1]]: edges are halfway between neighbours, the
/// outermost half a spacing beyond; a single beam is as wide as fan.beam_width (2 degrees if that is 0). Beams of one
/// bearing share a cell, which shows the strongest of them at each range; if a fan of several elevations is not a
/// regular grid, beams within half a beam width share a cell.
struct BeamCells {
  std::vector<double> edges;   ///< beams + 1, ascending [rad]
  Grid<float> level_db;        ///< beams x bins
  std::size_t elevations = 1;  ///< number of distinct elevations of the fan

  double low() const { return edges.front(); }
  double high() const { return edges.back(); }
  double mean_width() const { return (high() - low()) / static_cast<double>(level_db.rows()); }
};
BeamCells order_beams(const LevelImage& image);

/// Returns the unit for the colour bar, with a note if cells show the strongest of several elevations.
std::string unit_text(const std::string& unit, const BeamCells& cells);

/// A rectangle of cells in bearing and range, averaged in power until none is much smaller than a pixel.
struct CellPatch {
  Grid<float> level_db;           ///< groups of beams x groups of bins
  std::size_t beams_per_row = 1;  ///< row g holds beams [g, g+1) * beams_per_row
  double min_range = 0;           ///< [m]
  double max_range = 0;           ///< end of the last bin [m]
  double columns = 0;             ///< max_range as a column index; below level_db.cols() if the last group is partial
};

/// Returns the cells of a fan drawn at pixels_per_metre. Bins are combined where there are more than two per pixel of
/// radius, and beams near the apex where they are narrower than half a pixel. Together the patches cover the whole fan.
std::vector<CellPatch> fan_patches(const BeamCells& cells, const RangeGate& gate, double pixels_per_metre);

/// Returns the cells of a rectangle of width x height pixels, combined in the same way.
CellPatch rect_patch(const BeamCells& cells, const RangeGate& gate, double width, double height);

}  // namespace insonify
