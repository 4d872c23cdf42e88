#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "sampling/gate_surfels_internal.hpp"

namespace insonify {

/// Where a vector from the head pierces a cube round it: face 0 .. 5 (+x, -x, +y, ...), coordinates there in -1 .. 1
/// along the next two axes, and the vector's part along the face's axis.
struct CubePoint {
  std::uint32_t face;
  float x, y;
  float depth;  ///< > 0, [m] for positions
};
CubePoint on_cube(const Eigen::Vector3f& v);

/// What of a surfel is looked for in a direction.
enum class Footprint {
  disc,  ///< where it may hide another one (`hides`): its disc, and half a spacing round its centre
  cone   ///< where a ray may meet it (`hit_surface`): the cone round a ball of its radius
};

/// Cells of one tile that a surfel's footprint may touch, both ends included.
struct TileBox {
  std::uint32_t surfel;
  std::uint8_t x0, x1, y0, y1;
};

/// A square of directions on one face of the cube.
struct DirectionTile {
  static constexpr int side = 64;  ///< cells

  std::uint32_t face = 0;
  float x = 0, y = 0;                      ///< its lower corner
  float cell = 0;                          ///< width of a cell
  std::span<const TileBox> boxes;          ///< surfels that may stand in it, in order
  std::span<const std::uint32_t> queries;  ///< which directions asked about lie in it, in order
  std::size_t cell_of(const CubePoint& q) const;
};

/// Entries of type T, listed by cell of a tile.
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
  /// Calls use(entry) for the entries in the box's cells.
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

/// Footprints of surfels, rasterised over the directions that are asked about: cells on a cube round the head, sized
/// after the footprints, in tiles that are worked on independently. In the coordinates of a face a surfel's plane has a
/// linear inverse depth and its footprint a box in closed form, so no angle is ever computed.
class DirectionRaster {
 public:
  /// `queries` must stay alive.
  DirectionRaster(const std::vector<GatedSurfel>& surfels, std::span<const CubePoint> queries, Footprint footprint,
                  int threads);

  std::size_t tiles() const { return tiles_.size(); }
  DirectionTile tile(std::size_t t) const;
  /// Surfels that fill more than 14 degrees to either side: they stand in no tile and must be looked at one by one.
  const std::vector<std::uint32_t>& wide() const { return wide_; }

  /// True if a surfel's footprint is so wide.
  static bool is_wide(const GatedSurfel& s) { return s.radius > widest_ * s.range; }

 private:
  struct Face {
    float x0 = 1, x1 = -1, y0 = 1, y1 = -1;  // what queries fill of it
    int nx = 0, ny = 0;                      // cells
    int columns = 0;                         // tiles in a row
    std::size_t first_tile = 0;

    void take_in(float x, float y) {
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
  void size_cells(const std::vector<GatedSurfel>& surfels, std::span<const CubePoint> queries, Footprint footprint);
  void add_boxes(const GatedSurfel& s, std::uint32_t index, Footprint footprint, std::vector<Box>& boxes) const;
  void sort_boxes(const std::vector<std::vector<Box>>& boxes, int threads);
  void sort_queries(std::span<const CubePoint> queries, int threads);

  // Below 1/4, a disc that touches a face's directions lies wholly before the head as that face sees it.
  static constexpr float widest_ = 0.25f;

  std::array<Face, 6> faces_;
  float cell_ = 1;
  std::vector<Tile> tiles_;
  std::vector<std::uint32_t> wide_;
  std::vector<TileBox> boxes_;
  std::vector<std::uint32_t> queries_;
  std::vector<std::size_t> first_box_, first_query_;  // of each tile, and the end
};

}  // namespace insonify
