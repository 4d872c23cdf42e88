// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// Options of TileWriter.
struct TileWriterOptions {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m]; points are stored relative to it
  std::vector<Material> materials = {Material{}};
  bool normals_oriented = true;
  std::string system{};          ///< coordinate system of the world, as FileMeaning::system; empty: unknown
  std::string levels_of{};       ///< SHA-256 of the prepared cloud whose levels these are; empty: of none
  bool drop_duplicates = false;  ///< keep only the first of several surfels at one position
  /// Sets normals, areas and, if there was noise, noise of neighbouring surfels, in place of those that were added. At
  /// least 12 spacings around them stand at the end of the cloud, whose results are not used. Empty: nothing changes.
  std::function<void(SceneCloud& neighbours)> complete{};
  std::size_t tile_surfels = 4096;         ///< most surfels of one tile
  std::size_t memory = 256 << 20;          ///< memory for sorting [bytes]; at least 1 MiB is used
  int threads = 0;                         ///< 0: all cores; the file does not depend on it
  std::function<void(double)> progress{};  ///< receives the completed fraction of finish(), 0..1; may throw to cancel
};

/// Counts and total area of a .tiles file.
struct TileReport {
  std::uint64_t surfels = 0, dropped_duplicates = 0, bytes = 0;
  std::size_t tiles = 0;
  double total_area = 0;  ///< [m^2]
};

/// Writes a .tiles file from batches of surfels in bounded memory. Surfels are stored in an unnamed temporary file in
/// the output's folder (56 bytes each, temporarily twice). finish() sorts them by position and then renames the output.
/// Before that, and after any failure, no file of that name exists and nothing else is left behind.
class TileWriter {
 public:
  /// Begins a file. Throws Error(argument) for an invalid option, Error(file) if the folder is not writable.
  explicit TileWriter(const std::string& path, const TileWriterOptions& options = {});
  ~TileWriter();

  /// Adds a batch. Batches may differ in origin; material indices refer to the writer's materials. Throws as
  /// require_valid, and Error(content) for more than 2^32 - 1 surfels in total.
  void add(const SceneCloud& batch);
  /// Adds a batch whose positions are `positions` instead of batch.point: double [m], relative to the writer's origin.
  void add(const SceneCloud& batch, std::span<const Eigen::Vector3d> positions);

  /// Completes the file and returns its counts; call it once. Throws Error(file) if the file cannot be written.
  TileReport finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes a whole scene as a .tiles file, with its origin, materials and noise.
TileReport save_tiles(const std::string& path, const SceneCloud& scene, TileWriterOptions options = {});

}  // namespace insonify
