#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "core/units.hpp"
#include "view/scene_camera_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t most_points = 20000;

// Right, up and forward of a camera.
struct ViewAxes {
  Vector3d right, up, forward;
};
ViewAxes view_axes(const Vector3d& forward, const Vector3d& up) {
  const Vector3d right = forward.cross(up).normalized();
  return {right, right.cross(forward), forward};
}

// Forward direction of the head in the horizontal plane; for a vertical one, the upward direction of its picture.
Vector3d heading(const SceneLook& look) {
  if (!look.head) return Vector3d::UnitX();
  const auto turn = look.head->world_from_head.linear();
  Vector3d ahead = turn.col(0);
  if (std::hypot(ahead.x(), ahead.y()) < 1e-6) ahead = ahead.z() < 0 ? turn.col(2) : Vector3d(-turn.col(2));
  return Vector3d(ahead.x(), ahead.y(), 0).normalized();
}

// View direction of a preset and the upward direction of its picture.
ViewAxes preset_axes(const SceneLook& look, ScenePreset preset) {
  const Vector3d up = Vector3d::UnitZ(), ahead = heading(look);
  const auto downwards = [&](const Vector3d& level, double angle_deg) {
    return Vector3d(std::cos(radians(angle_deg)) * level - std::sin(radians(angle_deg)) * up);
  };
  if (preset == ScenePreset::automatic) preset = look.head ? ScenePreset::behind : ScenePreset::iso;
  if (preset == ScenePreset::behind) return view_axes(downwards(ahead, 30), up);
  if (preset == ScenePreset::top) return view_axes(-up, Vector3d::UnitY());
  if (preset == ScenePreset::side) return view_axes(downwards(up.cross(ahead), 8), up);
  return view_axes(downwards(Vector3d(0.64, 0.77, 0).normalized(), 32), up);
}

// The nearest position from which all points lie within the window, `open_x` and `open_y` being the tangents of half
// its view angles.
Vector3d fitting_position(const std::vector<Vector3d>& points, const ViewAxes& axes, double open_x, double open_y) {
  // A point is inside if its offset to the right is at most its distance times open_x. This gives two bounds on the
  // lateral position of the camera, whose gap closes as it moves nearer; likewise upwards.
  double left = -1e300, right = 1e300, low = -1e300, high = 1e300, nearest = 1e300;
  for (const Vector3d& point : points) {
    const double x = axes.right.dot(point), y = axes.up.dot(point), z = axes.forward.dot(point);
    left = std::max(left, x - open_x * z), right = std::min(right, x + open_x * z);
    low = std::max(low, y - open_y * z), high = std::min(high, y + open_y * z);
    nearest = std::min(nearest, z);
  }
  // A single point is viewed from a distance of one metre.
  const double z = std::min({(right - left) / (2 * open_x), (high - low) / (2 * open_y), nearest - 1e-3});
  const double at = points.size() == 1 ? z - 1 : z;
  return (left + right) / 2 * axes.right + (low + high) / 2 * axes.up + at * axes.forward;
}

}  // namespace

std::vector<Vector3d> points_of_interest(const SceneCloud& scene, const SceneLook& look) {
  std::vector<Vector3d> points, all;
  const std::size_t step = 1 + scene.size() / most_points;
  const Vector3d head =
      look.head ? Vector3d(look.head->world_from_head.translation() - scene.origin) : Vector3d::Zero();
  for (std::size_t i = 0; i < scene.size(); i += step) {
    all.push_back(scene.point[i].cast<double>());
    if (look.head && (all.back() - head).norm() <= look.head->gate.max_range) points.push_back(all.back());
  }
  if (points.empty()) points = std::move(all);
  if (look.head) points.push_back(head);
  return points;
}

CameraView place_view(const SceneCloud& scene, const SceneLook& look, const SceneCamera& camera,
                      const std::vector<Vector3d>& points, double width, double height, double margin,
                      const char* who) {
  CameraView view;
  view.view_angle = radians(30);
  if (camera.position.has_value() != camera.focal_point.has_value())
    fail(ErrorKind::argument, who, ": look.camera has only one of position and focal_point; give both or neither");
  if (camera.position) {
    const Vector3d along = *camera.focal_point - *camera.position;
    if (!(along.norm() > 0) || !along.allFinite() || !camera.position->allFinite())
      fail(ErrorKind::argument, who, ": look.camera looks from (", camera.position->transpose(), ") to (",
           camera.focal_point->transpose(), ") m, must be finite and distinct");
    view.position = *camera.position - scene.origin;
    view.focal_point = *camera.focal_point - scene.origin;
    const bool upright = std::hypot(along.x(), along.y()) < 1e-6 * along.norm();
    view.up = upright ? Vector3d::UnitY() : Vector3d::UnitZ();
    return view;
  }

  const ViewAxes axes = preset_axes(look, camera.preset);
  const double open_y = std::tan(view.view_angle / 2), pixel = 2 * open_y / height;
  view.position = fitting_position(points, axes, std::max(width / 2 - margin, width / 10) * pixel,
                                   std::max(height / 2 - margin, height / 10) * pixel);
  double sum = 0;
  for (const Vector3d& point : points) sum += axes.forward.dot(point - view.position);
  view.focal_point = view.position + sum / static_cast<double>(points.size()) * axes.forward;
  view.up = axes.up;
  return view;
}

ShownPoint show_point(const CameraView& view, const Vector3d& point, double width, double height) {
  const ViewAxes axes = view_axes(view.forward(), view.up);
  const Vector3d from_eye = point - view.position;
  const double distance = axes.forward.dot(from_eye);
  const double scale = height / (2 * std::tan(view.view_angle / 2) * distance);
  return {{width / 2 + scale * axes.right.dot(from_eye), height / 2 + scale * axes.up.dot(from_eye)}, distance};
}

}  // namespace insonify
