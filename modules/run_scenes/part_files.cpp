// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "core/error.hpp"
#include "files/memory_limit.hpp"
#include "run/ping_setup.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "sampling/mesh_surfels.hpp"
#include "scene/thin_scene.hpp"

namespace insonify {
namespace {

constexpr double least_spacing = 0.002, most_spacing = 0.05, spacings_of_diagonal = 50;

double diagonal_of(const SceneCloud& cloud) {
  const Bounds box = bounds(cloud);
  return (box.max - box.min).norm();
}

/// Leaves the materials that surfels have: a name of the library comes with its whole table.
void drop_unused_materials(SceneCloud& cloud) {
  constexpr std::uint16_t unused = 0xffff;
  std::vector<std::uint16_t> renumbered(cloud.materials.size(), unused);
  std::vector<Material> used;
  for (std::uint16_t& m : cloud.material) {
    if (renumbered[m] == unused) {
      renumbered[m] = static_cast<std::uint16_t>(used.size());
      used.push_back(cloud.materials[m]);
    }
    m = renumbered[m];
  }
  if (!used.empty()) cloud.materials = std::move(used);
}

/// Returns the extents of all surface of a file along its axes [m].
Eigen::Vector3d size_of(const LoadedScene& loaded) {
  Bounds box = bounds(loaded.scene);
  if (loaded.mesh)
    for (const Eigen::Vector3f& corner : loaded.mesh->point) {
      const Eigen::Vector3d at = loaded.mesh->origin + corner.cast<double>();
      box = {box.min.cwiseMin(at), box.max.cwiseMax(at)};
    }
  return box.max - box.min;
}

/// The surfels of a file: of a mesh evenly spaced ones. All hide as discs; a body of a mesh keeps its triangles, by which
/// its outline is found (part_views).
SceneCloud surfels_of(LoadedScene& loaded, const PartFile& file, bool captured, const OpenSceneOptions& o) {
  SceneCloud cloud = std::move(loaded.scene);
  if (loaded.mesh && !loaded.columns.heights && !(captured && file.spacing == 0)) {
    const double by_size = std::clamp(diagonal_of(cloud) / spacings_of_diagonal, least_spacing, most_spacing);
    cloud = even_surfels(*loaded.mesh, file.spacing > 0 ? file.spacing : by_size, o.draws.seed, o.threads,
                         {file.path, available_memory()})
                .scene;
  }
  if (captured || file.thin > 0) cloud.facet.clear();
  cloud.part_of.reset();
  if (!captured || !file.material.empty()) drop_unused_materials(cloud);
  return file.thin > 0 ? thin_scene(cloud, file.thin) : cloud;
}

void add_report(const LoadReport& of, LoadReport& all) {
  all.points_read += of.points_read, all.triangles_read += of.triangles_read;
  all.dropped_not_finite += of.dropped_not_finite, all.dropped_withheld += of.dropped_withheld;
  all.dropped_classes += of.dropped_classes;
  all.dropped_duplicates += of.dropped_duplicates, all.dropped_degenerate += of.dropped_degenerate;
  all.repaired_normals += of.repaired_normals, all.dropped_without_normal += of.dropped_without_normal;
  all.normals_estimated |= of.normals_estimated, all.areas_estimated |= of.areas_estimated;
  all.noise_estimated |= of.noise_estimated, all.materials_found |= of.materials_found;
  all.outside_intervals += of.outside_intervals;
  LoadReport said = of;
  for (std::string& note : loading_notes(said)) all.notes.push_back(std::move(note));
}

}  // namespace

void take_system_of(const std::string& path, const std::string& system, FileMeaning& all) {
  if (system.empty() || system == all.system.value) return;
  if (!all.system.value.empty())
    fail(ErrorKind::content, path, ": is in ", system, ", but another captured part is in ", all.system.value,
         "; bring both into one system, e.g. by gdalwarp or pdal");
  all.system = {system, MeaningOrigin::file};
}

SceneOptions scene_options_of(const PartFile& file) {
  SceneOptions o;
  o.path = file.path, o.meaning = file.meaning;
  o.material = file.material, o.materials_file = file.materials, o.material_field = file.material_field;
  o.viewpoint = file.viewpoint;
  return o;
}

const SceneBody& PartFiles::body_of(const PartFile& file, bool captured) {
  const SceneOptions o = scene_options_of(file);
  std::vector<double> viewpoint;
  if (o.viewpoint) viewpoint.assign(o.viewpoint->begin(), o.viewpoint->end());
  const std::string meaning =
      joined(meaning_options(), "|", [&](const MeaningOption& item) { return item.text(o.meaning); });
  const Settings settings = {o.path,    meaning,   o.material,   o.materials_file, o.material_field,
                             viewpoint, file.thin, file.spacing, captured};
  const auto [known, is_new] = bodies_.try_emplace(settings);
  if (is_new) known->second = read(file, captured);
  return known->second;
}

namespace {

/// Returns a body of a cloud: unless captured in axes of its own, near its coordinates, with numbers of its own.
SceneBody body_of_cloud(SceneCloud cloud, const Eigen::Vector3d& size, bool captured) {
  SceneBody body;
  body.size = size;
  if (!captured) {
    body.centre = cloud.origin;
    cloud.origin.setZero();
    std::iota(cloud.id.begin(), cloud.id.end(), 0u);
  }
  body.cloud = std::make_shared<const SceneCloud>(std::move(cloud));
  return body;
}

}  // namespace

SceneBody body_of_loaded(LoadedScene loaded, const PartFile& file, bool captured, const OpenSceneOptions& options) {
  const Eigen::Vector3d size = size_of(loaded);
  return body_of_cloud(surfels_of(loaded, file, captured, options), size, captured);
}

SceneBody PartFiles::read(const PartFile& file, bool captured) {
  if (file.scene) {
    PartsOfPings inner({file.path}, options_);
    random_ |= inner.is_random();
    LoadedScene whole = inner.take_whole({});
    add_report(whole.report, report_);
    if (captured) take_system_of(file.path, whole.report.meaning.system.value, report_.meaning);
    const Eigen::Vector3d size = size_of(whole);
    std::iota(whole.scene.id.begin(), whole.scene.id.end(), 0u);
    return body_of_cloud(std::move(whole.scene), size, captured);
  }
  if (file.kind == SceneKind::tiles) require_no_loading_options(scene_options_of(file), "is prepared already");
  LoadOptions loading = load_options(scene_options_of(file), options_.draws.seed, options_.threads);
  if (captured) loading.mesh_spacing = file.spacing;
  LoadedScene loaded = load_scene(file.path, loading);
  add_report(loaded.report, report_);
  if (captured) take_system_of(file.path, loaded.report.meaning.system.value, report_.meaning);
  return body_of_loaded(std::move(loaded), file, captured, options_);
}

}  // namespace insonify
