// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "scene/surfel_fault.hpp"
#include "tiles/tile_file_internal.hpp"

namespace insonify {
namespace {

bool is_size(double value) { return value >= 0 && std::isfinite(value); }

/// Returns true if the bounding ball of a tile or forest is finite.
template <typename Entry>
bool has_ball(const Entry& entry) {
  return vector_in(entry.reference).allFinite() && vector_in(entry.centre).allFinite() && is_size(entry.radius) &&
         is_size(entry.largest_area);
}

}  // namespace

void require_sound(bool good, const std::string& path, const char* what) {
  if (!good) fail(ErrorKind::content, path, ": the directory is damaged: ", what, "; copy or make the file again");
}

void require_whole(const TileDirectory& directory, std::uint64_t all_nodes, std::uint64_t all_children) {
  const TiledSceneInfo& info = directory.info;
  const auto require = [&](bool good, const char* what) { require_sound(good, info.path, what); };
  require(info.origin.allFinite() && info.box.min.allFinite() && info.box.max.allFinite() && is_size(info.total_area),
          "its origin, box or area is no number");
  require(info.surfels == 0 || !info.materials.empty(), "it has no material");
  std::uint64_t surfels = 0, tiles = 0, nodes = 0, children = 0;
  for (const TileEntry& tile : directory.tiles) {
    require(tile.first == surfels && tile.count <= info.surfels - surfels, "its tiles are not consecutive");
    require(has_ball(tile), "a tile has no ball that holds its points");
    surfels += tile.count;
  }
  require(surfels == info.surfels, "its tiles do not add up to the surfels");
  for (const TileForest& f : directory.forests) {
    require(f.first_tile == tiles && f.tiles > 0 && f.tiles <= directory.tiles.size() - tiles &&
                f.first_node == nodes && f.first_child == children && f.loose <= f.child_end[0] &&
                f.first_row == directory.tiles[tiles].first,
            "its forests are not consecutive");
    require(has_ball(f), "a forest has no ball that holds its points");
    tiles += f.tiles;
    require(f.first_row + f.rows == (tiles < directory.tiles.size() ? directory.tiles[tiles].first : surfels),
            "a forest has other rows than its tiles");
    for (std::size_t g = 1; g < level_groups; ++g)
      require(f.node_end[g] >= f.node_end[g - 1] && f.child_end[g] >= f.child_end[g - 1], "groups are not consecutive");
    require(f.rows + f.node_end[level_groups - 1] <= std::numeric_limits<std::uint32_t>::max(),
            "a forest has more rows and nodes than numbers for them");
    nodes += f.node_end[level_groups - 1];
    children += f.child_end[level_groups - 1];
  }
  require(tiles == directory.tiles.size() && nodes == all_nodes && children == all_children,
          "its forests do not add up");
}

void require_values(const TileDirectory& directory, const TileEntry& tile, const SceneCloud& rows, std::size_t first) {
  if (const auto fault = find_fault(rows, first, first + tile.count, directory.info.materials.size()))
    fail(ErrorKind::content, directory.info.path, ": row ", tile.first + fault->surfel - first, ": ", fault->array,
         fault->what, "; copy or make the file again");
}

void require_values(const TileDirectory& directory, std::uint64_t number, const DetailNode& node) {
  const auto refuse = [&](const char* name, std::span<const float> values, const char* rule) {
    std::ostringstream text;
    for (const float value : values) text << (text.tellp() > 0 ? ", " : "") << value;
    fail(ErrorKind::content, directory.info.path, ": node ", number, ": ", name, " = ",
         values.size() > 1 ? "(" + text.str() + ")" : text.str(), ", must be ", rule, "; copy or make the file again");
  };
  // A cut computes sums and multiples of sizes; below this limit all of them are finite.
  constexpr float most = 1e30F;
  const auto require_size = [&](const char* name, const float& value) {
    if (!(value >= 0 && value <= most)) refuse(name, {&value, 1}, ">= 0 and at most 1e30");
  };
  if (!node.point.allFinite()) refuse("point", {node.point.data(), 3}, "finite");
  if (!node.position.allFinite()) refuse("place", {node.position.data(), 3}, "finite");
  if (!(std::abs(node.normal.squaredNorm() - 1.0F) <= 2e-3F))
    refuse("normal", {node.normal.data(), 3}, "a unit vector");
  require_size("area", node.area);
  require_size("own_area", node.own_area);
  require_size("extent", node.extent);
  require_size("thickness", node.thickness);
  require_size("cell", node.cell);
  require_size("noise", node.noise);
  if (node.children > 0 && node.cell == 0) refuse("cell", {&node.cell, 1}, "> 0");
  for (const float n : node.normals)
    if (!(std::abs(n) <= 1.01F)) refuse("normals", node.normals, "products of unit vectors");
  if (node.material >= directory.info.materials.size())
    fail(ErrorKind::content, directory.info.path, ": node ", number, ": material = ", node.material,
         ", must be below the number of materials, ", directory.info.materials.size(), "; copy or make the file again");
}

}  // namespace insonify
