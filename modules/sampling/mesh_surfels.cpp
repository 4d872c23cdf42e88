#include "sampling/mesh_surfels.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "sampling/sampled_cells.hpp"

// Surfels of a mesh for one ping (E70): each triangle is a binary tree of parts, halved across the longest edge. The tree
// is fixed to the mesh; the ping visits the nodes that reach into its region and stops where they are small enough.
namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double nearest_range = 0.1;  // [m]
constexpr double lobe_share = 0.5;     // widest surfel, in the narrower width of a main lobe
constexpr double per_lobe = 16;        // surfels
constexpr double longest_squared = 8;  // of an edge, in areas allowed
constexpr std::size_t wanted_tasks = 1024;

/// A node of the tree, with the place of its surfel.
struct Part {
  Corners corner;
  Eigen::Matrix3d weights = Eigen::Matrix3d::Identity();  ///< columns: barycentric weights of the corners
  Vector3d place;                                         ///< of the surfel, in weights of these corners
  double area = 0;                                        ///< [m^2]
  std::uint64_t node = 1;                                 ///< children of n are 2 n and 2 n + 1
  std::uint32_t id = 0;
  int depth = 0;
};

/// Share of a triangle in the 2^32 ids.
struct IdRange {
  std::uint32_t first = 0;
  int depth = 0;  ///< 2^depth ids
};

std::vector<IdRange> share_out_ids(const SceneMesh& mesh) {
  std::vector<double> area(mesh.triangle.size());
  double total = 0;
  for (std::size_t t = 0; t < area.size(); ++t) total += area[t] = area_of(corners_of(mesh, t));
  std::vector<IdRange> ranges(area.size());
  const double ids = 0x1p32 - static_cast<double>(area.size());
  std::uint64_t next = 0;
  for (std::size_t t = 0; t < area.size(); ++t) {
    const int depth = std::clamp(static_cast<int>(std::floor(std::log2(ids * area[t] / total))), 0, 31);
    ranges[t] = {static_cast<std::uint32_t>(next), depth};
    next += std::uint64_t{1} << depth;
  }
  return ranges;
}

/// Angle that the side of a surfel may fill, by lobes of these widths [rad].
double widest_surfel(const SampledCells::Widths& lobe, double elevation_width) {
  const double height = lobe.row > 0 ? std::min(lobe.row, elevation_width) : elevation_width;
  return std::min(lobe_share * std::min(lobe.beam, height), std::sqrt(lobe.beam * height / per_lobe));
}

struct MeshSurfel {
  MeshPlace place;
  float area;
  std::uint32_t id;
};

class MeshSampler {
 public:
  MeshSampler(const SceneMesh& mesh, const InsonifiedRegion& region, const BeamFan& fan, const SamplingOptions& options,
              const HeadFrame& head)
      : mesh_(mesh),
        head_(head),
        sector_(region.sector),
        region_(region),
        ids_(share_out_ids(mesh)),
        seed_(options.seed),
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
  Part root(std::size_t t) const {
    const auto random = random_uniform(seed_, RandomStage::mesh_points, {t, 0, 1});
    Part part;
    part.corner = corners_of(mesh_, t);
    part.place = uniform_weights(random[0], random[1]);
    part.area = area_of(part.corner);
    part.id = ids_[t].first;
    return part;
  }

  std::array<Part, 2> bisect(const Part& whole, std::size_t t) const {
    // The edge is chosen in scene coordinates, so that the tree does not depend on the head.
    const auto edge2 = [&](int e) { return (whole.corner[(e + 2) % 3] - whole.corner[(e + 1) % 3]).squaredNorm(); };
    const int e = edge2(0) >= edge2(1) && edge2(0) >= edge2(2) ? 0 : edge2(1) >= edge2(2) ? 1 : 2;
    const int ends[] = {(e + 1) % 3, (e + 2) % 3};
    const Vector3d middle = 0.5 * (whole.corner[ends[0]] + whole.corner[ends[1]]);
    const Vector3d weights = 0.5 * (whole.weights.col(ends[0]) + whole.weights.col(ends[1]));
    const int keeper = whole.place[ends[0]] >= whole.place[ends[1]] ? 0 : 1;  // the half with the surfel
    std::array<Part, 2> halves = {whole, whole};
    for (int h = 0; h < 2; ++h) {
      Part& half = halves[h];
      half.corner[ends[1 - h]] = middle;
      half.weights.col(ends[1 - h]) = weights;
      half.area = 0.5 * whole.area;
      half.node = 2 * whole.node + static_cast<std::uint64_t>(h);
      ++half.depth;
      if (h == keeper) {
        half.place[ends[h]] = whole.place[ends[h]] - whole.place[ends[1 - h]];
        half.place[ends[1 - h]] = 2 * whole.place[ends[1 - h]];
      } else {
        const auto random = random_uniform(seed_, RandomStage::mesh_points, {t, whole.node, 1});
        half.place = uniform_weights(random[0], random[1]);
        half.id = ids_[t].first + static_cast<std::uint32_t>(whole.node);
      }
    }
    return halves;
  }

  /// What of a part decides: where it is, and how large.
  struct Extent {
    Vector3d centre;               ///< in head axes [m]
    double radius = 0, reach = 0;  ///< of the part, and of what it may hide [m]
    double longest2 = 0;
    bool reaches = false;
  };

  Extent extent_of(const Part& part) const {
    const Vector3d middle = (part.corner[0] + part.corner[1] + part.corner[2]) / 3;
    Extent extent{head_.position(middle.cast<float>()), 0, 0, 0, false};
    for (int c = 0; c < 3; ++c) {
      extent.radius = std::max(extent.radius, (part.corner[c] - middle).norm());
      extent.longest2 = std::max(extent.longest2, (part.corner[c] - part.corner[(c + 1) % 3]).squaredNorm());
    }
    extent.reach = extent.radius + hiding_reach * region_.footprint * std::sqrt(part.area);
    extent.reaches =
        extent.centre.norm() <= region_.gate.max_range + extent.radius && sector_.holds(extent.centre, extent.reach);
    return extent;
  }

  bool small_enough(const Part& part, const Extent& extent, std::size_t t) const {
    if (part.depth >= ids_[t].depth) return true;
    const double distance = extent.centre.norm();
    const double range = std::max({distance - extent.radius, region_.gate.min_range, nearest_range});
    const Vector3d across = (part.corner[1] - part.corner[0]).cross(part.corner[2] - part.corner[0]).normalized();
    const double cosine = std::abs(head_.direction(across).dot(extent.centre)) / std::max(distance, nearest_range);
    const SampledCells::Widths lobe = cells_.widths(extent.centre, extent.reach);
    const double side = widest_surfel(lobe, elevation_width_) * range;
    const double cell = cells_.area(range, std::min(1.0, cosine), lobe);
    const double allowed = scale_ * std::min(side * side, cell);  // (E70)
    return part.area <= allowed && extent.longest2 <= longest_squared * allowed;
  }

  /// Goes down to the part of a triangle that the task stands for; a larger one belongs to the first task below it.
  void start(std::size_t task, std::vector<MeshSurfel>& found) {
    const std::size_t t = task >> task_depth_;
    Part part = root(t);
    for (int level = task_depth_ - 1; level >= 0; --level) {
      const Extent extent = extent_of(part);
      if (!extent.reaches) return;
      if (small_enough(part, extent, t)) {
        if ((task & ((std::size_t{2} << level) - 1)) == 0) add(part, t, found);
        return;
      }
      part = bisect(part, t)[task >> level & 1];
    }
    collect(part, t, found);
  }

  void collect(const Part& part, std::size_t t, std::vector<MeshSurfel>& found) {
    const Extent extent = extent_of(part);
    if (!extent.reaches || count_ > most_) return;
    if (small_enough(part, extent, t)) return add(part, t, found);
    for (const Part& half : bisect(part, t)) collect(half, t, found);
  }

  void add(const Part& part, std::size_t t, std::vector<MeshSurfel>& found) {
    if (++count_ > most_) return;
    found.push_back({place_on(mesh_, t, part.weights * part.place), static_cast<float>(part.area), part.id});
  }

  const SceneMesh& mesh_;
  const HeadFrame& head_;
  const SectorBounds sector_;
  const InsonifiedRegion& region_;
  const std::vector<IdRange> ids_;
  const std::uint64_t seed_;
  const int threads_;
  const SampledCells cells_;
  const double elevation_width_;
  int task_depth_ = 0;
  double scale_ = 1;
  std::size_t most_ = 0;
  std::atomic<std::size_t> count_{0};
};

void fill(const std::vector<std::vector<MeshSurfel>>& parts, SceneCloud& scene) {
  for (const auto& part : parts)
    for (const MeshSurfel& s : part) {
      scene.point.push_back(s.place.position.cast<float>());
      scene.normal.push_back(s.place.normal.cast<float>());
      scene.area.push_back(s.area);
      scene.material.push_back(s.place.material);
      scene.id.push_back(s.id);
    }
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
  fill(found, scene);
  return result;
}

}  // namespace insonify
