// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/parallel.hpp"
#include "sampling/direction_raster_internal.hpp"
#include "sampling/list_where_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3f;

constexpr std::size_t directions_at_once = 8192;
constexpr float cells_per_footprint = 2;                   // along one side of a typical bounding box
constexpr float most_cells_per_surfel = 64;                // upper limit of the average
constexpr float slack_factor = 1.001f, box_slack = 4e-6f;  // boxes slightly wider than footprints, for rounding

// Bounding box of a footprint on one face: centre and half extents.
struct Extent {
  float x, y, half_x, half_y;
};

// The box round the three corners. False if one of them is behind the head along the face's axis.
bool project(const GatedFacet& facet, std::uint32_t face, Extent& box) {
  const int k = static_cast<int>(face / 2), i = (k + 1) % 3, j = (k + 2) % 3;
  const float sign = face % 2 == 0 ? 1.0f : -1.0f;
  Eigen::Array2f low = Eigen::Array2f::Constant(std::numeric_limits<float>::max()), high = -low;
  for (const Vector3f& c : facet.corner) {
    const float d = sign * c[k];
    if (!(d > 0)) return false;
    const Eigen::Array2f at(c[i] / d, c[j] / d);
    low = low.min(at), high = high.max(at);
  }
  const Eigen::Array2f middle = 0.5f * (low + high), half = 0.5f * (high - low);
  box = {middle.x(), middle.y(), half.x() * slack_factor + box_slack, half.y() * slack_factor + box_slack};
  return true;
}

// For v in the disc or ball, p + v projects to x + (v . w) / (d + v . f) with w = e_x - x f; bounding numerator and
// denominator separately gives the box.
bool project(const GatedSurfel& s, std::uint32_t face, Footprint footprint, Extent& box) {
  const int k = static_cast<int>(face / 2), i = (k + 1) % 3, j = (k + 2) % 3;
  const float sign = face % 2 == 0 ? 1.0f : -1.0f, d = sign * s.position[k], nf = sign * s.away[k];
  // Half extents of disc or ball along a vector of squared length w2 with n . w = nw.
  const auto reach = [&](float w2, float nw) {
    if (footprint == Footprint::cone) return s.radius * std::sqrt(w2);
    return hiding_reach * s.radius * std::sqrt(std::max(0.0f, w2 - nw * nw));
  };
  const float front = d - reach(1, nf);
  if (!(front > 0)) return false;
  const float per_d = 1 / d, per_front = slack_factor / front;
  box.x = s.position[i] * per_d;
  box.y = s.position[j] * per_d;
  box.half_x = reach(1 + box.x * box.x, s.away[i] - box.x * nf) * per_front + box_slack;
  box.half_y = reach(1 + box.y * box.y, s.away[j] - box.y * nf) * per_front + box_slack;
  return true;
}

bool project(const GatedSurfels& surfels, std::uint32_t index, std::uint32_t face, Footprint footprint, Extent& box) {
  const bool by_facet = footprint == Footprint::disc && !surfels.facet.empty();
  return by_facet ? project(surfels.facet[index], face, box) : project(surfels[index], face, footprint, box);
}

bool stays_on_face(const Extent& e) { return std::abs(e.x) + e.half_x <= 1 && std::abs(e.y) + e.half_y <= 1; }

std::uint32_t main_face(const Vector3f& v) {
  int k = 0;
  v.cwiseAbs().maxCoeff(&k);
  return static_cast<std::uint32_t>(2 * k + (v[k] < 0));
}

// Replaces counts[block][tile] by the index at which the entries of each block begin in each tile; returns the begin of
// each tile and the total.
std::vector<std::size_t> starts_of(std::vector<std::vector<std::size_t>>& counts, std::size_t tiles) {
  std::vector<std::size_t> first(tiles + 1, 0);
  std::size_t total = 0;
  for (std::size_t t = 0; t < tiles; ++t) {
    for (auto& of_block : counts) total += std::exchange(of_block[t], total);
    first[t + 1] = total;
  }
  return first;
}

}  // namespace

CubePoint on_cube(const Vector3f& v) {
  const std::uint32_t face = main_face(v);
  const int k = static_cast<int>(face / 2);
  const float depth = std::abs(v[k]);
  return {face, v[(k + 1) % 3] / depth, v[(k + 2) % 3] / depth, depth};
}

std::size_t DirectionTile::cell_of(const CubePoint& q) const {
  const auto step = [](float cells) {
    return static_cast<std::size_t>(std::clamp(static_cast<int>(cells), 0, side - 1));
  };
  return step((q.y - y) / cell_y) * side + step((q.x - x) / cell_x);
}

DirectionRaster::DirectionRaster(const GatedSurfels& surfels, std::span<const CubePoint> queries, Footprint footprint,
                                 int threads) {
  bound_faces(queries, threads);
  size_cells(surfels, queries, footprint);

  std::vector<std::vector<Box>> boxes((surfels.size() + directions_at_once - 1) / directions_at_once);
  parallel_blocks(surfels.size(), directions_at_once, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Box>& block = boxes[begin / directions_at_once];
    block.reserve(end - begin);
    for (std::size_t s = begin; s < end; ++s) add_boxes(surfels, static_cast<std::uint32_t>(s), footprint, block);
  });
  wide_ = list_where(surfels.size(), threads, [&](std::size_t s) { return is_wide(surfels[s]); });
  sort_boxes(boxes, threads);
  sort_queries(queries, threads);
}

void DirectionRaster::bound_faces(std::span<const CubePoint> queries, int threads) {
  std::vector<std::array<Face, 6>> blocks((queries.size() + directions_at_once - 1) / directions_at_once);
  parallel_blocks(queries.size(), directions_at_once, threads, [&](std::size_t begin, std::size_t end) {
    for (const CubePoint& q : queries.subspan(begin, end - begin))
      blocks[begin / directions_at_once][q.face].include(q.x, q.y);
  });
  for (const auto& block : blocks)
    for (std::size_t f = 0; f < faces_.size(); ++f)
      if (block[f].x1 >= block[f].x0) {
        faces_[f].include(block[f].x0, block[f].y0);
        faces_[f].include(block[f].x1, block[f].y1);
      }
}

// A typical footprint should cover a few cells of its face, with a bounded total number of cells per surfel and query.
void DirectionRaster::size_cells(const GatedSurfels& surfels, std::span<const CubePoint> queries, Footprint footprint) {
  struct Typical {
    double log_x = 0, log_y = 0, area = 0, count = 0;
  };
  std::array<Typical, 6> typical;
  const std::size_t stride = surfels.size() / 4096 + 1;
  for (std::size_t s = 0; s < surfels.size(); s += stride) {
    Extent e;
    if (is_wide(surfels[s]) || !(surfels[s].radius > 0)) continue;
    const std::uint32_t face = main_face(surfels[s].position);
    if (!project(surfels, static_cast<std::uint32_t>(s), face, footprint, e)) continue;
    Typical& of_face = typical[face];
    of_face.log_x += std::log(2.0 * e.half_x);
    of_face.log_y += std::log(2.0 * e.half_y);
    of_face.area += 4.0 * e.half_x * e.half_y;
    ++of_face.count;
  }
  const double most_cells = 4.0 * static_cast<double>(surfels.size() + queries.size()) + 4096;
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    Face& face = faces_[f];
    if (face.x1 < face.x0) continue;
    const Typical& t = typical[f];
    const double width = face.x1 - face.x0, height = face.y1 - face.y0;
    double x = t.count > 0 ? std::exp(t.log_x / t.count) / cells_per_footprint : 1;
    double y = t.count > 0 ? std::exp(t.log_y / t.count) / cells_per_footprint : 1;
    const double cells_per_surfel = t.count > 0 ? t.area / t.count / (x * y) : 0;
    const double larger =
        std::sqrt(std::max({1.0, cells_per_surfel / most_cells_per_surfel, width * height / (x * y) / most_cells}));
    face.cell_x = static_cast<float>(std::max({x * larger, width / 60000, 1e-5}));
    face.cell_y = static_cast<float>(std::max({y * larger, height / 60000, 1e-5}));
    face.per_x = 1 / face.cell_x, face.per_y = 1 / face.cell_y;
    face.nx = static_cast<int>(width / face.cell_x) + 1;
    face.ny = static_cast<int>(height / face.cell_y) + 1;
    face.columns = (face.nx + DirectionTile::side - 1) / DirectionTile::side;
    face.first_tile = tiles_.size();
    const int rows = (face.ny + DirectionTile::side - 1) / DirectionTile::side;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < face.columns; ++column)
        tiles_.push_back({f, static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row)});
  }
}

void DirectionRaster::add_boxes(const GatedSurfels& surfels, std::uint32_t index, Footprint footprint,
                                std::vector<Box>& boxes) const {
  const GatedSurfel& s = surfels[index];
  if (!(s.radius > 0) || is_wide(s)) return;
  const auto add = [&](std::uint32_t f, const Extent& e) {
    const Face& face = faces_[f];
    const float x0 = (e.x - e.half_x - face.x0) * face.per_x, x1 = (e.x + e.half_x - face.x0) * face.per_x;
    const float y0 = (e.y - e.half_y - face.y0) * face.per_y, y1 = (e.y + e.half_y - face.y0) * face.per_y;
    if (face.nx == 0 || !(x1 >= 0 && y1 >= 0 && x0 < static_cast<float>(face.nx) && y0 < static_cast<float>(face.ny)))
      return;
    const auto clip = [](float v, int n) {
      return static_cast<std::uint16_t>(std::clamp(v, 0.0f, static_cast<float>(n - 1)));
    };
    boxes.push_back({index, static_cast<std::uint16_t>(f), clip(x0, face.nx), clip(x1, face.nx), clip(y0, face.ny),
                     clip(y1, face.ny)});
  };
  Extent e;
  const std::uint32_t home = main_face(s.position);
  if (!project(surfels, index, home, footprint, e)) return;
  add(home, e);
  if (stays_on_face(e)) return;
  for (std::uint32_t f = 0; f < faces_.size(); ++f)
    if (f != home && faces_[f].nx > 0 && project(surfels, index, f, footprint, e)) add(f, e);
}

// Counting sort by tile; a box that crosses tiles is clipped and added to each.
void DirectionRaster::sort_boxes(const std::vector<std::vector<Box>>& boxes, int threads) {
  constexpr int side = DirectionTile::side;
  const auto for_tiles = [this](const Box& box, auto&& use) {
    const Face& face = faces_[box.face];
    for (int row = box.y0 / side; row <= box.y1 / side; ++row)
      for (int column = box.x0 / side; column <= box.x1 / side; ++column)
        use(face.first_tile + static_cast<std::size_t>(row * face.columns + column), column * side, row * side);
  };
  std::vector<std::vector<std::size_t>> next(boxes.size(), std::vector<std::size_t>(tiles_.size(), 0));
  parallel_for(boxes.size(), threads, [&](std::size_t b) {
    for (const Box& box : boxes[b]) for_tiles(box, [&](std::size_t t, int, int) { ++next[b][t]; });
  });
  first_box_ = starts_of(next, tiles_.size());
  boxes_.resize(first_box_.back());
  parallel_for(boxes.size(), threads, [&](std::size_t b) {
    for (const Box& box : boxes[b])
      for_tiles(box, [&](std::size_t t, int x, int y) {
        const auto low = [](int v, int corner) { return static_cast<std::uint8_t>(std::max(0, v - corner)); };
        const auto high = [](int v, int corner) { return static_cast<std::uint8_t>(std::min(side - 1, v - corner)); };
        boxes_[next[b][t]++] = {box.surfel, low(box.x0, x), high(box.x1, x), low(box.y0, y), high(box.y1, y)};
      });
  });
}

void DirectionRaster::sort_queries(std::span<const CubePoint> queries, int threads) {
  const auto tile_of = [this](const CubePoint& q) {
    const Face& face = faces_[q.face];
    const int x = std::min(face.nx - 1, static_cast<int>((q.x - face.x0) * face.per_x));
    const int y = std::min(face.ny - 1, static_cast<int>((q.y - face.y0) * face.per_y));
    return face.first_tile + static_cast<std::size_t>(y / DirectionTile::side * face.columns + x / DirectionTile::side);
  };
  UninitializedVector<std::uint32_t> tile(queries.size());
  std::vector<std::vector<std::size_t>> next((queries.size() + directions_at_once - 1) / directions_at_once,
                                             std::vector<std::size_t>(tiles_.size(), 0));
  parallel_blocks(queries.size(), directions_at_once, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t q = begin; q < end; ++q) {
      tile[q] = static_cast<std::uint32_t>(tile_of(queries[q]));
      ++next[begin / directions_at_once][tile[q]];
    }
  });
  first_query_ = starts_of(next, tiles_.size());
  queries_.resize(queries.size());
  parallel_blocks(queries.size(), directions_at_once, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t q = begin; q < end; ++q)
      queries_[next[begin / directions_at_once][tile[q]]++] = static_cast<std::uint32_t>(q);
  });
}

DirectionTile DirectionRaster::tile(std::size_t t) const {
  const Face& face = faces_[tiles_[t].face];
  constexpr auto side = static_cast<float>(DirectionTile::side);
  DirectionTile tile;
  tile.face = tiles_[t].face;
  tile.cell_x = face.cell_x;
  tile.cell_y = face.cell_y;
  tile.x = face.x0 + static_cast<float>(tiles_[t].column) * side * face.cell_x;
  tile.y = face.y0 + static_cast<float>(tiles_[t].row) * side * face.cell_y;
  tile.boxes = std::span(boxes_).subspan(first_box_[t], first_box_[t + 1] - first_box_[t]);
  tile.queries = std::span(queries_).subspan(first_query_[t], first_query_[t + 1] - first_query_[t]);
  return tile;
}

}  // namespace insonify
