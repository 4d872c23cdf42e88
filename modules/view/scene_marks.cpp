// Holes and normals of a scene, which show whether a scan is good enough for a head.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <vtkProperty.h>

#include "view/scene_actor_parts_internal.hpp"
#include "view/scene_lines_internal.hpp"
#include "view/scene_surfels_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t most_normals = 4000;
constexpr double normal_length = 0.012;  // of the diagonal; or three spacings, if longer

Polyline normal_of(const SceneCloud& scene, std::uint32_t i, double least) {
  const Eigen::Vector3d place = scene.point[i].cast<double>();
  const Eigen::Vector3d tip =
      std::max(least, 3 * std::sqrt(static_cast<double>(scene.area[i]))) * scene.normal[i].cast<double>();
  return {scene.normals_oriented ? place : Eigen::Vector3d(place - tip), place + tip};
}

}  // namespace

void SceneActors::Parts::make_marks() {
  holes = point_actor(hole_arrays = point_arrays({}, {}), {});
  holes->GetMapper()->ScalarVisibilityOff();
  holes->GetProperty()->SetColor(hole_rgb[0] / 255.0, hole_rgb[1] / 255.0, hole_rgb[2] / 255.0);
  mapper_of(holes)->min_pixels = 3 * thin();
  mapper_of(holes)->lift = 0.008;
  normals = line_actor(options.dark ? Colour{0.5, 0.9, 0.6} : Colour{0.1, 0.45, 0.2}, 0.8 * thin());
}

void SceneActors::show_holes(const std::vector<Eigen::Vector3d>& places) {
  Parts& p = *parts_;
  p.hole_places.clear();
  for (const Eigen::Vector3d& place : places) p.hole_places.push_back((place - p.scene.origin).cast<float>());
  p.look.holes = places;
  p.hole_arrays = point_arrays(p.hole_places, std::vector<float>(places.size()));
  std::vector<std::uint32_t> all(places.size());
  std::iota(all.begin(), all.end(), 0U);
  set_points(p.holes, p.hole_arrays, all);
  if (p.look.colour == SceneColour::visibility) p.colour();  // the legend names them
}

void SceneActors::show_normals(bool on) {
  Parts& p = *parts_;
  p.look.normals = on;
  std::vector<Polyline> lines;
  const double least = normal_length * p.box().diagonal().norm();
  if (on)
    for (const std::uint32_t i : drawn_surfels(p.scene, std::min(most_normals, p.scene.size())))
      lines.push_back(normal_of(p.scene, i, least));
  set_lines(p.normals, lines);
}

}  // namespace insonify
