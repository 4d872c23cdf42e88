// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sampling/direction_raster_internal.hpp"
#include "sampling/hit_rule_internal.hpp"
#include "sampling/visibility_loops_internal.hpp"

namespace insonify {

/// The surfels of a tile that may be hidden, cell by cell; their numbers stand side by side for vector loops.
class OpenList {
 public:
  struct Entry {
    std::uint32_t surfel;
    Cover so_far;
    std::uint32_t line;  ///< its number among the lines of sight made so far
  };
  std::vector<Entry> entries{};

  /// Keeps a reference to the surfels.
  explicit OpenList(const GatedSurfels& surfels) : surfels_(surfels) {}

  /// Sets the entries.
  void fill(std::span<const std::uint32_t> surfels);
  /// Takes an entry out of what `numbers` lists: it lies in the head, where nothing hides it.
  void take_out(std::size_t entry);
  void move(std::size_t from, std::size_t to);
  /// Keeps the first entries.
  void keep(std::size_t count);
  /// Returns the line of sight to an entry, made once.
  const LineOfSight& line_to(Entry& entry);

  /// Returns what a surfel hides, with room for rounding.
  kernels::HidingDisc disc_of(std::uint32_t surfel) const;
  kernels::OpenSurfels numbers() const;

 private:
  const GatedSurfels& surfels_;
  std::array<std::vector<float>, 6> numbers_{};  // members of kernels::OpenSurfels, with zeros behind
  std::vector<LineOfSight> lines_{};
};

/// Depth buffer of one tile: for each cell the inverse of the least depth at which a surfel may be hidden. Surfels in
/// front of it are visible; only those behind it are tested one by one.
class DepthTile {
 public:
  /// Keeps references to all; queries: the queried surfels, projected.
  DepthTile(const GatedSurfels& surfels, std::span<const std::uint32_t> queried, std::span<const CubePoint> queries)
      : surfels_(surfels), queried_(queried), queries_(queries), open_(surfels) {}

  /// Sets the covers of the queries in the tile that are behind something.
  void find_covers(const DirectionTile& tile, std::vector<Cover>& covers);

 private:
  static constexpr std::size_t side = DirectionTile::side;
  static_assert(side == 64, "a bit for each cell of a row");

  void draw(const DirectionTile& tile, const TileBox& box);
  /// Lists the queries behind the buffer, by counting sort cell by cell.
  void sort_open(const DirectionTile& tile);
  /// Lists the open entries that may be behind the surfel of a box; returns their number.
  std::size_t list_behind(const TileBox& box);
  /// Takes those that are hidden off the list, in which each other box would meet them.
  void drop_hidden(std::vector<Cover>& covers);

  const GatedSurfels& surfels_;
  std::span<const std::uint32_t> queried_;
  std::span<const CubePoint> queries_;
  std::array<float, side * side + kernels::visibility_lanes> nearest_;  // inverse depth of occluders
  std::array<std::uint64_t, side> queried_in_;                          // bits of cells with open queries, by rows
  std::array<std::uint32_t, side * side + 1> first_;                    // open entry of each cell
  OpenList open_;
  std::vector<std::uint32_t> behind_{};
  std::size_t hidden_ = 0;  // number of open surfels that are hidden
};

}  // namespace insonify
