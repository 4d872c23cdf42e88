// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "sampling/gate_surfels_internal.hpp"

namespace insonify {

/// Projection of a vector from the head onto a cube around it: face 0 .. 5 (+x, -x, +y, ...), coordinates on it in -1
/// .. 1 along the next two axes, and the component of the vector along the face's axis.
struct CubePoint {
  std::uint32_t face;
  float x, y;
  float depth;  ///< > 0, [m] for positions
};
CubePoint on_cube(const Eigen::Vector3f& v);

/// Which footprint of a surfel is rasterised.
enum class Footprint {
  disc,  ///< where it may help to occlude another surfel (`cover`): its disc, hiding_reach times as wide, or its facet
  cone   ///< where a ray may hit it (`hit_surface`): the cone around a ball of its radius, which holds its facet
};

/// Range of cells of one tile that a footprint may overlap, inclusive.
struct TileBox {
  std::uint32_t surfel;
  std::uint8_t x0, x1, y0, y1;
};

/// A tile of as many rows as columns of cells on one face of the cube.
struct DirectionTile {
  static constexpr int side = 64;  ///< cells

  std::uint32_t face = 0;
  float x = 0, y = 0;                      ///< lower corner
  float cell_x = 0, cell_y = 0;            ///< widths of a cell
  std::span<const TileBox> boxes;          ///< footprints that overlap the tile, by surfel
  std::span<const std::uint32_t> queries;  ///< indices of the queries in the tile, ascending
  std::size_t cell_of(const CubePoint& q) const;
};

/// Linked lists of entries of type T, one list per cell of a tile.
template <typename T>
class CellLists {
 public:
  CellLists() { first_.fill(none); }

  void clear() {
    first_.fill(none);
    links_.clear();
  }
  bool empty() const { return links_.empty(); }
  void add(const T& entry, std::size_t cell) {
    links_.push_back({entry, first_[cell]});
    first_[cell] = static_cast<std::uint32_t>(links_.size() - 1);
  }
  /// Calls use(entry) for all entries in the cells of the box.
  template <typename Use>
  void for_each(const TileBox& box, Use&& use) {
    for (std::size_t y = box.y0; y <= box.y1; ++y)
      for (std::size_t x = box.x0; x <= box.x1; ++x)
        for (std::uint32_t at = first_[y * DirectionTile::side + x]; at != none; at = links_[at].next)
          use(links_[at].entry);
  }

 private:
  static constexpr std::uint32_t none = ~0u;
  struct Link {
    T entry;
    std::uint32_t next;
  };
  std::array<std::uint32_t, DirectionTile::side * DirectionTile::side> first_;
  std::vector<Link> links_;
};

/// Rasterises the footprints of surfels over the queried directions: cells on a cube around the head, on each face as
/// wide and as high as suits its typical footprint, in tiles of 64 x 64 cells that are processed independently. In the
/// coordinates of a face the inverse depth of a surfel's plane is linear and its footprint has a bounding box in closed
/// form, so no angle is computed. Building costs O(surfels + queries) by counting sort.
class DirectionRaster {
 public:
  /// Keeps a reference to `queries`.
  DirectionRaster(const GatedSurfels& surfels, std::span<const CubePoint> queries, Footprint footprint, int threads);

  std::size_t tiles() const { return tiles_.size(); }
  DirectionTile tile(std::size_t t) const;
  /// Surfels with a half-angle above 14 degrees: they are in no tile and must be tested one by one.
  const std::vector<std::uint32_t>& wide() const { return wide_; }

  /// Returns true if a surfel belongs to wide().
  static bool is_wide(const GatedSurfel& s) { return s.radius > widest_ * s.range; }

 private:
  struct Face {
    float x0 = 1, x1 = -1, y0 = 1, y1 = -1;  // bounds of the queries on the face
    float cell_x = 1, cell_y = 1;            // widths of a cell
    float per_x = 1, per_y = 1;              // cells per length
    int nx = 0, ny = 0;                      // cells
    int columns = 0;                         // tiles in a row
    std::size_t first_tile = 0;

    void include(float x, float y) {
      x0 = std::min(x0, x);
      x1 = std::max(x1, x);
      y0 = std::min(y0, y);
      y1 = std::max(y1, y);
    }
  };
  struct Tile {
    std::uint32_t face, column, row;
  };
  struct Box {
    std::uint32_t surfel;
    std::uint16_t face, x0, x1, y0, y1;
  };

  void bound_faces(std::span<const CubePoint> queries, int threads);
  void size_cells(const GatedSurfels& surfels, std::span<const CubePoint> queries, Footprint footprint);
  void add_boxes(const GatedSurfels& surfels, std::uint32_t index, Footprint footprint, std::vector<Box>& boxes) const;
  void sort_boxes(const std::vector<std::vector<Box>>& boxes, int threads);
  void sort_queries(std::span<const CubePoint> queries, int threads);

  // Below 0.244, a disc of hiding_reach that overlaps the directions of a face lies entirely in front of the head along
  // the face's axis.
  static constexpr float widest_ = 0.24f;

  std::array<Face, 6> faces_;
  std::vector<Tile> tiles_;
  std::vector<std::uint32_t> wide_;
  UninitializedVector<TileBox> boxes_;
  UninitializedVector<std::uint32_t> queries_;
  std::vector<std::size_t> first_box_, first_query_;  // begin of each tile, and the end
};

}  // namespace insonify
