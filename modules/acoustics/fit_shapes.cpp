// SPDX-License-Identifier: BSD-3-Clause
// Shapes of smooth surfels. Of each connected part of a coherent material the simplest that noise explains: one plane,
// a cylinder with its ends or a sphere, planes. Of mirrors the flat parts alone. Planes grow from a surfel's
// neighbourhood, again and again by least squares, as long as they find more surfels.
#include "acoustics/fit_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "acoustics/coherent_part_internal.hpp"
#include "acoustics/plane_outline_internal.hpp"
#include "acoustics/shape_fits_internal.hpp"
#include "acoustics/surfel_part_internal.hpp"
#include "core/error.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr const char* fitting = "fit_shapes";
constexpr int most_failures = 64;    // of seeds of planes, one after the other
constexpr double along_plane = 0.9;  // cosine between its normal and those of its surfels

/// The surfels of `part` along the plane that grows from `seed`: those nearer to it than near_of(plane).
template <typename Near>
SurfelPart grown_from(const SurfelPart& part, std::uint32_t seed, const Near& near_of) {
  const double reach = 4 * std::max(part.spacing(), std::sqrt(double{part.scene.area[seed]}));
  SurfelPart grown = part.where([&](auto s) {
    return (part.point(s) - part.point(seed)).norm() < reach && part.normal(s).dot(part.normal(seed)) > along_plane;
  });
  for (int turn = 0; turn < 20 && grown.members.size() >= fewest_surfels; ++turn) {
    const FittedPlane plane = plane_through(grown);
    const double near = near_of(plane);
    SurfelPart more = part.where([&](auto s) {
      return std::abs(plane.normal.dot(part.point(s) - plane.place)) < near &&
             part.normal(s).dot(plane.normal) > along_plane;
    });
    const bool settled = more.members == grown.members;
    grown.members = std::move(more.members);
    if (settled) break;
  }
  return grown;
}

std::vector<Mirror> mirrors_in(const SurfelPart& whole, const Material& material) {
  std::vector<Mirror> planes;
  SurfelPart rest = whole;
  for (int failures = 0; rest.members.size() >= fewest_surfels && failures < most_failures;) {
    const double spacing = rest.spacing();
    const std::uint32_t seed = rest.members[rest.members.size() / 2];
    const SurfelPart plane = grown_from(
        rest, seed, [&](const FittedPlane& p) { return std::max(0.5 * spacing, 3 * std::sqrt(p.mean_square)); });
    const bool found = plane.members.size() >= fewest_surfels;
    failures = found ? 0 : failures + 1;
    if (found) planes.push_back(mirror_of(plane, plane_through(plane), material));
    rest.members = without(rest.members, found ? plane.members : Members{seed});
  }
  return planes;
}

SmoothTarget sphere_of(const CoherentPart& part, const RoundBody& body) {
  SmoothTarget sphere = part.target();
  sphere.surface.place = body.centre, sphere.radius = body.radius;
  return sphere;
}

/// The largest of the planes that grow from seeds all over a part, of which noise explains how its surfels stray.
std::optional<std::pair<FittedPlane, SurfelPart>> largest_plane(const CoherentPart& part, const SurfelPart& rest) {
  constexpr std::size_t seeds = 12;
  std::optional<std::pair<FittedPlane, SurfelPart>> largest;
  const double near = part.noise.reach();
  for (std::size_t k = 0; k < seeds; ++k) {
    const std::uint32_t seed = rest.members[(2 * k + 1) * rest.members.size() / (2 * seeds)];
    auto plane = flat_part(grown_from(rest, seed, [&](const FittedPlane&) { return near; }), part.noise);
    if (plane && (!largest || plane->second.area() > largest->second.area())) largest.emplace(*plane);
  }
  return largest;
}

/// The planes of a part, one after the other.
struct FlatParts {
  std::vector<SmoothTarget> plates;
  std::vector<double> areas;          // of each [m^2]
  double edges = 0;                   // [m^2] of surfels where planes meet, whose normals are those of both together
  double mean_square = 0, count = 0;  // of the distances of all surfels [m^2]; how many these count as
};

FlatParts flat_parts(const CoherentPart& part) {
  constexpr double two_planes = 0.6;
  FlatParts flat;
  SurfelPart rest = part.surfels;
  double held = 0;
  while (rest.members.size() >= fewest_surfels) {
    const auto plane = largest_plane(part, rest);
    if (!plane) break;
    const auto& [through, surfels] = *plane;
    flat.plates.push_back(part.plate(through, surfels));
    flat.areas.push_back(surfels.area());
    held += surfels.area();
    flat.mean_square += (through.mean_square - flat.mean_square) * surfels.area() / held;
    flat.count += effective_count(surfels);
    rest.members = without(rest.members, surfels.members);
    const SurfelPart edge = rest.where([&](auto s) {
      return std::abs(plane->first.normal.dot(rest.point(s) - plane->first.place)) <= part.noise.reach() &&
             rest.normal(s).dot(plane->first.normal) > two_planes;
    });
    flat.edges += edge.area();
    rest.members = without(rest.members, edge.members);
  }
  return flat;
}

/// Returns true if planes are facets of a bend: a fifth of their area has two others within 1 to 17 degrees of its
/// normal.
bool are_facets(const FlatParts& flat) {
  constexpr double least_turn = 0.99985, most_turn = 0.9563, share = 0.2;
  double all = 0, bent = 0;
  for (std::size_t k = 0; k < flat.plates.size(); ++k) {
    const auto count = std::ranges::count_if(flat.plates, [&](const SmoothTarget& other) {
      const double cosine = other.surface.normal.dot(flat.plates[k].surface.normal);
      return cosine < least_turn && cosine > most_turn;
    });
    all += flat.areas[k];
    if (count >= 2) bent += flat.areas[k];
  }
  return bent > share * all;
}

/// The plates that a part consists of; throws if it does not. Edges count up to 15 %.
std::vector<SmoothTarget> plates_of(const CoherentPart& part) {
  constexpr double most_of_edges = 0.15;
  const auto refuse = [&](const auto&... why) {
    fail(ErrorKind::content, fitting, ": material '", part.material.name, "' is coherent, but its ",
         part.surfels.place(), " fit no plate, sphere or cylinder within their noise of ",
         printed("%.2g", 1e3 * part.noise.deviation), " mm, ", why..., "; give them another material");
  };
  FlatParts flat = flat_parts(part);
  const double held = std::accumulate(flat.areas.begin(), flat.areas.end(), 0.0), all = part.surfels.area();
  const double share = (held + std::min(flat.edges, most_of_edges * all)) / all;
  if (share < explained_share) refuse("and planes hold ", std::floor(100 * share), " % of their area, must hold 95 %");
  if (!part.noise.explains(flat.mean_square, flat.count)) refuse("and stray too far from planes");
  if (are_facets(flat)) refuse("and their planes are facets of a bend");
  return std::move(flat.plates);
}

std::vector<SmoothTarget> targets_of(const SurfelPart& surfels, const Material& material) {
  const CoherentPart part{surfels, material, noise_of(surfels)};
  if (const auto plane = flat_part(surfels, part.noise); plane && part.is_nearly_all(plane->second.area()))  // (E161)
    return {part.plate(plane->first, plane->second)};

  // A small piece of a sphere may pass as one of a cylinder: what leaves less is taken.
  const auto cylinder = cylinder_of(part);
  const auto ball = round_body(surfels, part.noise);
  if (ball && (!cylinder || ball->mean_square <= cylinder->body.mean_square)) return {sphere_of(part, *ball)};
  if (cylinder) return cylinder->targets;

  return plates_of(part);
}

}  // namespace

SmoothShapes fit_shapes(const SceneCloud& scene, const Vector3d& centre, double radius) {
  SmoothShapes shapes;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    if (!is_smooth(material)) continue;
    SurfelPart all{scene, {}};
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
    for (const SurfelPart& part : connected_parts(all, 3 * std::sqrt(largest))) {
      if (material.coherent > 0)
        for (SmoothTarget& target : targets_of(part, material)) shapes.targets.push_back(std::move(target));
      if (material.mirror > 0)
        for (Mirror& plane : mirrors_in(part, material)) shapes.mirrors.push_back(std::move(plane));
    }
  }
  return shapes;
}

}  // namespace insonify
