// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/mesh_surfels.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "sampling/mesh_pieces_internal.hpp"
#include "sampling/sampled_cells.hpp"

// Surfels of a mesh for one ping (E70): each triangle is a binary tree of parts, halved across the longest edge. The
// tree is fixed to the mesh; the ping visits the nodes that reach into its region and stops where they are small
// enough.
namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double nearest_range = 0.1;  // [m]
constexpr double lobe_share = 0.5;     // widest surfel, in the narrower width of a main lobe
constexpr double per_lobe = 16;        // surfels
constexpr double longest_squared = 8;  // of an edge, in areas allowed
constexpr std::size_t wanted_tasks = 1024;

/// Angle that the side of a surfel may fill, by lobes of these widths [rad].
double widest_surfel(const SampledCells::Widths& lobe, double elevation_width) {
  const double height = lobe.row > 0 ? std::min(lobe.row, elevation_width) : elevation_width;
  return std::min(lobe_share * std::min(lobe.beam, height), std::sqrt(lobe.beam * height / per_lobe));
}

class MeshSampler {
 public:
  MeshSampler(const SceneMesh& mesh, const InsonifiedRegion& region, const BeamFan& fan, const SamplingOptions& options,
              const HeadFrame& head)
      : mesh_(mesh),
        head_(head),
        sector_(region.sector),
        region_(region),
        pieces_(mesh, options.seed),
        threads_(options.threads),
        cells_(fan, region.gate, options),
        elevation_width_(fan.elevation_width) {
    while (mesh.triangle.size() << task_depth_ < wanted_tasks && task_depth_ < 10) ++task_depth_;
  }

  /// Surfels of all triangles in order, if they are at most `most`, else none.
  std::vector<std::vector<MeshSurfel>> sample(double scale, std::size_t most) {
    scale_ = scale;
    most_ = most;
    count_ = 0;
    const std::size_t tasks = mesh_.triangle.size() << task_depth_, block = 1 + tasks / (4 * wanted_tasks);
    std::vector<std::vector<MeshSurfel>> found((tasks + block - 1) / block);
    parallel_blocks(tasks, block, threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t task = begin; task < end; ++task) start(task, found[begin / block]);
    });
    if (count_ > most_) found.clear();
    return found;
  }

 private:
  /// The position and size of a part, which decide whether it is divided.
  struct Extent {
    Vector3d centre;               ///< in head axes [m]
    double radius = 0, reach = 0;  ///< radii of the part, and of what it may hide [m]
    double longest2 = 0;
    bool reaches = false;
  };

  Extent extent_of(const Piece& piece) const {
    const Vector3d middle = (piece.corner[0] + piece.corner[1] + piece.corner[2]) / 3;
    Extent extent{head_.position(middle.cast<float>()), 0, 0, 0, false};
    for (int c = 0; c < 3; ++c) {
      extent.radius = std::max(extent.radius, (piece.corner[c] - middle).norm());
      extent.longest2 = std::max(extent.longest2, (piece.corner[c] - piece.corner[(c + 1) % 3]).squaredNorm());
    }
    extent.reach = extent.radius + hiding_reach * region_.footprint * std::sqrt(piece.area);
    extent.reaches =
        extent.centre.norm() <= region_.gate.max_range + extent.radius && sector_.holds(extent.centre, extent.reach);
    return extent;
  }

  bool small_enough(const Piece& piece, const Extent& extent, std::size_t t) const {
    if (!pieces_.may_bisect(piece, t)) return true;
    const double distance = extent.centre.norm();
    const double range = std::max({distance - extent.radius, region_.gate.min_range, nearest_range});
    const Vector3d across = (piece.corner[1] - piece.corner[0]).cross(piece.corner[2] - piece.corner[0]).normalized();
    const double cosine = std::abs(head_.direction(across).dot(extent.centre)) / std::max(distance, nearest_range);
    const SampledCells::Widths lobe = cells_.widths(extent.centre, extent.reach);
    const double side = widest_surfel(lobe, elevation_width_) * range;
    const double cell = cells_.area(range, std::min(1.0, cosine), lobe);
    const double allowed = scale_ * std::min(side * side, cell);  // (E70)
    return piece.area <= allowed && extent.longest2 <= longest_squared * allowed;
  }

  /// Goes down to the part of a triangle that the task stands for; a larger one belongs to the first task below it.
  void start(std::size_t task, std::vector<MeshSurfel>& found) {
    const std::size_t t = task >> task_depth_;
    Piece piece = pieces_.root(t);
    for (int level = task_depth_ - 1; level >= 0; --level) {
      const Extent extent = extent_of(piece);
      if (!extent.reaches) return;
      if (small_enough(piece, extent, t)) {
        if ((task & ((std::size_t{2} << level) - 1)) == 0) add(piece, t, found);
        return;
      }
      piece = pieces_.bisect(piece, t)[task >> level & 1];
    }
    collect(piece, t, found);
  }

  void collect(const Piece& piece, std::size_t t, std::vector<MeshSurfel>& found) {
    const Extent extent = extent_of(piece);
    if (!extent.reaches || count_ > most_) return;
    if (small_enough(piece, extent, t)) return add(piece, t, found);
    for (const Piece& half : pieces_.bisect(piece, t)) collect(half, t, found);
  }

  void add(const Piece& piece, std::size_t t, std::vector<MeshSurfel>& found) {
    if (++count_ > most_) return;
    found.push_back(pieces_.surfel_of(piece, t));
  }

  const SceneMesh& mesh_;
  const HeadFrame& head_;
  const SectorBounds sector_;
  const InsonifiedRegion& region_;
  const MeshPieces pieces_;
  const int threads_;
  const SampledCells cells_;
  const double elevation_width_;
  int task_depth_ = 0;
  double scale_ = 1;
  std::size_t most_ = 0;
  std::atomic<std::size_t> count_{0};
};

std::size_t surfels_in(const std::vector<std::vector<MeshSurfel>>& pieces) {
  std::size_t sum = 0;
  for (const auto& piece : pieces) sum += piece.size();
  return sum;
}

}  // namespace

MeshSurfels mesh_surfels(const SceneMesh& mesh, const InsonifiedRegion& region, const BeamFan& fan,
                         const SamplingOptions& options, std::size_t most_surfels) {
  require_valid(mesh, "mesh_surfels");
  require_valid(fan, "mesh_surfels");
  if (!(region.gate.max_range > 0 && std::isfinite(region.gate.max_range)))
    fail(ErrorKind::argument, "mesh_surfels: region.gate.max_range = ", region.gate.max_range, " m, must be > 0");
  if (!(options.range_resolution > 0 || region.gate.bin_size > 0))
    fail(ErrorKind::argument, "mesh_surfels: options.range_resolution = ", options.range_resolution,
         " m, must be > 0 if the gate has no bins");
  if (most_surfels == 0) fail(ErrorKind::argument, "mesh_surfels: most_surfels = 0, must be at least 1");

  MeshSurfels result;
  SceneCloud& scene = result.scene;
  scene.origin = mesh.origin;
  scene.materials = mesh.materials;
  scene.normals_oriented = mesh.normals_oriented;
  scene.part_of = mesh.whole;
  const HeadFrame head(scene, region.world_from_head);
  MeshSampler sampler(mesh, region, fan, options, head);

  // The fewest possible are one for each triangle; else areas are doubled until the surfels are few enough.
  constexpr double any = std::numeric_limits<double>::infinity();
  std::vector<std::vector<MeshSurfel>> found;
  if (mesh.triangle.size() > most_surfels && sampler.sample(any, most_surfels).empty()) {
    result.coarsening = any;
    return result;
  }
  while (!mesh.triangle.empty() && (found = sampler.sample(result.coarsening, most_surfels)).empty())
    result.coarsening *= 2;
  reserve(surfels_in(found), scene);
  for (auto& piece : found) {
    append(piece, scene);
    std::vector<MeshSurfel>().swap(piece);
  }
  return result;
}

std::size_t count_even_surfels(double area, double spacing, const EvenLimit& limit) {
  constexpr double most = 4e8, bytes_each = 128, gibibyte = 1 << 30;  // while they are made
  const double wanted = std::round(area / (spacing * spacing));
  if (!(wanted <= most))
    fail(ErrorKind::content, limit.where, ": surfels ", spacing, " m apart on ", area, " m^2 are ", wanted,
         ", at most ", most, " may be asked for; give a wider spacing");
  if (wanted * bytes_each > limit.memory)
    fail(ErrorKind::memory, limit.where, ": ", wanted, " surfels ", spacing, " m apart need about ",
         wanted * bytes_each / gibibyte, " GiB of memory, ", limit.memory / gibibyte,
         " GiB may be used; give a wider spacing");
  return std::max<std::size_t>(1, static_cast<std::size_t>(wanted));
}

EvenSurfels even_surfels(const SceneMesh& mesh, double spacing, std::uint64_t seed, int threads,
                         const EvenLimit& limit) {
  require_valid(mesh, "even_surfels");
  if (!(spacing > 0 && std::isfinite(spacing)))
    fail(ErrorKind::argument, "even_surfels: spacing = ", spacing, " m, must be > 0");
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) area += area_of(corners_of(mesh, t));
  count_even_surfels(area, spacing, limit);
  // Halves of areas that are spread evenly over an octave have the mean 1 / (2 ln 2) of the largest.
  const double largest = 2 * std::numbers::ln2 * spacing * spacing;
  const MeshPieces pieces(mesh, seed);
  constexpr std::size_t at_once = 512;
  std::vector<std::vector<MeshSurfel>> found((mesh.triangle.size() + at_once - 1) / at_once);
  parallel_blocks(mesh.triangle.size(), at_once, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Piece> open;
    for (std::size_t t = begin; t < end; ++t)
      for (open = {pieces.root(t)}; !open.empty();) {
        const Piece piece = open.back();
        open.pop_back();
        if (piece.area <= largest || !pieces.may_bisect(piece, t)) {
          found[begin / at_once].push_back(pieces.surfel_of(piece, t));
          continue;
        }
        const auto halves = pieces.bisect(piece, t);
        open.push_back(halves[1]), open.push_back(halves[0]);
      }
  });
  EvenSurfels even;
  even.scene.origin = mesh.origin;
  even.scene.materials = mesh.materials;
  even.scene.normals_oriented = mesh.normals_oriented;
  reserve(surfels_in(found), even.scene);
  even.corner.reserve(surfels_in(found));
  for (const auto& piece : found) {
    append(piece, even.scene);
    for (const MeshSurfel& s : piece) even.corner.push_back(s.position.corner);
  }
  return even;
}

}  // namespace insonify
