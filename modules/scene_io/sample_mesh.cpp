#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "scene_io/complete_scene_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::size_t default_surfels = 200000;
constexpr std::size_t most_surfels = 400000000;

struct Triangle {
  Vector3d a, b, c;
  Vector3d cross() const { return (b - a).cross(c - a); }
};

Triangle corners_of(const RawCloud& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangle[t];
  return {mesh.point[a].cast<double>(), mesh.point[b].cast<double>(), mesh.point[c].cast<double>()};
}

/// Area [m^2]; 0 for a triangle with a corner that is not finite, or thinner than 1e-6 of its length.
double usable_area(const Triangle& t) {
  const double twice = t.cross().norm();
  const double longest2 = std::max({(t.b - t.a).squaredNorm(), (t.c - t.b).squaredNorm(), (t.a - t.c).squaredNorm()});
  return twice > 1e-6 * longest2 && std::isfinite(twice) ? 0.5 * twice : 0;
}

/// Consistency of the winding over shared edges.
struct Winding {
  std::size_t shared = 0, against = 0, border = 0;  ///< edges; against: traversed twice in the same direction
  double volume6 = 0;                               ///< six times the signed volume of a closed mesh
};

Winding examine_winding(const RawCloud& mesh, const std::vector<double>& area) {
  const std::vector<std::uint32_t> same = first_at_same_place(mesh.point);
  struct Edge {
    std::uint64_t ends;
    bool forward;
  };
  Winding winding;
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangle.size());
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
    if (area[t] == 0) continue;
    const Triangle corners = corners_of(mesh, t);
    winding.volume6 += corners.a.dot(corners.b.cross(corners.c));
    for (int e = 0; e < 3; ++e) {
      const std::uint64_t from = same[mesh.triangle[t][e]], to = same[mesh.triangle[t][(e + 1) % 3]];
      edges.push_back({std::min(from, to) << 32 | std::max(from, to), from < to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i;
    while (end < edges.size() && edges[end].ends == edges[i].ends) ++end;
    if (end - i == 1) ++winding.border;
    if (end - i == 2) {
      ++winding.shared;
      winding.against += edges[i].forward == edges[i + 1].forward;
    }
    i = end;
  }
  return winding;
}

/// True if the winding orients the face normals consistently; notes the result.
bool winding_is_oriented(const RawCloud& mesh, const std::vector<double>& area, std::vector<std::string>& notes) {
  const Winding winding = examine_winding(mesh, area);
  if (100 * winding.against > winding.shared) {
    notes.push_back(
        "the triangles are wound inconsistently (" + share(winding.against, winding.shared, "shared edges") +
        "): their normals are not oriented, so both sides reflect; orient the mesh, or give the viewpoint of "
        "the capture");
    return false;
  }
  if (winding.shared == 0 && mesh.triangle.size() > 1) {
    notes.push_back("the triangles share no edges: their winding cannot be checked and is assumed to be right");
  }
  if (winding.shared > 0 && winding.border == 0 && winding.volume6 < 0) {
    notes.push_back(
        "the mesh is closed and its normals point inwards: right for a tank seen from inside; else flip "
        "the faces");
  }
  return true;
}

std::size_t surfels_wanted(double total_area, double spacing) {
  if (spacing == 0) return default_surfels;
  const double wanted = std::round(total_area / (spacing * spacing));
  if (wanted > static_cast<double>(most_surfels)) {
    fail(ErrorKind::argument, "load_scene: mesh_spacing = ", spacing, " m gives ", wanted, " surfels on ", total_area,
         " m^2, at most ", most_surfels, "; give a wider spacing");
  }
  return std::max<std::size_t>(1, static_cast<std::size_t>(wanted));
}

/// Barycentric coordinates of a surfel in its triangle. `along` in [0, 1) is stratified by the caller, the other
/// coordinate advances by the golden ratio, so that successive surfels stay apart; jitter breaks the lattice. The
/// square root makes the density uniform.
Vector3d weights_at(double along, std::size_t sample, double jitter, double samples_here) {
  const double walk =
      static_cast<double>(sample) * (std::numbers::phi - 1) + jitter / std::sqrt(std::max(1.0, samples_here));
  const double across = walk - std::floor(walk);
  const double height = std::sqrt(along);
  return {1 - height, height * (1 - across), height * across};
}

/// The interpolated vertex normal if all three are on the same side of the face, else the face normal on the side of
/// their sum.
Vector3d normal_at(const RawCloud& mesh, std::size_t t, const Vector3d& weights) {
  const Vector3d face = corners_of(mesh, t).cross().normalized();
  if (mesh.normal.empty()) return face;
  Vector3d blended = Vector3d::Zero();
  double least = 1, most = -1;
  for (int corner = 0; corner < 3; ++corner) {
    const Vector3d n = mesh.normal[mesh.triangle[t][corner]].cast<double>();
    const double length = n.norm();
    if (!(length > 1e-12) || !std::isfinite(length)) return face;
    blended += weights[corner] * n / length;
    least = std::min(least, n.dot(face) / length);
    most = std::max(most, n.dot(face) / length);
  }
  if (least * most > 0) return blended.normalized();
  return blended.dot(face) < 0 ? Vector3d(-face) : face;
}

/// Areas of the triangles and their cumulative sum, along which surfels are distributed.
struct Surface {
  std::vector<double> area, end;  ///< of each triangle [m^2]; end: cumulative sum including it
  double total() const { return end.back(); }
};

Surface measure(const RawCloud& mesh, int threads) {
  Surface surface;
  surface.area.resize(mesh.triangle.size());
  surface.end.resize(mesh.triangle.size());
  parallel_blocks(mesh.triangle.size(), 1 << 14, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) surface.area[t] = usable_area(corners_of(mesh, t));
  });
  std::partial_sum(surface.area.begin(), surface.area.end(), surface.end.begin());
  return surface;
}

/// Places surfel i at random in the i-th of scene.size() equal intervals of the cumulative area.
void place_surfel(const RawCloud& mesh, const Surface& surface, std::uint64_t seed, std::size_t i, SceneCloud& scene) {
  const double part = surface.total() / static_cast<double>(scene.size());
  const auto random = random_uniform(seed, RandomStage::mesh_points, {.first = i});
  const double at = std::min((static_cast<double>(i) + random[0]) * part, std::nextafter(surface.total(), 0.0));
  const auto found = std::upper_bound(surface.end.begin(), surface.end.end(), at);
  const std::size_t t = static_cast<std::size_t>(found - surface.end.begin());
  const double along = std::clamp((at - (surface.end[t] - surface.area[t])) / surface.area[t], 0.0, 1.0);
  const Vector3d weights = weights_at(along, i, random[1], surface.area[t] / part);
  const Triangle corners = corners_of(mesh, t);
  const Vector3d position = weights[0] * corners.a + weights[1] * corners.b + weights[2] * corners.c;
  scene.point[i] = position.cast<float>();
  scene.normal[i] = normal_at(mesh, t, weights).cast<float>();
  if (mesh.label.empty()) return;
  Eigen::Index nearest = 0;
  weights.maxCoeff(&nearest);
  scene.material[i] = mesh.label[mesh.triangle[t][static_cast<std::size_t>(nearest)]];
}

}  // namespace

void sample_mesh(const RawCloud& mesh, const LoadOptions& options, LoadedScene& result) {
  const Surface surface = measure(mesh, options.threads);
  const auto flat = std::count(surface.area.begin(), surface.area.end(), 0.0);
  result.report.dropped_degenerate = mesh.bad_triangles + static_cast<std::size_t>(flat);
  if (!(surface.total() > 0)) {
    fail(ErrorKind::content, mesh.path, ": no usable triangle: all ", mesh.triangle.size(),
         " have no area; export the mesh again");
  }

  // One surfel in each of `count` equal intervals of the cumulative area: exact total, no bias between triangles.
  SceneCloud& scene = result.scene;
  const std::size_t count = surfels_wanted(surface.total(), options.mesh_spacing);
  scene.point.resize(count);
  scene.normal.resize(count);
  scene.area.assign(count, static_cast<float>(surface.total() / static_cast<double>(count)));
  scene.id.resize(count);
  std::iota(scene.id.begin(), scene.id.end(), 0u);
  if (!mesh.label.empty()) scene.material.resize(count);
  parallel_blocks(count, 1 << 12, options.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) place_surfel(mesh, surface, options.seed, i, scene);
  });

  // Orientation: from the file's normals, else the winding, else the viewpoint.
  scene.normals_oriented = !mesh.normal.empty() || winding_is_oriented(mesh, surface.area, result.report.notes);
  if (scene.normals_oriented || !options.viewpoint) return;
  const Vector3d viewpoint = *options.viewpoint - mesh.origin;
  for (std::size_t i = 0; i < count; ++i) {
    const bool away = scene.normal[i].cast<double>().dot(viewpoint - scene.point[i].cast<double>()) < 0;
    if (away) scene.normal[i] = -scene.normal[i];
  }
  scene.normals_oriented = true;
  result.report.viewpoint = options.viewpoint;
}

}  // namespace insonify
