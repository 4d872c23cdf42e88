// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>
#include <string>

#include "tool/command/option_list.hpp"
#include "tool/run/world_reference.hpp"

namespace insonify::tool {

/// Options of `export`.
struct ProductOptions {
  std::string to = "vtk", run, output;
  std::string head;  ///< name of the head, of a survey with several
  WorldOptions world;
  std::string start_utc;       ///< empty: as the mission says
  std::string crs;             ///< system of a raster: EPSG:N, local, or empty: that of the world, else UTM
  double cell = 0.5;           ///< size of a raster's cells [m]
  int per_beam = 1;            ///< soundings of a beam
  bool keep_rejected = false;  ///< keep soundings that are judged wrong, flagged
  double min_level = -std::numeric_limits<double>::infinity();     ///< least level of a sounding [dB re 1 uPa]
  double max_deviation = std::numeric_limits<double>::infinity();  ///< [m]
  std::string processing_profile;    ///< file; empty: the profile that the sound ran through
  std::string tide;                  ///< file of a tide, or none: what heights are reduced by; empty: the true one
  std::string las_version = "1.4";   ///< or 1.2
  std::string compression = "none";  ///< compression of an mcap: none, lz4 or zstd
  bool linear = false;               ///< images of pressure in 32 bits
  bool force = false;                ///< replace a file or directory
};

/// Writes the pings of a run, one after the other, as a file (png, neusis: a directory) of another program. Throws
/// Error(argument) for a product with coordinates of the globe if neither options, mission nor scene say where the
/// world is, or if they contradict each other,
/// Error(content) for a survey that is not complete or has several heads, as read_cube for damaged cubes, and
/// Error(file) if it cannot write.
void export_product(const ProductOptions& options, const CommonOptions& common);

}  // namespace insonify::tool
