#pragma once
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "view/picture.hpp"

namespace insonify {

/// Numbers of one kind, one per sample of a ping.
struct SampleField {
  std::string name;    ///< of the array in the file, e.g. level_db
  Grid<float> values;  ///< beams x bins
};

/// Writes samples of a fan as VTK's curvilinear grid (.vts), exact: nothing is resampled. Each sample is a cell between
/// the edges of its beam (halfway to its neighbours, as in show_fan) and of its bin, at the elevation of its row, with
/// corners in the world [m, double]. A fan of several elevations makes one file for each of its rows, by ascending
/// elevation: path.vts becomes path_row_000.vts, path_row_001.vts ... Beams of one bearing within a row share a cell, which
/// holds the largest of each field. Returns the names of the files, which are written under temporary names and renamed.
/// Throws Error(argument) for an invalid fan or gate, no field, or one that is not beams x bins or is called like another;
/// Error(file) if it cannot write.
std::vector<std::string> save_fan_grid(const std::string& path, const BeamFan& fan, const RangeGate& gate,
                                       const std::vector<SampleField>& fields, const Pose& world_from_head);

/// Writes samples as VTK's regular image (.vti): one cell per sample, beam number across (x, from 0) and range upwards
/// (y [m]), bit for bit as the cube has them. Throws as save_fan_grid.
void save_sample_image(const std::string& path, const BeamFan& fan, const RangeGate& gate,
                       const std::vector<SampleField>& fields);

/// A file of a series, and when it holds.
struct SeriesEntry {
  double time = 0;  ///< [s]
  int part = 0;     ///< of the files of one time
  std::string file;
};

/// Writes a ParaView collection (.pvd) of files beside it. Throws Error(file).
void save_series(const std::string& path, const std::vector<SeriesEntry>& entries);

}  // namespace insonify
