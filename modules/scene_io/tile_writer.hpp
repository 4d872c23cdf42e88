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

struct TileWriterOptions {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m]; points are stored relative to it
  std::vector<Material> materials = {Material{}};
  bool normals_oriented = true;
  bool drop_duplicates = false;     ///< of surfels at exactly one place keep the first
  bool estimate_areas = false;      ///< ignore the areas given, estimate them from the neighbours (E15)
  std::size_t tile_surfels = 4096;  ///< at most, in one tile
  std::size_t memory = 256 << 20;   ///< [bytes] that sorting may take; at least 1 MiB is used
  int threads = 0;                  ///< 0: all cores; the file does not depend on it
  std::function<void(double)>
      progress{};  ///< called with the part of finish() that is done, 0..1; may throw to give up
};

struct TileReport {
  std::uint64_t surfels = 0, dropped_duplicates = 0, bytes = 0;
  std::size_t tiles = 0;
  double total_area = 0;  ///< [m^2]
};

/// Writes a .tiles file from batches of surfels, in bounded memory however many there are. They wait in a nameless file
/// beside the output (48 bytes each, for a while twice) and are put in order of place by finish(), which then gives the
/// file its name: before that, and after any failure, nothing stands under it and nothing is left behind.
class TileWriter {
 public:
  /// Throws Error(argument) for invalid options, Error(file) if the folder cannot be written.
  explicit TileWriter(const std::string& path, const TileWriterOptions& options = {});
  ~TileWriter();

  /// Batches may differ in origin, not in their materials: an index means the writer's. Throws as require_valid, and
  /// Error(content) for more than 2^32 - 1 surfels in all.
  void add(const SceneCloud& batch);
  /// The same with places given in double [m], relative to the writer's origin, instead of batch.point.
  void add(const SceneCloud& batch, std::span<const Eigen::Vector3d> places);

  /// Once, at the end. Throws Error(file) if the file cannot be written.
  TileReport finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// All of a scene as a .tiles file, with its origin and materials.
TileReport save_tiles(const std::string& path, const SceneCloud& scene, TileWriterOptions options = {});

}  // namespace insonify
