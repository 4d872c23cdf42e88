// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_cloud.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

#include "core/error.hpp"
#include "core/random.hpp"
#include "scene/scene_part.hpp"
#include "scene/surfel_fault.hpp"

namespace insonify {
namespace {

void require_length(std::size_t length, std::size_t points, const char* name, const char* who) {
  if (length != points)
    fail(ErrorKind::argument, who, ": scene.", name, " has ", length, " entries, must have one per point (", points,
         ")");
}

/// Calls refuse(array, what, remedy) for each invalid value of a surfel.
template <typename Refuse>
void check_surfel(const SceneCloud& scene, std::size_t i, std::size_t materials, const Refuse& refuse) {
  const auto text = [](const auto&... parts) {
    std::ostringstream all;
    (all << ... << parts);
    return all.str();
  };
  const auto at = [&](const Eigen::Vector3f& v) { return text(" = (", v.x(), ", ", v.y(), ", ", v.z(), ")"); };
  if (!scene.point[i].allFinite())
    refuse("point", text(at(scene.point[i]), " m, must be finite"), "; remove such points");
  if (!(std::abs(scene.normal[i].squaredNorm() - 1.0f) <= 2e-3f))
    refuse("normal", text(at(scene.normal[i]), ", must be a unit vector"), "; normalise the normals or estimate them");
  if (!(scene.area[i] >= 0 && std::isfinite(scene.area[i])))
    refuse("area", text(" = ", scene.area[i], " m^2, must be finite and >= 0"), "");
  if (!scene.noise.empty() && !(scene.noise[i] >= 0 && std::isfinite(scene.noise[i])))
    refuse("noise", text(" = ", scene.noise[i], " m, must be finite and >= 0"), "");
  if (!scene.facet.empty())
    for (const Eigen::Vector3f& corner : scene.facet[i])
      if (!corner.allFinite()) refuse("facet", text(": a corner", at(corner), " m, must be finite"), "");
  if (!scene.part.empty()) {
    if (scene.part[i] >= scene.parts.size())
      refuse("part", text(" = ", scene.part[i], ", must be below the number of parts, ", scene.parts.size()), "");
    else if (const auto& own = scene.parts[scene.part[i]].own; own && scene.id[i] >= own->size())
      refuse("id", text(" = ", scene.id[i], ", must be below the ", own->size(), " surfels of its part"), "");
  }
  if (scene.material[i] >= materials)
    refuse("material", text(" = ", scene.material[i], ", must be below the number of materials, ", materials), "");
}

/// Returns the speed of the fastest surfel [m/s].
double fastest_surfel(const SceneCloud& scene) {
  double fastest = 0;
  if (!moves(scene)) return fastest;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const ScenePart& part = *scene.part_of_surfel(i);
    if (!part.moves()) continue;
    const Eigen::Vector3d arm = scene.origin + scene.point[i].cast<double>() - part.world_from_part.translation();
    fastest = std::max(fastest, (part.velocity + part.turn_rate.cross(arm)).norm());
  }
  return fastest;
}

}  // namespace

void add_surfel(SceneCloud& scene, const Eigen::Vector3d& world_position, const Eigen::Vector3d& normal, double area,
                std::uint16_t material) {
  if (material >= scene.materials.size())
    fail(ErrorKind::argument, "add_surfel: material = ", material, ", must be below the number of materials, ",
         scene.materials.size());
  if (!scene.part.empty()) fail(ErrorKind::argument, "add_surfel: the scene is made of parts; add it to one of them");
  scene.point.push_back((world_position - scene.origin).cast<float>());
  scene.normal.push_back(normal.cast<float>());
  scene.area.push_back(static_cast<float>(area));
  scene.material.push_back(material);
  scene.id.push_back(scene.id.empty() ? 0 : scene.id.back() + 1);
  if (!scene.noise.empty()) scene.noise.push_back(0);
  if (!scene.unevenness.empty()) scene.unevenness.push_back(static_cast<float>(std::sqrt(area)));
  if (!scene.facet.empty()) scene.facet.push_back({scene.point.back(), scene.point.back(), scene.point.back()});
}

void require_valid(const SceneCloud& scene, const char* who) {
  require_length(scene.normal.size(), scene.size(), "normal", who);
  require_length(scene.area.size(), scene.size(), "area", who);
  require_length(scene.material.size(), scene.size(), "material", who);
  require_length(scene.id.size(), scene.size(), "id", who);
  if (!scene.noise.empty()) require_length(scene.noise.size(), scene.size(), "noise", who);
  if (!scene.unevenness.empty()) require_length(scene.unevenness.size(), scene.size(), "unevenness", who);
  if (!scene.facet.empty()) require_length(scene.facet.size(), scene.size(), "facet", who);
  if (!scene.part.empty()) require_length(scene.part.size(), scene.size(), "part", who);
  if (!scene.origin.allFinite()) fail(ErrorKind::content, who, ": scene.origin must be finite");
  for (const Material& material : scene.materials) require_valid(material, who, ErrorKind::content);
  if (const auto fault = find_fault(scene, 0, scene.size(), scene.materials.size()))
    fail(ErrorKind::content, who, ": scene.", fault->array, "[", fault->surfel, "]", fault->what, fault->remedy);
}

std::optional<SurfelFault> find_fault(const SceneCloud& scene, std::size_t begin, std::size_t end,
                                      std::size_t materials) {
  std::optional<SurfelFault> fault;
  for (std::size_t i = begin; i < end && !fault; ++i)
    check_surfel(scene, i, materials, [&](const char* array, const std::string& what, const char* remedy) {
      if (!fault) fault = {i, array, what, remedy};
    });
  return fault;
}

WholeScene whole_of(const SceneCloud& scene) {
  if (scene.part_of) return *scene.part_of;
  if (scene.size() == 0) return {};
  const double area = std::accumulate(scene.area.begin(), scene.area.end(), 0.0);
  return {scene.size(), std::sqrt(area / static_cast<double>(scene.size())),
          *std::max_element(scene.area.begin(), scene.area.end()),
          std::any_of(scene.materials.begin(), scene.materials.end(), is_smooth), fastest_surfel(scene)};
}

WholeScene together(const WholeScene& a, const WholeScene& b) {
  if (a.surfels == 0) return b;
  if (b.surfels == 0) return a;
  const auto of_a = static_cast<double>(a.surfels), of_b = static_cast<double>(b.surfels);
  const double area = a.mean_spacing * a.mean_spacing * of_a + b.mean_spacing * b.mean_spacing * of_b;
  return {a.surfels + b.surfels, std::sqrt(area / (of_a + of_b)), std::max(a.largest_area, b.largest_area),
          a.smooth || b.smooth, std::max(a.fastest, b.fastest)};
}

bool moves(const SceneCloud& scene) {
  return std::any_of(scene.parts.begin(), scene.parts.end(), [](const ScenePart& part) { return part.moves(); });
}

SceneCloud subset(const SceneCloud& scene, const std::vector<std::uint32_t>& keep) {
  SceneCloud part;
  part.origin = scene.origin;
  part.materials = scene.materials;
  part.normals_oriented = scene.normals_oriented;
  part.part_of = scene.part_of;
  for (const std::uint32_t i : keep)
    if (i >= scene.size())
      fail(ErrorKind::argument, "subset: keep holds ", i, ", must be below the number of surfels, ", scene.size());
  const auto gather = [&keep](const auto& from, auto& to) {
    to.reserve(keep.size());
    for (const std::uint32_t i : keep) to.push_back(from[i]);
  };
  gather(scene.point, part.point);
  gather(scene.normal, part.normal);
  gather(scene.area, part.area);
  gather(scene.material, part.material);
  gather(scene.id, part.id);
  if (!scene.noise.empty()) gather(scene.noise, part.noise);
  if (!scene.unevenness.empty()) gather(scene.unevenness, part.unevenness);
  if (!scene.facet.empty()) gather(scene.facet, part.facet);
  if (!scene.part.empty()) gather(scene.part, part.part);
  part.parts = scene.parts;
  return part;
}

Bounds bounds(const SceneCloud& scene) {
  Bounds box;
  if (scene.size() == 0) return box;
  Eigen::Vector3f low = scene.point[0], high = scene.point[0];
  for (const Eigen::Vector3f& p : scene.point) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  box.min = scene.origin + low.cast<double>();
  box.max = scene.origin + high.cast<double>();
  return box;
}

std::uint64_t part_key(const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return random_bits(hash, RandomStage::scene_points, {name.size(), 0, 1})[0];
}

}  // namespace insonify
