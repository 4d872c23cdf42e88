// SPDX-License-Identifier: BSD-3-Clause
// Levels of detail (E137):
//   1. sort the surfels by the Morton code of their finest cell;
//   2. level by level, merge what lies in one cell and is one flat piece; what does not merge is carried on alone;
//   3. what is left are the roots, sorted and divided into blocks.
#include "scene/detail_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/morton.hpp"
#include "core/parallel.hpp"
#include "core/radix_sort.hpp"
#include "scene/merge_surfels_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3f;

constexpr int finest_below_spacing = 3;  // halvings of the spacing down to the finest cells
constexpr std::size_t entries_at_once = 1 << 14;
constexpr std::size_t roots_per_block = 64;

/// A surfel or node that no other node holds yet.
struct Entry {
  std::uint64_t code;   // Morton code of its finest cell
  std::uint32_t index;  // number as in DetailLevels::child
};

/// Morton codes of finest cells. Coordinates are counted from far below, so that they are not negative.
class FinestCells {
 public:
  explicit FinestCells(double spacing) : exponent_(std::ilogb(finest_cell(spacing))) {}
  double edge(int level) const { return std::ldexp(1.0, exponent_ + level); }
  /// Returns true if a point has a code. Points too far from the origin have none.
  bool holds(const Vector3f& p) const {
    return (p.cast<double>() / edge(0)).cwiseAbs().maxCoeff() < (1 << (morton_bits - 1)) - 1;
  }
  std::uint64_t code(const Vector3f& p) const {
    std::array<std::uint32_t, 3> cell{};
    for (int axis = 0; axis < 3; ++axis)
      cell[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(
          static_cast<std::int64_t>(std::floor(p[axis] / edge(0))) + (std::int64_t{1} << (morton_bits - 1)));
    return morton_code(cell);
  }

 private:
  int exponent_;
};

/// The result of merging one run of a level's cells.
struct LevelBlock {
  std::vector<DetailNode> nodes;
  std::vector<std::uint32_t> children;
  std::vector<Entry> open, closed;  // the index of a new node is new_node + its number in `nodes`
};

constexpr std::uint32_t new_node = std::uint32_t{1} << 31;  // above all numbers of surfels and nodes
constexpr std::size_t most_surfels = std::size_t{1} << 30;

void merge_cell(const MergedPieces& pieces, std::span<const Entry> cell, double edge, LevelBlock& out) {
  if (cell.size() == 1) return out.open.push_back(cell[0]);
  if (cell.size() > MergedPieces::most) {
    out.closed.insert(out.closed.end(), cell.begin(), cell.end());
    return;
  }
  std::array<std::uint32_t, MergedPieces::most> index;
  for (std::size_t k = 0; k < cell.size(); ++k) index[k] = cell[k].index;
  const std::span<const std::uint32_t> members(index.data(), cell.size());
  const MergedPieces::Groups groups = pieces.grouped(members);
  if (groups.count == 0) out.open.insert(out.open.end(), cell.begin(), cell.end());
  for (std::size_t g = 0; g < groups.count; ++g) {
    const MergedPieces::Group& group = groups.group[g];
    if (std::optional<DetailNode> merged = pieces.merged(group, members, static_cast<float>(edge))) {
      out.open.push_back({cell[group.member[0]].code, new_node + static_cast<std::uint32_t>(out.nodes.size())});
      merged->first_child = static_cast<std::uint32_t>(out.children.size());
      out.nodes.push_back(*merged);
      for (const std::uint8_t m : group.all()) out.children.push_back(index[m]);
    } else {
      for (const std::uint8_t m : group.all()) out.open.push_back(cell[m]);
    }
  }
}

/// Divides the entries into runs that share no cell of this level. Returns the first entry of each run, and the end.
std::vector<std::size_t> part_begins(const std::vector<Entry>& entries, int shift) {
  std::vector<std::size_t> begin{0};
  for (std::size_t at = entries_at_once; at < entries.size(); at = begin.back() + entries_at_once) {
    while (at < entries.size() && entries[at].code >> shift == entries[at - 1].code >> shift) ++at;
    if (at == entries.size()) break;
    begin.push_back(at);
  }
  begin.push_back(entries.size());
  return begin;
}

/// Returns the surfels as entries, sorted along the Morton curve. Surfels without a code become roots.
std::vector<Entry> entries_of(const SceneCloud& scene, const FinestCells& cells, int threads,
                              std::vector<std::uint32_t>& roots) {
  std::vector<Entry> entries;
  entries.reserve(scene.size());
  for (std::uint32_t i = 0; i < scene.size(); ++i) {
    if (cells.holds(scene.point[i]))
      entries.push_back({0, i});
    else
      roots.push_back(i);
  }
  parallel_blocks(entries.size(), entries_at_once, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) entries[k].code = cells.code(scene.point[entries[k].index]);
  });
  radix_sort(entries, 0, 3 * morton_bits, [](const Entry& e) { return e.code; });
  return entries;
}

/// Appends the result of one run to the levels, with the numbers of its nodes and children counted among all.
void take(const LevelBlock& block, DetailLevels& levels, std::vector<Entry>& open, std::vector<Entry>& closed) {
  const auto nodes_before = static_cast<std::uint32_t>(levels.surfels + levels.node.size());
  const auto children_before = static_cast<std::uint32_t>(levels.child.size());
  for (DetailNode node : block.nodes) {
    node.first_child += children_before;
    levels.node.push_back(node);
  }
  levels.child.insert(levels.child.end(), block.children.begin(), block.children.end());
  closed.insert(closed.end(), block.closed.begin(), block.closed.end());
  for (Entry e : block.open) {
    if (e.index >= new_node) e.index = e.index - new_node + nodes_before;
    open.push_back(e);
  }
}

/// Merges the open entries that share a cell of this level. Threads work on runs that share no cell.
void merge_level(const SceneCloud& scene, int level, double edge, int threads, DetailLevels& levels,
                 std::vector<Entry>& open, std::vector<Entry>& closed) {
  const int shift = 3 * level;
  const std::vector<std::size_t> begin = part_begins(open, shift);
  std::vector<LevelBlock> blocks(begin.size() - 1);
  const MergedPieces pieces(scene, levels.node);
  parallel_for(blocks.size(), threads, [&](std::size_t p) {
    for (std::size_t k = begin[p], next; k < begin[p + 1]; k = next) {
      for (next = k + 1; next < begin[p + 1] && open[next].code >> shift == open[k].code >> shift;) ++next;
      merge_cell(pieces, std::span(open).subspan(k, next - k), edge, blocks[p]);
    }
  });
  open.clear();
  for (const LevelBlock& block : blocks) take(block, levels, open, closed);
}

void enclose(const SceneCloud& scene, const DetailLevels& levels, DetailBlock& block) {
  Vector3f low = Vector3f::Constant(std::numeric_limits<float>::max()), high = -low;
  for (std::uint32_t k = block.begin; k < block.end; ++k) {
    const std::uint32_t root = levels.root[k];
    const bool is_node = root >= levels.surfels;
    const DetailNode* const node = is_node ? &levels.node[root - levels.surfels] : nullptr;
    const Vector3f reach = Vector3f::Constant(node ? node->extent : 0), point = node ? node->point : scene.point[root];
    low = low.cwiseMin(point - reach), high = high.cwiseMax(point + reach);
    // A node's surfels are no larger than the node.
    block.largest_area = std::max(block.largest_area, node ? node->area : scene.area[root]);
  }
  constexpr float rounding = 1 + 1e-5f;
  block.centre = low + (high - low) / 2;
  block.radius = (high - low).norm() / 2 * rounding;
}

}  // namespace

double finest_cell(double spacing) { return std::ldexp(1.0, std::ilogb(spacing) - finest_below_spacing); }

DetailLevels detail_levels(const SceneCloud& scene, double spacing, int threads) {
  constexpr const char* me = "detail_levels";
  if (!scene.facet.empty()) fail(ErrorKind::argument, me, ": the surfels have facets, must be discs");
  if (scene.size() > most_surfels) fail(ErrorKind::argument, me, ": ", scene.size(), " surfels, must be at most 2^30");
  DetailLevels levels;
  levels.surfels = scene.size();
  const FinestCells cells(spacing > 0 ? spacing : 1);
  std::vector<Entry> open = entries_of(scene, cells, threads, levels.root), closed;
  for (int level = 0; spacing > 0 && level <= detail_doublings; ++level)
    merge_level(scene, level, cells.edge(level), threads, levels, open, closed);

  // Sort the roots that the last level left along the curve again.
  open.insert(open.end(), closed.begin(), closed.end());
  radix_sort(open, 0, 3 * morton_bits, [](const Entry& e) { return e.code; });
  for (const Entry& e : open) levels.root.push_back(e.index);
  levels.block.resize((levels.root.size() + roots_per_block - 1) / roots_per_block);
  parallel_for(levels.block.size(), threads, [&](std::size_t b) {
    DetailBlock& block = levels.block[b];
    block.begin = static_cast<std::uint32_t>(b * roots_per_block);
    block.end = static_cast<std::uint32_t>(std::min(levels.root.size(), (b + 1) * roots_per_block));
    enclose(scene, levels, block);
  });
  return levels;
}

}  // namespace insonify
