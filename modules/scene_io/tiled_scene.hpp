// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "sampling/insonified_region.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Contents of the header of a .tiles file.
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
};

/// Tiles to be loaded, and their size.
struct TileSelection {
  std::vector<std::uint32_t> tiles;
  std::size_t surfels = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m], of the loaded cloud
  /// Returns the memory that loading them takes [bytes].
  double bytes_to_load() const { return 64.0 * static_cast<double>(surfels); }
};

/// A prepared scene on disk, of which only the tiles near a head are read: scenes far larger than memory can be pinged.
/// TileWriter makes one. Steps and cost:
///   opening   reads the directory, 80 bytes per tile of at most 4096 surfels
///   select    tests the enclosing ball of every tile against the insonified region: constant cost per tile
///   load reads the selected tiles in parallel, checks them, and sorts their surfels by id, so that the cloud is the
///             whole scene with the others left out; tiles may be kept in memory for the next load
///
///   const TiledScene tiled("bay.tiles");
///   const InsonifiedRegion region = simulator.reach(tiled.info().whole, event);
///   const SceneCloud part = tiled.load(tiled.select(region));
///   simulate_ping(part, head, pose, environment, options);  // the same bytes as of the whole scene
class TiledScene {
 public:
  /// kept_bytes   of tiles that were read stay in memory, the least recently used are dropped first; 0: none
  /// Throws Error(file) if the file is missing or unreadable; Error(content) if it is not a .tiles file, truncated,
  /// damaged, incomplete or of a newer version.
  explicit TiledScene(const std::string& path, std::size_t kept_bytes = 0);
  ~TiledScene();
  TiledScene(TiledScene&&) noexcept;

  /// Returns what the directory of the file says of the whole scene.
  const TiledSceneInfo& info() const;

  /// The tiles that may hold a surfel within the region.
  TileSelection select(const InsonifiedRegion& region) const;
  /// All tiles.
  TileSelection select_all() const;

  /// The surfels of the selected tiles by ascending id, with the ids and order of the whole scene, and part_of set.
  /// Scenes that extend less than 2000 m from their origin keep it, and every point its bits; for wider ones the
  /// cloud's origin is a multiple of 256 m near the region, and points are accurate to 2e-4 m within 2000 m of it,
  /// whatever the size of the scene. Does not depend on `threads`.
  /// memory   limit for loading [bytes]; 0: the available memory. Throws Error(runtime) if more is needed, before
  ///          anything is read; Error(content) if a tile is damaged.
  SceneCloud load(const TileSelection& selection, double memory = 0, int threads = 0) const;

  /// How many tiles were read from the file so far: kept ones are not read again.
  std::uint64_t tiles_read() const;

  /// Centres of the tiles (world, [m]).
  std::vector<Eigen::Vector3d> places() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Available memory [bytes]; infinite if unknown.
double available_memory();

/// Throws Error(runtime) naming `path` if `selection` needs more than `memory` [bytes] at `bytes_per_surfel`.
void require_memory(const TileSelection& selection, double bytes_per_surfel, double memory, const std::string& path);

}  // namespace insonify
