// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "files/memory_limit.hpp"
#include "sampling/mesh_surfels.hpp"
#include "scene_io/complete_scene_internal.hpp"
#include "scene_io/scene_columns_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::size_t default_surfels = 200000;

/// The consistency of the winding over shared edges.
struct Winding {
  std::size_t shared = 0, against = 0, border = 0;  ///< edges; against: traversed twice in the same direction
  double volume6 = 0;                               ///< six times the signed volume of a closed mesh
};

Winding examine_winding(const SceneMesh& mesh) {
  const std::vector<std::uint32_t> same = first_at_same_position(mesh.point);
  struct Edge {
    std::uint64_t ends;
    bool forward;
  };
  Winding winding;
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangle.size());
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
    const auto [a, b, c] = corners_of(mesh, t);
    winding.volume6 += a.dot(b.cross(c));
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

/// Returns true if the winding orients the face normals consistently; notes the result.
bool winding_is_oriented(const SceneMesh& mesh, std::vector<std::string>& notes) {
  const Winding winding = examine_winding(mesh);
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

/// Returns the barycentric weights of a surfel in its triangle. The caller stratifies `along` in [0, 1). The other
/// coordinate advances by the golden ratio, so that successive surfels stay apart; jitter breaks the lattice.
Vector3d weights_at(double along, std::size_t sample, double jitter, double samples_here) {
  const double walk =
      static_cast<double>(sample) * (std::numbers::phi - 1) + jitter / std::sqrt(std::max(1.0, samples_here));
  return uniform_weights(along, walk - std::floor(walk));
}

/// The areas of the triangles and their cumulative sum, along which surfels are distributed.
struct Surface {
  std::vector<double> area, end;  ///< area of each triangle [m^2]; end: cumulative sum including it
  double total() const { return end.back(); }
};

Surface measure(const SceneMesh& mesh) {
  Surface surface;
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) surface.area.push_back(area_of(corners_of(mesh, t)));
  surface.end.resize(surface.area.size());
  std::partial_sum(surface.area.begin(), surface.area.end(), surface.end.begin());
  return surface;
}

/// Places surfel i at random in the i-th of scene.size() equal intervals of the cumulative area. Returns its nearest
/// corner.
std::uint32_t place_surfel(const SceneMesh& mesh, const Surface& surface, std::uint64_t seed, std::size_t i,
                           SceneCloud& scene) {
  const double part = surface.total() / static_cast<double>(scene.size());
  const auto random = random_uniform(seed, RandomStage::mesh_points, {.first = i});
  const double at = std::min((static_cast<double>(i) + random[0]) * part, std::nextafter(surface.total(), 0.0));
  const auto found = std::upper_bound(surface.end.begin(), surface.end.end(), at);
  const std::size_t t = static_cast<std::size_t>(found - surface.end.begin());
  const double along = std::clamp((at - (surface.end[t] - surface.area[t])) / surface.area[t], 0.0, 1.0);
  const MeshPoint position = point_on(mesh, t, weights_at(along, i, random[1], surface.area[t] / part));
  scene.point[i] = position.position.cast<float>();
  scene.normal[i] = position.normal.cast<float>();
  scene.material[i] = position.material;
  return position.corner;
}

/// Turns every triangle's winding towards the viewpoint [m, relative to the origin].
void face_viewpoint(const Vector3d& viewpoint, SceneMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
    const auto [a, b, c] = corners_of(mesh, t);
    if ((b - a).cross(c - a).dot(viewpoint - a) < 0) std::swap(mesh.triangle[t][1], mesh.triangle[t][2]);
  }
}

/// Returns the usable triangles of a file, oriented by the file's normals, else the winding, else the viewpoint.
SceneMesh usable_mesh(const RawCloud& raw, const LoadOptions& options, LoadReport& report) {
  SceneMesh mesh;
  mesh.origin = raw.origin;
  mesh.point = raw.point;
  mesh.normal = raw.normal;
  mesh.triangle = raw.triangle;
  const std::size_t flat = std::erase_if(mesh.triangle, [&](const auto& t) {
    const auto at = [&](int corner) { return raw.point[t[corner]].template cast<double>(); };
    return area_of({at(0), at(1), at(2)}) == 0;
  });
  report.dropped_degenerate = raw.bad_triangles + flat;
  if (mesh.triangle.empty()) {
    fail(ErrorKind::content, raw.path, ": no usable triangle: all ", raw.triangle.size(),
         " have no area; export the mesh again");
  }
  mesh.normals_oriented =
      raw.tags.prepared ? raw.tags.oriented : !mesh.normal.empty() || winding_is_oriented(mesh, report.notes);
  if (mesh.normals_oriented || !options.viewpoint) return mesh;
  face_viewpoint(*options.viewpoint - mesh.origin, mesh);
  mesh.normals_oriented = true;
  report.viewpoint = options.viewpoint;
  return mesh;
}

/// Returns true if the normals of the points are less steep than the triangles around them, by the mean square of the
/// sine; they are then normals of smoothed heights (E153).
bool smoother_than_facets(const SceneMesh& mesh) {
  double points = 0, facets = 0;
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
    const auto [a, b, c] = corners_of(mesh, t);
    const Vector3d cross = (b - a).cross(c - a);
    const double area = cross.norm();
    facets += cross.head<2>().squaredNorm() / area;
    for (const std::uint32_t corner : mesh.triangle[t])
      points += area / 3 * static_cast<double>(mesh.normal[corner].head<2>().squaredNorm());
  }
  return points < facets;
}

}  // namespace

void add_surface(RawCloud& raw, const LoadOptions& options, LoadedScene& result) {
  SceneCloud& scene = result.scene;
  const bool from_file = !raw.surface.empty() && raw.tags.prepared;
  if (from_file)
    raw.surface_name = "surface of heights";
  else if (raw.tags.prepared && raw.tags.heights)
    set_surface(scene.point, raster_triangles(scene.point), options.threads, raw);
  std::erase_if(raw.surface, [&](const auto& t) {
    const auto at = [&](int corner) { return scene.point[t[corner]].template cast<double>(); };
    return area_of({at(0), at(1), at(2)}) == 0;
  });
  if (raw.surface.empty()) return;
  bool own_normals = raw.surface_normals || raw.tags.own_normals;
  SceneMesh mesh{.origin = scene.origin,
                 .point = scene.point,
                 .normal = own_normals ? scene.normal : std::vector<Vector3f>(),
                 .material = scene.material,
                 .triangle = std::move(raw.surface),
                 .materials = scene.materials,
                 .normals_oriented = scene.normals_oriented,
                 .whole = whole_of(scene)};
  for (std::size_t i = 0; i < raw.surface_height.size(); ++i) mesh.point[i].z() = raw.surface_height[i];
  if (raw.surface_normals && smoother_than_facets(mesh)) {
    own_normals = false;
    mesh.normal.clear();
    result.report.notes.push_back(
        "the normals are smoother than the surface between the points, as those of planes through neighbours are: its "
        "triangles scatter with their own");
  }
  // A height field looks to one side; turn the triangles of a file to it.
  double up = 0;
  for (std::size_t i = 0; i < scene.size(); ++i) up += double{scene.area[i]} * double{scene.normal[i].z()};
  if (scene.normals_oriented && up < 0 && !from_file)
    for (auto& triangle : mesh.triangle) std::swap(triangle[1], triangle[2]);
  result.report.format += ", " + raw.surface_name;
  if (options.mesh_spacing == 0) {
    result.columns.heights = true;
    result.columns.own_normals = own_normals;
    result.mesh = std::move(mesh);
    return;
  }
  EvenSurfels even =
      even_surfels(mesh, options.mesh_spacing, options.seed, options.threads, {raw.path, available_memory()});
  scene = std::move(even.scene);
  for (SceneColumn& column : raw.columns) keep_rows(column, even.corner);
}

void sample_mesh(RawCloud& raw, const LoadOptions& options, LoadedScene& result) {
  SceneMesh mesh = usable_mesh(raw, options, result.report);
  SceneCloud& scene = result.scene;
  mesh.material = std::move(scene.material);
  mesh.materials = scene.materials;

  // One surfel in each of `count` equal intervals of the cumulative area: exact total, no bias between triangles.
  const Surface surface = measure(mesh);
  const std::size_t count = options.mesh_spacing > 0 ? count_even_surfels(surface.total(), options.mesh_spacing,
                                                                          {raw.path, available_memory()})
                                                     : default_surfels;
  scene.point.resize(count);
  scene.normal.resize(count);
  scene.area.assign(count, static_cast<float>(surface.total() / static_cast<double>(count)));
  scene.id.resize(count);
  std::iota(scene.id.begin(), scene.id.end(), 0u);
  scene.material.resize(count);
  scene.normals_oriented = mesh.normals_oriented;
  std::vector<std::uint32_t> corner(count);
  parallel_blocks(count, 1 << 12, options.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) corner[i] = place_surfel(mesh, surface, options.seed, i, scene);
  });
  if (options.keep_columns && options.mesh_spacing == 0) {
    RawCloud corners;
    corners.label_field = raw.label_field, corners.columns = raw.columns;
    take_columns(corners, options, result.corner_columns);
  }
  for (SceneColumn& column : raw.columns) keep_rows(column, corner);

  if (options.mesh_spacing > 0) return;
  mesh.whole = {count, std::sqrt(surface.total() / static_cast<double>(count)), 0,
                std::any_of(mesh.materials.begin(), mesh.materials.end(), is_smooth)};
  result.mesh = std::move(mesh);
}

}  // namespace insonify
