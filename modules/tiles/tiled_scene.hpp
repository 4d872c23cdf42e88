// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sampling/insonified_region.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

struct CutOptions;

/// Facts about the scene of a .tiles file.
struct TiledSceneInfo {
  std::string path;
  std::uint64_t surfels = 0, bytes = 0;
  std::size_t tiles = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m]
  Bounds box;                                        ///< world [m]; min > max if there are no surfels
  double total_area = 0;                             ///< [m^2]
  WholeScene whole;
  bool normals_oriented = true;
  std::vector<Material> materials;
  std::string system;          ///< coordinate system of the world, as FileMeaning::system; empty: unknown
  bool noisy = false;          ///< true: the surfels have noise
  std::uint64_t checksum = 0;  ///< checksum of everything in the file
  std::string levels_of;       ///< SHA-256 of the prepared cloud whose levels these are; empty: of none
};

/// Tiles to be loaded, and their size.
struct TileSelection {
  std::vector<std::uint32_t> tiles;
  std::size_t surfels = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< origin of the loaded cloud [m]
  /// Returns the memory that loading these tiles takes [bytes].
  double bytes_to_load() const { return 64.0 * static_cast<double>(surfels); }
};

/// A scene as fine as a head resolves it (cut_scene).
struct TiledCut {
  SceneCloud scene;         ///< surfels and nodes by ascending id, with part_of of the whole scene
  std::uint64_t bytes = 0;  ///< bytes that were read
};

/// A prepared scene on disk. Only the tiles near a head are read, so scenes far larger than memory can be pinged.
/// TileWriter writes such a file. Steps and cost:
///   opening   reads the directory, 80 bytes per tile of at most 4096 surfels, in a child process
///   select    tests the enclosing ball of every tile against the insonified region: constant cost per tile
///   load      reads the selected tiles in parallel, checks them, and sorts their surfels by id. The cloud is the whole
///             scene without the surfels of other tiles.
///   cut       walks down the levels of detail, and reads them as far as a head resolves them
///
///   const TiledScene tiled("bay.tiles");
///   const InsonifiedRegion region = simulator.reach(tiled.info().whole, event);
///   const SceneCloud part = tiled.load(tiled.select(region));
///   simulate_ping(part, head, pose, environment, options);  // the same bytes as of the whole scene
class TiledScene {
 public:
  /// Opens a file and reads its directory.
  /// Throws Error(file) if the file is missing or unreadable; Error(content) if it is not a .tiles file, truncated,
  /// damaged, or of a newer version.
  explicit TiledScene(const std::string& path);
  ~TiledScene();
  TiledScene(TiledScene&&) noexcept;

  /// Returns facts about the whole scene.
  const TiledSceneInfo& info() const;

  /// Returns the tiles that may hold a surfel within the region.
  TileSelection select(const InsonifiedRegion& region) const;
  /// Returns all tiles.
  TileSelection select_all() const;

  /// Returns the surfels of the selected tiles by ascending id, with the ids and order of the whole scene, and with
  /// part_of set. A scene that extends less than 2000 m from its origin keeps its origin, and every point its bits. For
  /// a wider scene the cloud's origin is a multiple of 256 m near the region, and points are accurate to 2e-4 m within
  /// 2000 m of it, for any size of the scene. Does not depend on `threads`.
  /// memory   limit for loading [bytes]; 0: the available memory. Throws Error(runtime) if more is needed, before
  ///          anything is read; Error(content) if a tile is damaged.
  SceneCloud load(const TileSelection& selection, double memory = 0, int threads = 0) const;

  /// Returns the result of cut_scene for the whole scene, but reads only coarse levels of distant parts. Does not
  /// depend on options.threads.
  /// most_surfels   limit for surfels and nodes. Throws Error(memory) if there are more; Error(content) if what is read
  /// is damaged.
  TiledCut cut(const InsonifiedRegion& region, const BeamFan& fan, const RangeGate& gate, const CutOptions& options,
               double most_surfels = std::numeric_limits<double>::infinity()) const;

  /// Returns the centres of the tiles (world, [m]).
  std::vector<Eigen::Vector3d> positions() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Throws Error(runtime) naming `path` if `selection` needs more than `memory` [bytes] at `bytes_per_surfel`.
void require_memory(const TileSelection& selection, double bytes_per_surfel, double memory, const std::string& path);

}  // namespace insonify
