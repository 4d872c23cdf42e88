// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include "store/merge_cubes_by_time.hpp"
#include "store/mission_file.hpp"
#include "store/run_directory.hpp"
#include "tool/command/option_list.hpp"
#include "tool/export/raster_plane.hpp"
#include "tool/run/world_reference.hpp"

namespace insonify::tool {

/// Joins what the merged runs hold beside their cubes: returns (.ply and .pcd, with the numbers of the merged pings),
/// contributors (contributors/000000.h5 and so on, in the order of the pings) and insonification (.ply and .pcd). What
/// not all of the runs have is left out; the notes that are returned say so. `manifest` gets what was joined. Throws as
/// the readers and writers of these files.
std::vector<std::string> merge_companions(const RunDirectory& directory, const std::vector<std::string>& runs,
                                          const MergedCube& merged, nlohmann::ordered_json& manifest);

/// For the manifest of a survey: start_utc and anchor, null if unknown, and the system of its world if it is known.
nlohmann::ordered_json frame_json(const MissionFile& frame);

/// The cubes of a head, whose settings are in FOLDER/NAME/run.toml; joined they are FOLDER/NAME/cube.h5.
struct HeadCubes {
  std::string name;
  std::vector<std::string> cubes;
};

/// The ways of the heads that have cubes, in the folder of their merged survey, as GeoJSON: for each a LineString of
/// longitude, latitude and height (WGS 84, E90), with its name, the numbers of its pings, and their times: UTC, or [s]
/// without start_utc. Heads of one ping give a Point.
/// place      where the world is
/// start_utc  of time 0, or ""
nlohmann::ordered_json track_geojson(const Georeference& position, const std::string& start_utc,
                                     const std::string& folder, const std::vector<HeadCubes>& heads);

/// --mosaic and what goes with it.
struct MosaicOptions {
  double cell = 0;          ///< [m]; 0: no mosaic
  std::string bottom;       ///< height of a level bed [m], or empty: the returns' surface
  std::string by = "mean";  ///< or "best"
  std::string crs;          ///< system of mosaic.tif: EPSG:N, local, or empty: that of the world, else UTM
  WorldOptions world{};     ///< place of the world; empty: as mission or scene say
};

/// Joins the blocks of a survey in its folder: NAME/cube.h5 of each head, which refers to the blocks unless `copy`,
/// returns.ply and manifest.json; with a mosaic also mosaic.vti, .png, .pgw and,
/// with a position on the globe or a local plane, .tif. Throws Error(content) naming blocks that
/// are missing or were changed; SomeFailed, when all is written, if some pings failed.
void merge_survey(const std::string& folder, bool copy, const MosaicOptions& mosaic, const CommonOptions& common);

/// Lays the images of a survey on its bed (E96) and writes mosaic.vti, .png and .pgw into its folder, and .tif
/// if there is a plane: north up there, each cell as the cell of the mosaic that holds its middle.
///
/// heads    with the cubes of their blocks, in the order of time
/// returns  of all heads: the bed, unless the options give its height
///
/// Takes the memory of one block and of the grid; the result does not depend on `threads`. Throws Error(argument) for a
/// height that is no number, and as ImageMosaic and bed_of_returns.
void save_mosaic(const std::string& folder, const std::vector<HeadCubes>& heads, const std::string& returns,
                 const MosaicOptions& options, const std::optional<RasterPlane>& plane, int threads);

}  // namespace insonify::tool
