// SPDX-License-Identifier: BSD-3-Clause
// Shapes of smooth surfels. Of each connected part of a coherent material the simplest that noise explains: one plane,
// a cylinder with its ends or a sphere, planes. Of mirrors the flat parts alone. Planes grow from a surfel's
// neighbourhood, again and again by least squares, as long as they find more surfels.
#include "acoustics/fit_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "acoustics/coherent_group_internal.hpp"
#include "acoustics/plane_outline_internal.hpp"
#include "acoustics/shape_fits_internal.hpp"
#include "acoustics/surfel_group_internal.hpp"
#include "core/error.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr const char* fitting = "fit_shapes";
constexpr int most_failures = 64;    // of seeds of planes, one after the other
constexpr double along_plane = 0.9;  // cosine between its normal and those of its surfels

/// The surfels of `group` along the plane that grows from `seed`: those nearer to it than near_of(plane).
template <typename Near>
SurfelGroup grown_from(const SurfelGroup& group, std::uint32_t seed, const Near& near_of) {
  const double reach = 4 * std::max(group.spacing(), std::sqrt(double{group.scene.area[seed]}));
  SurfelGroup grown = group.where([&](auto s) {
    return (group.point(s) - group.point(seed)).norm() < reach && group.normal(s).dot(group.normal(seed)) > along_plane;
  });
  for (int turn = 0; turn < 20 && grown.members.size() >= fewest_surfels; ++turn) {
    const FittedPlane plane = plane_through(grown);
    const double near = near_of(plane);
    SurfelGroup more = group.where([&](auto s) {
      return std::abs(plane.normal.dot(group.point(s) - plane.position)) < near &&
             group.normal(s).dot(plane.normal) > along_plane;
    });
    const bool converged = more.members == grown.members;
    grown.members = std::move(more.members);
    if (converged) break;
  }
  return grown;
}

std::vector<Mirror> mirrors_in(const SurfelGroup& whole, const Material& material) {
  std::vector<Mirror> planes;
  SurfelGroup rest = whole;
  for (int failures = 0; rest.members.size() >= fewest_surfels && failures < most_failures;) {
    const double spacing = rest.spacing();
    const std::uint32_t seed = rest.members[rest.members.size() / 2];
    const SurfelGroup plane = grown_from(
        rest, seed, [&](const FittedPlane& p) { return std::max(0.5 * spacing, 3 * std::sqrt(p.mean_square)); });
    const bool found = plane.members.size() >= fewest_surfels;
    failures = found ? 0 : failures + 1;
    if (found) planes.push_back(mirror_of(plane, plane_through(plane), material));
    rest.members = without(rest.members, found ? plane.members : Members{seed});
  }
  return planes;
}

SmoothTarget sphere_of(const CoherentGroup& group, const RoundBody& body) {
  SmoothTarget sphere = group.target();
  sphere.surface.position = body.centre, sphere.radius = body.radius;
  return sphere;
}

/// The largest of the planes that grow from seeds all over a part, of which noise explains how its surfels stray.
std::optional<std::pair<FittedPlane, SurfelGroup>> largest_plane(const CoherentGroup& group, const SurfelGroup& rest) {
  constexpr std::size_t seeds = 12;
  std::optional<std::pair<FittedPlane, SurfelGroup>> largest;
  const double near = group.noise.reach();
  for (std::size_t k = 0; k < seeds; ++k) {
    const std::uint32_t seed = rest.members[(2 * k + 1) * rest.members.size() / (2 * seeds)];
    auto plane = flat_group(grown_from(rest, seed, [&](const FittedPlane&) { return near; }), group.noise);
    if (plane && (!largest || plane->second.area() > largest->second.area())) largest.emplace(*plane);
  }
  return largest;
}

/// The planes of a part, one after the other.
struct FlatGroups {
  std::vector<SmoothTarget> plates;
  std::vector<double> areas;          // of each [m^2]
  double edges = 0;                   // [m^2] of surfels where planes meet, whose normals are those of both together
  double mean_square = 0, count = 0;  // of the distances of all surfels [m^2]; how many these count as
};

FlatGroups flat_groups(const CoherentGroup& group) {
  constexpr double two_planes = 0.6;
  FlatGroups flat;
  SurfelGroup rest = group.surfels;
  double held = 0;
  while (rest.members.size() >= fewest_surfels) {
    const auto plane = largest_plane(group, rest);
    if (!plane) break;
    const auto& [through, surfels] = *plane;
    flat.plates.push_back(group.plate(through, surfels));
    flat.areas.push_back(surfels.area());
    held += surfels.area();
    flat.mean_square += (through.mean_square - flat.mean_square) * surfels.area() / held;
    flat.count += effective_count(surfels);
    rest.members = without(rest.members, surfels.members);
    const SurfelGroup edge = rest.where([&](auto s) {
      return std::abs(plane->first.normal.dot(rest.point(s) - plane->first.position)) <= group.noise.reach() &&
             rest.normal(s).dot(plane->first.normal) > two_planes;
    });
    flat.edges += edge.area();
    rest.members = without(rest.members, edge.members);
  }
  return flat;
}

/// Returns true if planes are facets of a bend: a fifth of their area has two others within 1 to 17 degrees of its
/// normal.
bool are_facets(const FlatGroups& flat) {
  constexpr double least_turn = 0.99985, most_turn = 0.9563, share = 0.2;
  double all = 0, curved = 0;
  for (std::size_t k = 0; k < flat.plates.size(); ++k) {
    const auto count = std::ranges::count_if(flat.plates, [&](const SmoothTarget& other) {
      const double cosine = other.surface.normal.dot(flat.plates[k].surface.normal);
      return cosine < least_turn && cosine > most_turn;
    });
    all += flat.areas[k];
    if (count >= 2) curved += flat.areas[k];
  }
  return curved > share * all;
}

/// The plates that a part consists of; throws if it does not. Edges count up to 15 %.
std::vector<SmoothTarget> plates_of(const CoherentGroup& group) {
  constexpr double most_of_edges = 0.15;
  const auto refuse = [&](const auto&... why) {
    fail(ErrorKind::content, fitting, ": material '", group.material.name, "' is coherent, but its ",
         group.surfels.position_text(), " fit no plate, sphere or cylinder within their noise of ",
         printed("%.2g", 1e3 * group.noise.deviation), " mm, ", why..., "; give them another material");
  };
  FlatGroups flat = flat_groups(group);
  const double held = std::accumulate(flat.areas.begin(), flat.areas.end(), 0.0), all = group.surfels.area();
  const double share = (held + std::min(flat.edges, most_of_edges * all)) / all;
  if (share < explained_share) refuse("and planes hold ", std::floor(100 * share), " % of their area, must hold 95 %");
  if (!group.noise.explains(flat.mean_square, flat.count)) refuse("and stray too far from planes");
  if (are_facets(flat)) refuse("and their planes are facets of a bend");
  return std::move(flat.plates);
}

std::vector<SmoothTarget> targets_of(const SurfelGroup& surfels, const Material& material) {
  const CoherentGroup group{surfels, material, noise_of(surfels)};
  if (const auto plane = flat_group(surfels, group.noise);
      plane && group.is_nearly_all(plane->second.area()))  // (E161)
    return {group.plate(plane->first, plane->second)};

  // A small piece of a sphere may pass as one of a cylinder: what leaves less is taken.
  const auto cylinder = cylinder_of(group);
  const auto ball = round_body(surfels, group.noise);
  if (ball && (!cylinder || ball->mean_square <= cylinder->body.mean_square)) return {sphere_of(group, *ball)};
  if (cylinder) return cylinder->targets;

  return plates_of(group);
}

}  // namespace

SmoothShapes fit_shapes(const SceneCloud& scene, const Vector3d& centre, double radius) {
  SmoothShapes shapes;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    if (!is_smooth(material)) continue;
    SurfelGroup all{scene, {}};
    for (std::uint32_t s = 0; s < scene.size(); ++s)
      if (scene.material[s] == m && scene.area[s] > 0 && (all.point(s) - centre).norm() <= radius)
        all.members.push_back(s);
    if (all.members.empty()) continue;
    if (!scene.normals_oriented)
      fail(ErrorKind::content, fitting, ": material '", material.name,
           "' is smooth, but the normals of the scene have no ",
           "side; orient them by a viewpoint (prepare --viewpoint)");
    double largest = 0;
    for (const std::uint32_t s : all.members) largest = std::max(largest, double{scene.area[s]});
    for (const SurfelGroup& group : connected_groups(all, 3 * std::sqrt(largest))) {
      if (material.coherent > 0)
        for (SmoothTarget& target : targets_of(group, material)) shapes.targets.push_back(std::move(target));
      if (material.mirror > 0)
        for (Mirror& plane : mirrors_in(group, material)) shapes.mirrors.push_back(std::move(plane));
    }
  }
  return shapes;
}

}  // namespace insonify
