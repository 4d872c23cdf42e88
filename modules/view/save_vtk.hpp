// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "returns/soundings.hpp"
#include "view/picture.hpp"

namespace insonify {

/// One quantity of a ping, one value per sample.
struct SampleField {
  std::string name;    ///< name of the array in the file, e.g. level_db
  Grid<float> values;  ///< beams x bins
  std::string unit{};  ///< unit in the text array `units` of the field data, "name: unit", and UNITS_LABEL; empty: none
};

/// Writes samples of a fan as a VTK curvilinear grid (.vts) without resampling, and returns the names of the files.
/// Each sample is a cell between the edges of its beam (halfway to its neighbours, as in show_fan) and of its bin, at
/// the elevation of its row, with corners in the world [m, double]. Rows of beams with the same bearings are the layers
/// of one volume, between elevations halfway from row to row. Rows with different bearings give one file each, by
/// ascending elevation: path.vts becomes path_row_000.vts, path_row_001.vts ... Beams of one bearing within a row share
/// a cell, which holds the largest value of each field. The files are written under temporary names and renamed. Throws
/// Error(argument) for an invalid fan or gate, no fields, a field that is not beams x bins, or two fields of one name;
/// Error(file) if it cannot write.
std::vector<std::string> save_fan_grid(const std::string& path, const BeamFan& fan, const RangeGate& gate,
                                       const std::vector<SampleField>& fields, const Pose& world_from_head);

/// Writes samples as a regular VTK image (.vti): one cell per sample, beam number along x (from 0) and range along y
/// [m], with the values of the cube bit for bit. Throws as save_fan_grid.
void save_sample_image(const std::string& path, const BeamFan& fan, const RangeGate& gate,
                       const std::vector<SampleField>& fields);

/// A horizontal map: columns along x, rows along y.
struct HorizontalMap {
  double x = 0, y = 0, cell = 0;    ///< corner of cell (0, 0), and size of the cells [m]
  std::vector<SampleField> fields;  ///< columns x rows each
};

/// Writes all fields as cells of a VTK image (.vti) at their position in the world, z = 0. Written to a temporary name,
/// then renamed. Throws Error(argument) unless there is a field and all are of one size, Error(file) if it cannot
/// write.
void save_map_image(const std::string& path, const HorizontalMap& map);

/// Returns the map in a file of save_map_image. Throws Error(file) if the file is missing, Error(content) if it is not
/// such a map.
HorizontalMap load_map_image(const std::string& path);

/// Writes the first field as a grey picture `stem`.png, y up, with the world file `stem`.pgw that gives its position.
/// The grey value 0 means NaN; 1 to 255 cover the values from `window` below the highest value up to it. Errors as
/// save_map_image; Error(content) if no value is finite.
void save_map_picture(const std::string& stem, const HorizontalMap& map, double window);

/// A further column of points.
struct PointColumn {
  std::string name, unit;
  std::vector<double> values;
  bool whole = false;  ///< true: whole numbers from 0
};

/// Writes soundings as VTK polydata (.vtp). Each sounding is a vertex in the world [m, double]. The columns are point
/// data under their names, level_db first, then those of `more`. Their units are in the text array `units` of the field
/// data, "name: unit" each, and in UNITS_LABEL of the arrays. The file is written to a temporary name, then renamed.
/// Throws Error(argument) for columns of different lengths, Error(file) if it cannot write.
void save_points(const std::string& path, const Soundings& soundings, const std::vector<PointColumn>& more = {});

/// A file of a time series.
struct SeriesEntry {
  double time = 0;  ///< [s]
  int part = 0;     ///< number among the files of one time
  std::string file;
};

/// Writes a ParaView collection (.pvd) of files in the same folder. Throws Error(file).
void save_series(const std::string& path, const std::vector<SeriesEntry>& entries);

/// Polylines in space with scalar fields, as a structure of arrays.
struct LineSet {
  std::vector<std::vector<Eigen::Vector3d>> points;  ///< points of each line, world [m]
  /// Numbers of the lines, one each.
  struct Field {
    std::string name;
    std::vector<float> values;  ///< one per line
  };
  std::vector<Field> fields;
};

/// Writes lines as VTK polydata (.vtp), points in double, fields as cell data. Written to a temporary name, then
/// renamed. Throws Error(argument) for a line of fewer than two points or a field without exactly one value per line,
/// Error(file) if it cannot write.
void save_lines(const std::string& path, const LineSet& lines);

}  // namespace insonify
