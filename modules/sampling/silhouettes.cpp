// SPDX-License-Identifier: BSD-3-Clause
// Surfels at silhouettes (E172): a depth buffer over the faces of a cube around the head, as in z-buffering of splats;
// where two neighbouring cells see surfels of surfaces that do not meet, both stand at a silhouette.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sampling/direction_raster_internal.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "sampling/hit_rule_internal.hpp"
#include "sampling/silhouettes_internal.hpp"

namespace insonify {
namespace {

using Eigen::Array2f;
using Eigen::Array2i;
using Eigen::Vector3f;

constexpr double cells_per_surfel = 8, least_cells = 1 << 20;  // of the cube, at most
constexpr float smallest_cell = 1e-5f;                         // of a face of the cube
constexpr float square_reach = 0.6f;  // of a surfel's square, in its widths: half its side to half its diagonal
constexpr std::uint32_t nothing = ~std::uint32_t{0};

/// The cells of a face of the cube, in which the middles of some surfels lie.
struct CellsOfFace {
  Array2f low = Array2f::Constant(2), high = -low;
  float cell = 0;
  Array2i size = Array2i::Zero();

  void include(const CubePoint& p) { low = low.min(Array2f(p.x, p.y)), high = high.max(Array2f(p.x, p.y)); }
  double extent() const { return high.x() < low.x() ? 0 : (high - low).cast<double>().prod(); }
  std::size_t all() const { return index(size.x(), size.y() - 1); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x()) + static_cast<std::size_t>(x);
  }
  Array2i of(const Array2f& at) const {
    return ((at - low) / cell).max(0.0f).min((size - 1).cast<float>()).cast<int>();
  }
  Array2f middle(int x, int y) const {
    return low + cell * Array2f(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  }
};

/// The nearest surfel in each cell of the faces of a cube.
class NearestInCells {
 public:
  NearestInCells(const GatedSurfels& surfels, double least_cell) : surfels_(surfels) {
    for (const GatedSurfel& s : surfels) faces_[on_cube(s.position).face].include(on_cube(s.position));
    double extent = 0;
    for (const CellsOfFace& face : faces_) extent += face.extent();
    const double cells = std::max(least_cells, cells_per_surfel * static_cast<double>(surfels.size()));
    const double cell = std::max(least_cell, std::sqrt(extent / cells));
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      CellsOfFace& face = faces_[f];
      if (face.high.x() < face.low.x()) continue;
      face.cell = std::max(static_cast<float>(cell), smallest_cell);
      face.size = ((face.high - face.low) / face.cell).cast<int>() + 1;
      nearest_[f].resize(face.all());
    }
    for (std::uint32_t s = 0; s < surfels.size(); ++s) draw(s);
  }

  /// Calls use(a, b) with the nearest surfels of all neighbouring cells of a face that see two.
  template <typename Use>
  void for_neighbours(const Use& use) const {
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (int y = 0; y < faces_[f].size.y(); ++y)
        for (int x = 0; x < faces_[f].size.x(); ++x)
          for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 1}, {0, 1}, {1, 1}}) {
            if (x + dx < 0 || x + dx >= faces_[f].size.x() || y + dy >= faces_[f].size.y()) continue;
            const std::uint32_t a = nearest_[f][faces_[f].index(x, y)].surfel;
            const std::uint32_t b = nearest_[f][faces_[f].index(x + dx, y + dy)].surfel;
            if (a != b && a != nothing && b != nothing) use(a, b);
          }
  }

 private:
  struct Cell {
    float range = std::numeric_limits<float>::infinity();
    std::uint32_t surfel = nothing;
  };
  static void keep(Cell& cell, float range, std::uint32_t s) {
    if (range < cell.range) cell = {range, s};
  }

  /// Half the box on a face about a disc in the plane of a surfel, as DirectionRaster bounds discs.
  static Array2f half_of(const GatedSurfel& s, const CubePoint& at, float radius) {
    const int k = static_cast<int>(at.face / 2);
    const float nf = at.face % 2 == 0 ? s.away[k] : -s.away[k];
    const auto reach = [&](float w2, float nw) { return radius * std::sqrt(std::max(0.0f, w2 - nw * nw)); };
    const float front = std::max(at.depth - reach(1, nf), 0.1f * at.depth);
    return Array2f(reach(1 + at.x * at.x, s.away[(k + 1) % 3] - at.x * nf),
                   reach(1 + at.y * at.y, s.away[(k + 2) % 3] - at.y * nf)) /
           front;
  }

  void draw(std::uint32_t s) {
    const GatedSurfel& surfel = surfels_[s];
    const CubePoint at = on_cube(surfel.position);
    const Array2f middle(at.x, at.y);
    const CellsOfFace& face = faces_[at.face];
    std::vector<Cell>& nearest = nearest_[at.face];
    const Array2i home = face.of(middle);
    keep(nearest[face.index(home.x(), home.y())], surfel.range, s);
    const float radius = square_reach * surfel.spacing;
    const Array2f half = half_of(surfel, at, radius);
    const Array2i first = face.of(middle - half), last = face.of(middle + half);
    const int k = static_cast<int>(at.face / 2);
    Vector3f d;
    d[k] = at.face % 2 == 0 ? 1.0f : -1.0f;
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x) {
        const Array2f cell = face.middle(x, y);
        d[(k + 1) % 3] = cell.x(), d[(k + 2) % 3] = cell.y();
        const float slope = surfel.away.dot(d);
        if (!(slope > 0)) continue;
        const Vector3f meets = d * (surfel.plane_distance / slope);
        if ((meets - surfel.position).squaredNorm() <= radius * radius)
          keep(nearest[face.index(x, y)], meets.norm(), s);
      }
  }

  const GatedSurfels& surfels_;
  std::array<CellsOfFace, 6> faces_;
  std::array<std::vector<Cell>, 6> nearest_;
};

/// Returns true if one of two surfels lies so far behind the surface of the other that it may be hidden there, and the
/// two lie apart.
bool is_apart(const GatedSurfel& a, const GatedSurfel& b) {
  const float depth = hiding_depth(a, b), between = a.spacing + b.spacing;
  if (!(a.away.dot(b.position) - a.plane_distance > depth || b.away.dot(a.position) - b.plane_distance > depth))
    return false;
  return (a.position - b.position).squaredNorm() > between * between;
}

}  // namespace

std::vector<std::uint8_t> at_silhouettes(const SceneCloud& cut, const InsonifiedRegion& region, double least_cell,
                                         int threads) {
  const GatedSurfels surfels =
      gate_surfels(cut, HeadFrame(cut, region.world_from_head), region.sector, region.gate, region.footprint, threads);
  std::vector<std::uint8_t> found(cut.size(), 0);
  NearestInCells(surfels, least_cell).for_neighbours([&](std::uint32_t a, std::uint32_t b) {
    if (is_apart(surfels[a], surfels[b])) found[surfels[a].surfel] = found[surfels[b].surfel] = 1;
  });
  return found;
}

}  // namespace insonify
