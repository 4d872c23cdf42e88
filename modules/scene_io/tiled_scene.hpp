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

/// What stands at the head of a .tiles file.
struct TiledSceneInfo {
  std::string path;
  std::uint64_t surfels = 0, bytes = 0;
  std::size_t tiles = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m]
  Bounds box;                                        ///< world [m]; without surfels: min > max
  double total_area = 0;                             ///< [m^2]
  WholeScene whole;
  bool normals_oriented = true;
  std::vector<Material> materials;
};

/// Which tiles are to be loaded, and what that takes.
struct TileSelection {
  std::vector<std::uint32_t> tiles;
  std::size_t surfels = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m], of the cloud that they make
  double bytes_to_load() const { return 64.0 * static_cast<double>(surfels); }
};

/// A prepared scene on disk, of which only the tiles near a head are read: scenes far larger than memory can be pinged.
/// TileWriter makes one. Steps and cost:
///   opening   reads the directory, 80 bytes per tile of at most 4096 surfels
///   select    tests the enclosing ball of every tile against the insonified region: constant cost per tile
///   load      reads the selected tiles in parallel, checks them, and sorts their surfels by id, so that the cloud is the
///             whole scene with the others left out
///
///   const TiledScene tiled("bay.tiles");
///   const InsonifiedRegion region = ping_region(tiled.info().whole, head, pose, environment, options);
///   const SceneCloud part = tiled.load(tiled.select(region));
///   simulate_ping(part, head, pose, environment, options);  // the same bytes as of the whole scene
class TiledScene {
 public:
  /// Throws Error(file) if the file is missing or unreadable; Error(content) if it is no .tiles file, cut off, damaged,
  /// half-written or of a newer version.
  explicit TiledScene(const std::string& path);
  ~TiledScene();
  TiledScene(TiledScene&&) noexcept;

  const TiledSceneInfo& info() const;

  /// The tiles that can hold a surfel within reach.
  TileSelection select(const InsonifiedRegion& region) const;
  TileSelection select_all() const;

  /// Their surfels by ascending id, ids and order those of the whole scene, part_of set. Scenes that extend less than
  /// 2000 m from their origin keep it, and every point its bits; of wider ones the cloud's origin is a multiple of
  /// 256 m near the head, and points are good to 2e-4 m within 2000 m of it, whatever the size of the scene.
  /// memory   [bytes] that loading may take; 0: what the system has available. Throws Error(runtime) if it would take
  ///          more, before anything is read; Error(content) if a tile is damaged. Does not depend on `threads`.
  SceneCloud load(const TileSelection& selection, double memory = 0, int threads = 0) const;

  /// Middles of the tiles (world, [m]).
  std::vector<Eigen::Vector3d> places() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Memory that programs can still have [bytes]; infinite if the system does not say.
double available_memory();

/// Throws Error(runtime) naming `path` if `selection` would take more than `memory` [bytes] at `bytes_per_surfel`.
void require_memory(const TileSelection& selection, double bytes_per_surfel, double memory, const std::string& path);

}  // namespace insonify
